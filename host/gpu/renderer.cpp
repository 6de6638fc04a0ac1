#include "host/gpu/renderer.h"

#include "host/gpu/tile_renderer.h"
#include "host/report/hash.h"

#include <algorithm>
#include <string>
#include <utility>

namespace hyalite::gpu {

namespace {

/// Bands of whole rows whose films fit into a storage buffer of the device, from top to bottom.
std::vector<Crop> cutIntoBands(const Crop &crop, const DeviceInfo &device) {
    const std::uint64_t rowBytes = static_cast<std::uint64_t>(crop.width()) * sizeof(layout::FilmPixel);
    const int rows = static_cast<int>(std::clamp<std::uint64_t>(device.maxStorageBufferBytes / rowBytes, 1,
                                                                static_cast<std::uint64_t>(crop.height())));
    std::vector<Crop> bands;
    for (int y = crop.y0; y < crop.y1; y += rows)
        bands.push_back({crop.x0, crop.x1, y, std::min(y + rows, crop.y1)});
    return bands;
}

} // namespace

struct Renderer::State {
    Device device;
    Batching batching;
    ArithmeticChoice arithmetic;

    State(const DeviceInfo &info, const Batching &wanted)
        : device(info, wanted.isStaged ? Transfers::Staged : Transfers::Automatic),
          batching(completed(wanted, info)), arithmetic(chooseArithmetic(device, wanted.arithmetic)) {
        batching.arithmetic = arithmetic.isNative ? Arithmetic::Native : Arithmetic::Own;
    }

    SceneBuffers upload(const PackedScene &scene) {
        return SceneBuffers(device, scene, batching.traversal == Traversal::SkipList);
    }
};

Renderer::Renderer(const DeviceInfo &device, const Batching &batching)
    : state_(std::make_unique<State>(device, batching)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer &&) noexcept = default;
Renderer &Renderer::operator=(Renderer &&) noexcept = default;

const ArithmeticChoice &Renderer::arithmetic() const { return state_->arithmetic; }

std::string_view Renderer::kernelName() const { return gpu::kernelName(state_->batching); }

std::uint64_t Renderer::kernelHash(Integrator integrator) const {
    return hashBytes(std::as_bytes(kernelWords(state_->batching, integrator)));
}

Result Renderer::render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                        const std::function<void(double)> &onProgress, Timeline *timeline,
                        const std::function<bool()> &shouldStop, Continuation continuation) {
    const bool isContinued = continuation.film.has_value();
    Result result{isContinued ? std::move(*continuation.film) : Film(crop), {}, {}, {}};
    Stopwatch watch;
    // Ends a stage and returns how long it took.
    const auto endStage = [&](const char *name) {
        const Span span = watch.lap();
        if (timeline != nullptr)
            timeline->stages.push_back({name, span, state_->device.allocatedBytes()});
        return span.seconds();
    };
    if (timeline != nullptr)
        timeline->clock = state_->device.timestamps().describe();
    const SceneBuffers buffers = state_->upload(scene);
    result.timing.uploadSeconds = endStage("upload");

    for (const Crop &band : cutIntoBands(crop, state_->device.info())) {
        const std::size_t width = static_cast<std::size_t>(crop.width());
        const std::size_t bandBegin = static_cast<std::size_t>(band.y0 - crop.y0) * width;
        const std::size_t bandSize = static_cast<std::size_t>(band.height()) * width;
        const std::span<layout::FilmPixel> pixels = result.film.pixels;
        const std::span<layout::FilmPixel> bandPixels = pixels.subspan(bandBegin, bandSize);
        Job job{scene,
                band,
                settings.integrator,
                settings.sampler,
                0,
                static_cast<std::uint32_t>(settings.samplesPerPixel),
                false};
        if (isContinued)
            job.film = bandPixels;
        TileRenderer tiles(state_->device, buffers, state_->batching, job);
        result.timing.pipelineSeconds += endStage("buffers");
        tiles.makeKernel();
        result.timing.pipelineSeconds += endStage("pipeline");
        tiles.warmUp();
        result.timing.pipelineSeconds += endStage("first dispatch");

        const double rowsBefore = band.y0 - crop.y0;
        const TileTotals totals = tiles.run(
            [&](double share) {
                if (onProgress)
                    onProgress((rowsBefore + share * band.height()) / crop.height());
            },
            timeline, shouldStop,
            [&](const RayCounts &rays) {
                if (continuation.snapshots == nullptr || !continuation.snapshots->isWanted())
                    return;
                RayCounts raysSoFar = result.rays;
                raysSoFar += rays;
                continuation.snapshots->take(
                    [&](std::span<layout::FilmPixel> copy) {
                        // Other bands have all samples, or those that they began with.
                        std::ranges::copy(pixels.first(bandBegin), copy.begin());
                        std::ranges::copy(pixels.subspan(bandBegin + bandSize),
                                          copy.subspan(bandBegin + bandSize).begin());
                        tiles.readFilm(copy.subspan(bandBegin, bandSize));
                    },
                    raysSoFar);
            });
        result.rays += totals.rays;
        result.work += totals.work;
        result.timing.dispatchCount += totals.dispatchCount;
        result.timing.pipelineSeconds += tiles.lateBuildSeconds();
        result.timing.renderSeconds += endStage("dispatches") - tiles.lateBuildSeconds();
        tiles.readFilm(bandPixels);
        endStage("readback");
        if (totals.isStopped)
            break;
    }
    return result;
}

std::vector<layout::TraceEvent> Renderer::trace(const PackedScene &scene, const RenderSettings &settings,
                                                const glm::uvec2 &pixel, std::uint32_t sampleIndex) {
    const int x = static_cast<int>(pixel.x);
    const int y = static_cast<int>(pixel.y);
    const Job job{
        scene, {x, x + 1, y, y + 1}, settings.integrator, settings.sampler, sampleIndex, sampleIndex + 1,
        true};
    const SceneBuffers buffers = state_->upload(scene);
    TileRenderer tiles(state_->device, buffers, state_->batching, job);
    tiles.makeKernel();
    (void)tiles.run({});
    return tiles.readTrace();
}

} // namespace hyalite::gpu
