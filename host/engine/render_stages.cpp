#include "host/engine/render_stages.h"

#include "host/film/first_samples.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hyalite::core {

namespace {

/// The snapshots of a stage. Backends know nothing of first samples, nor of the stage before.
class StageSnapshots : public SnapshotTaker {
  public:
    StageSnapshots(SnapshotTaker &whole, const std::vector<FirstSamples> &first, const RayCounts &raysBefore)
        : whole_(whole), first_(first), raysBefore_(raysBefore) {}

    [[nodiscard]] bool isWanted() const noexcept override { return whole_.isWanted(); }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) override {
        const auto copyAll = [&](Film &copy) {
            copyTo(copy);
            copy.first = first_;
        };
        whole_.take(copyAll, raysBefore_ + rays);
    }

  private:
    SnapshotTaker &whole_;
    const std::vector<FirstSamples> &first_;
    RayCounts raysBefore_;
};

/// Of several renderers; of two of a name, in their order.
void add(std::vector<RendererShare> &total, std::vector<RendererShare> &&shares) {
    std::vector<RendererShare> before = std::exchange(total, {});
    for (RendererShare &share : shares) {
        if (const auto same = std::ranges::find(before, share.name, &RendererShare::name);
            same != before.end()) {
            share.tileCount += same->tileCount;
            share.sampleCount += same->sampleCount;
            share.seconds += same->seconds;
            before.erase(same);
        }
        total.push_back(std::move(share));
    }
    std::ranges::move(before, std::back_inserter(total));
}

/// The film is that of the later stage.
void add(BackendResult &total, BackendResult &&stage) {
    total.film = std::move(stage.film);
    total.rays += stage.rays;
    total.timing.uploadSeconds += stage.timing.uploadSeconds;
    total.timing.pipelineSeconds += stage.timing.pipelineSeconds;
    total.timing.renderSeconds += stage.timing.renderSeconds;
    total.timing.dispatchCount += stage.timing.dispatchCount;
    total.work += stage.work;
    total.lanes += stage.lanes;
    total.memory.deviceBytes = std::max(total.memory.deviceBytes, stage.memory.deviceBytes);
    total.memory.hostBytes = std::max(total.memory.hostBytes, stage.memory.hostBytes);
    std::ranges::move(stage.faults, std::back_inserter(total.faults));
    if (stage.failure)
        total.failure.emplace(*stage.failure);
    add(total.shares, std::move(stage.shares));
}

} // namespace

BackendResult renderInStages(Backend &backend, const PackedScene &scene, const RenderSettings &settings,
                             Film begun, const RenderHooks &hooks) {
    const std::uint32_t firstCount = firstSampleCount(static_cast<std::uint32_t>(settings.samplesPerPixel));
    std::vector<FirstSamples> first = std::exchange(begun.first, {});
    first.resize(begun.pixels.size());
    BackendResult total{std::move(begun), {}, {}, {}};
    const auto renderTo = [&](std::uint32_t sampleCount) {
        RenderSettings ofStage = settings;
        ofStage.samplesPerPixel = static_cast<int>(sampleCount);
        RenderHooks hooksOfStage = hooks;
        const double share = static_cast<double>(sampleCount) / settings.samplesPerPixel;
        if (hooks.onProgress)
            hooksOfStage.onProgress = [&hooks, share](double done) { hooks.onProgress(share * done); };
        std::optional<StageSnapshots> snapshots;
        if (hooks.snapshots != nullptr)
            hooksOfStage.snapshots = &snapshots.emplace(*hooks.snapshots, first, total.rays);
        add(total, backend.render(scene, ofStage, std::move(total.film), hooksOfStage));
    };
    const auto lacksFirst = [&](const layout::FilmPixel &pixel) { return pixel.sampleCount < firstCount; };
    if (std::ranges::any_of(total.film.pixels, lacksFirst))
        renderTo(firstCount);
    takeFirst(total.film, firstCount, first);
    if (!total.failure && std::ranges::none_of(total.film.pixels, lacksFirst))
        renderTo(static_cast<std::uint32_t>(settings.samplesPerPixel));
    total.film.first = std::move(first);
    return total;
}

} // namespace hyalite::core
