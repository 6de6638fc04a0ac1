#include "host/engine/render_stages.h"

#include "host/engine/sample_rounds.h"
#include "host/film/first_samples.h"
#include "host/film/noise.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

/// What a stage changes of a film, for a while.
struct Stage {
    std::uint32_t end; ///< samples of the pixels that take part
    /// Pixels that do not take part, and their samples: meanwhile they have as many as the others.
    std::vector<std::pair<std::size_t, std::uint32_t>> resting{};
    /// Of pixels that take part, by index: their first samples, once they have more.
    std::vector<std::pair<std::size_t, FirstSamples>> first{};

    /// Gives a film what it has beside the samples of the stage.
    void endIn(Film &film, const FilmRecords &beside) const {
        for (const auto &[pixel, count] : resting)
            film.pixels[pixel].sampleCount = count;
        film.first = beside.first;
        film.wanted = beside.wanted;
        for (const auto &[pixel, taken] : first)
            if (film.pixels[pixel].sampleCount > taken.sampleCount)
                film.first[pixel] = taken;
    }
};

/// The snapshots of a stage. Backends know nothing of stages.
class StageSnapshots : public SnapshotTaker {
  public:
    StageSnapshots(SnapshotTaker &whole, const Stage &stage, const FilmRecords &beside,
                   const RayCounts &raysBefore)
        : whole_(whole), stage_(stage), beside_(beside), raysBefore_(raysBefore) {}

    [[nodiscard]] bool isWanted() const noexcept override { return whole_.isWanted(); }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) override {
        const auto copyAll = [&](Film &copy) {
            copyTo(copy);
            stage_.endIn(copy, beside_);
        };
        whole_.take(copyAll, raysBefore_ + rays);
    }

  private:
    SnapshotTaker &whole_;
    const Stage &stage_;
    const FilmRecords &beside_;
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

/// The end of a stage for a pixel that lacks samples: those whose mean is kept, or all.
std::uint32_t nextCountOf(std::uint32_t count, std::uint32_t target) {
    for (const std::uint32_t kept : {halfOfFirstCount(target), firstSampleCount(target)})
        if (count < kept)
            return kept;
    return target;
}

/// The first samples that a pixel has once it gets more; empty: those that it has.
std::optional<FirstSamples> firstOf(const layout::FilmPixel &pixel, const FirstSamples &known,
                                    std::uint32_t target) {
    const std::uint32_t count = pixel.sampleCount;
    const std::uint32_t halfCount = halfOfFirstCount(target);
    if (count > 0 && count == firstSampleCount(target))
        return FirstSamples{{meanOf(pixel), count}, halfCount > 0 ? MeanOfFirst(known) : MeanOfFirst{}};
    if (count > 0 && count == halfCount)
        return FirstSamples{{meanOf(pixel), count}};
    if (halfCount == 0 && known.half.sampleCount > 0)
        return FirstSamples{MeanOfFirst(known)};
    return {};
}

/// A render, stage by stage. In a round, each pixel gets the samples that it is to have.
class StagedRender {
  public:
    StagedRender(Backend &backend, const PackedScene &scene, const RenderSettings &settings, Film begun,
                 const RenderHooks &hooks)
        : backend_(backend), scene_(scene), settings_(settings), hooks_(hooks),
          maxSamples_(static_cast<std::uint32_t>(settings.samplesPerPixel)), total_{std::move(begun),
                                                                                    {},
                                                                                    {},
                                                                                    {}},
          rounds_(total_.film, settings) {
        total_.film.first.resize(total_.film.pixels.size());
    }

    [[nodiscard]] BackendResult render() {
        do {
            while (const std::optional<std::uint32_t> end = endOfNextStage())
                if (!runStage(*end))
                    return std::move(total_);
        } while (rounds_.begin(total_.film, hooks_.onNoise));
        if (hooks_.onProgress)
            hooks_.onProgress(1.0); // what was expected may have been more
        return std::move(total_);
    }

  private:
    /// Empty: no pixel wants more samples.
    [[nodiscard]] std::optional<std::uint32_t> endOfNextStage() const {
        std::optional<std::uint32_t> end;
        for (std::size_t i = 0; i < total_.film.pixels.size(); ++i) {
            const std::uint32_t count = total_.film.pixels[i].sampleCount;
            const std::uint32_t target = targetOf(total_.film, i, maxSamples_);
            if (count < target)
                end = std::min(end.value_or(target), nextCountOf(count, target));
        }
        return end;
    }

    /// Of the film, whose pixels without part in it get as many samples as the others will have.
    [[nodiscard]] Stage beginStage(std::uint32_t end) {
        Stage stage{end};
        for (std::size_t i = 0; i < total_.film.pixels.size(); ++i) {
            layout::FilmPixel &pixel = total_.film.pixels[i];
            const std::uint32_t target = targetOf(total_.film, i, maxSamples_);
            if (pixel.sampleCount >= end)
                continue;
            if (pixel.sampleCount >= target)
                stage.resting.emplace_back(i, std::exchange(pixel.sampleCount, end));
            else if (const auto first = firstOf(pixel, total_.film.first[i], target))
                stage.first.emplace_back(i, *first);
        }
        return stage;
    }

    /// Whether all of its samples are there.
    bool runStage(std::uint32_t end) {
        const std::uint64_t before = rounds_.samplesIn(total_.film);
        const Stage stage = beginStage(end);
        const FilmRecords beside{
            {}, {}, std::exchange(total_.film.first, {}), std::exchange(total_.film.wanted, {})};
        RenderSettings ofStage = settings_;
        ofStage.samplesPerPixel = static_cast<int>(end);
        RenderHooks hooksOfStage = hooks_;
        if (hooks_.onProgress)
            hooksOfStage.onProgress = [&, atBegin = samplesUpTo(end),
                                       atEnd = static_cast<double>(total_.film.pixels.size()) *
                                               end](double done) {
                hooks_.onProgress(rounds_.share(static_cast<double>(before) + done * atEnd - atBegin));
            };
        std::optional<StageSnapshots> snapshots;
        if (hooks_.snapshots != nullptr)
            hooksOfStage.snapshots = &snapshots.emplace(*hooks_.snapshots, stage, beside, total_.rays);
        add(total_, backend_.render(scene_, ofStage, std::move(total_.film), hooksOfStage));
        stage.endIn(total_.film, beside);
        for (std::size_t i = 0; i < total_.film.pixels.size(); ++i)
            if (total_.film.pixels[i].sampleCount < std::min(end, targetOf(total_.film, i, maxSamples_)))
                return false;
        return !total_.failure;
    }

    [[nodiscard]] double samplesUpTo(std::uint32_t end) const {
        double count = 0.0;
        for (const layout::FilmPixel &pixel : total_.film.pixels)
            count += std::min(pixel.sampleCount, end);
        return count;
    }

    Backend &backend_;
    const PackedScene &scene_;
    const RenderSettings &settings_;
    const RenderHooks &hooks_;
    const std::uint32_t maxSamples_;
    BackendResult total_;
    SampleRounds rounds_;
};

} // namespace

BackendResult renderInStages(Backend &backend, const PackedScene &scene, const RenderSettings &settings,
                             Film begun, const RenderHooks &hooks) {
    return StagedRender(backend, scene, settings, std::move(begun), hooks).render();
}

} // namespace hyalite::core
