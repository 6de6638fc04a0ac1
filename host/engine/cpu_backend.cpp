#include "host/engine/cpu_backend.h"

#include "host/reference/denoise.h"

#include <string>
#include <utility>

namespace hyalite::core {

namespace {

class CpuBackend : public Backend {
  public:
    CpuBackend(reference::Precision precision, int threadCount)
        : precision_(precision), threadCount_(threadCount) {}

    [[nodiscard]] std::string name() const override {
        return precision_ == reference::Precision::Float32 ? "cpu" : "cpu-double";
    }
    [[nodiscard]] RendererIdentity identity(const PackedScene &, Integrator) const override {
        return {name(),
                "reference renderer",
                "native / and sqrt: IEEE 754",
                precision_ == reference::Precision::Float32 ? "promised"
                                                            : "none: it computes in double precision",
                "",
                0};
    }
    [[nodiscard]] std::string precision() const override {
        // A film holds sums in single precision.
        return precision_ == reference::Precision::Float32 ? Backend::precision() : std::string();
    }
    [[nodiscard]] bool hasCompiler() const override { return false; }
    [[nodiscard]] std::string description() const override {
        return precision_ == reference::Precision::Float32
                   ? "cpu, the reference renderer"
                   : "cpu-double, the reference renderer in double precision";
    }
    [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                       const RenderHooks &hooks) override {
        Stopwatch watch;
        reference::Result result =
            reference::render(scene, settings, std::move(begun), {precision_, threadCount_}, hooks);
        const Span span = watch.lap();
        if (hooks.timeline != nullptr) {
            hooks.timeline->clock = "the host's clock, from call to return";
            hooks.timeline->stages.push_back({"dispatches", span});
            hooks.timeline->dispatches.push_back(describeCall(settings, result, span));
        }
        RenderTiming timing;
        timing.renderSeconds = span.seconds();
        return {std::move(result.film), result.rays, timing, result.work, {}};
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return reference::trace(scene, settings, pixel, sampleIndex, precision_);
    }
    [[nodiscard]] Image denoise(const NoisyPicture &picture) override {
        return reference::denoise(picture, threadCount_);
    }

  private:
    /// The whole render as one dispatch of one tile.
    [[nodiscard]] DispatchRecord describeCall(const RenderSettings &settings, const reference::Result &result,
                                              const Span &span) const {
        const Crop &crop = result.film.crop;
        DispatchRecord record;
        record.kernel = name();
        record.tileX = crop.x0;
        record.tileY = crop.y0;
        record.tileWidth = crop.width();
        record.tileHeight = crop.height();
        record.sampleEnd = static_cast<std::uint32_t>(settings.samplesPerPixel);
        record.rays = result.rays;
        record.invocations =
            static_cast<std::uint64_t>(record.tileWidth) * static_cast<std::uint64_t>(record.tileHeight);
        record.times.host = span;
        return record;
    }

    reference::Precision precision_;
    int threadCount_;
};

} // namespace

std::unique_ptr<Backend> makeCpuBackend(reference::Precision precision, int threadCount) {
    return std::make_unique<CpuBackend>(precision, threadCount);
}

} // namespace hyalite::core
