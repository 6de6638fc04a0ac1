#include "host/reference/renderer.h"

#include "host/film/tally.h"
#include "host/packing/light_planes.h"
#include "host/reference/ledger_counter.h"
#include "host/reference/path.h"
#include "host/reference/view.h"
#include "host/reference/whitted.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <mutex>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace hyalite::core::reference {

namespace {

/// A sample is the traversal work of a sample of `Integrator`, as its counter has it.
template <class Real, class Integrator> class WorkOf : public Integrator {
  public:
    using Integrator::Integrator;

    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        this->counter().sample = glm::vec3(0.0f);
        static_cast<void>(Integrator::sampleRadiance(pixel, sampleIndex, shift));
        return Vec3<Real>(this->counter().sample);
    }
};

/// Whether the integrator ended its last sample before it was whole.
template <class SampleIntegrator> bool isAbandoned(const SampleIntegrator &integrator) {
    if constexpr (requires { integrator.isAbandoned(); })
        return integrator.isAbandoned();
    return false;
}

/// Of the integrator's last sample; 0 of those without.
template <class Real, class SampleIntegrator> Real transparencyOf(const SampleIntegrator &integrator) {
    if constexpr (requires { integrator.transparency(); })
        return integrator.transparency();
    return Real(0);
}

/// Adds the integrator's last sample.
template <class Real, class SampleIntegrator>
FilmPixel<Real> withSampleOf(const SampleIntegrator &integrator, const FilmPixel<Real> &sums,
                             const Vec3<Real> &radiance) {
    if constexpr (requires { integrator.features(); })
        if (const auto beside = integrator.features())
            return withAddends(sums, withoutSubnormals<Real>(radiance), beside->normal, beside->depth);
    return withSample(sums, radiance, transparencyOf<Real>(integrator));
}

/// Counts samples by their numbers until `film` has `sampleCount`, or `isLast`, called after each, returns true.
/// Returns the number of added samples.
template <class SampleIntegrator, class IsLast>
std::uint32_t tallyPixel(SampleIntegrator &integrator, const glm::uvec2 &pixel, std::uint32_t sampleCount,
                         layout::FilmPixel &film, const IsLast &isLast) {
    const std::uint32_t countBefore = film.sampleCount;
    bool isStopped = false;
    while (film.sampleCount < sampleCount && !isStopped) {
        tallySample(film, static_cast<std::uint32_t>(integrator.sampleRadiance(pixel, film.sampleCount).x));
        isStopped = isLast();
    }
    return film.sampleCount - countBefore;
}

/// The sums of a pixel's layers of light, as FilmRecords::light has them.
template <class Real> class LightSums {
  public:
    explicit LightSums(std::span<const float> light) : sums_(light.size() / 2) {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] = {Real(light[i]), Real(light[sums_.size() + i])};
    }

    void add(const std::vector<Vec3<Real>> &planes) {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] =
                plus(sums_[i], withoutSubnormals<Real>(planes[i / 3][static_cast<glm::length_t>(i % 3)]));
    }

    void storeTo(std::span<float> light) const {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            light[i] = static_cast<float>(sums_[i].value);
            light[sums_.size() + i] = static_cast<float>(sums_[i].rest);
        }
    }

  private:
    std::vector<CompensatedSum<Real>> sums_;
};

/// Adds samples to `film` and `light` until it has `sampleCount`, the integrator abandons one, or `isLast`, called after each,
/// returns true. Returns the number of added samples.
template <class Real, class SampleIntegrator, class IsLast>
std::uint32_t renderPixel(SampleIntegrator &integrator, const glm::uvec2 &pixel, std::uint32_t sampleCount,
                          layout::FilmPixel &film, std::span<float> light, const IsLast &isLast) {
    FilmPixel<Real> sums(film);
    LightSums<Real> lightSums(light);
    const std::uint32_t countBefore = film.sampleCount;
    std::uint32_t finishedCount = countBefore;
    bool isStopped = false;
    while (finishedCount < sampleCount && !isStopped) {
        const Vec3<Real> radiance = integrator.sampleRadiance(pixel, finishedCount);
        if (isAbandoned(integrator))
            break;
        sums = withSampleOf(integrator, sums, radiance);
        if constexpr (requires { integrator.light(); })
            if (!light.empty())
                lightSums.add(integrator.light());
        ++finishedCount;
        isStopped = isLast();
    }
    film = {.sum = glm::vec3(sums.sum),
            .sampleCount = finishedCount,
            .sumRest = glm::vec3(sums.sumRest),
            .pad0 = 0.0f,
            .sumOfSquares = glm::vec3(sums.sumOfSquares),
            .transparency = static_cast<float>(sums.transparency),
            .squaresRest = glm::vec3(sums.squaresRest),
            .transparencyRest = static_cast<float>(sums.transparencyRest)};
    lightSums.storeTo(light);
    return finishedCount - countBefore;
}

/// One render, with an integrator for each thread. It pauses for snapshots and continues.
template <class Real, class Counter, class MakeIntegrator> class FilmRenderer {
  public:
    FilmRenderer(const MakeIntegrator &makeIntegrator, const RenderSettings &settings, Film begun,
                 const Options &options, const RenderHooks &hooks)
        : makeIntegrator_(makeIntegrator), options_(options), hooks_(hooks),
          sampleCount_(static_cast<std::uint32_t>(settings.samplesPerPixel)),
          tallies_(rowOf(settings.integrator).tallies()), result_{std::move(begun), {}, {}, {}},
          pixelCount_(static_cast<std::int64_t>(result_.film.pixels.size())) {
        for (const layout::FilmPixel &pixel : result_.film.pixels)
            finishedSamples_ += std::min(pixel.sampleCount, sampleCount_); // some may have more
    }

    [[nodiscard]] Result render() {
        do {
            isPaused_ = false;
            renderUntilPaused();
            if (isPaused_ && !isStopped_)
                hooks_.snapshots->take([this](Film &copy) { copy = result_.film; }, result_.rays);
        } while (isPaused_ && !isStopped_);
        return std::move(result_);
    }

  private:
    // Short runs of pixels: some pixels cost a hundred times more than others.
    static constexpr std::int64_t runLength = 32;

    void renderUntilPaused() {
        const std::int64_t runCount = (pixelCount_ + runLength - 1) / runLength;
        while (firstRun_ < runCount && isFinished(firstRun_))
            ++firstRun_;
        const int threadCount = options_.threadCount > 0 ? options_.threadCount : omp_get_max_threads();
#pragma omp parallel num_threads(threadCount)
        {
            auto integrator = makeIntegrator_();
            if constexpr (requires { integrator.stopWhen(nullptr); })
                integrator.stopWhen([this] { return isToStop(); });
#pragma omp for schedule(dynamic)
            for (std::int64_t run = firstRun_; run < runCount; ++run)
                if (!isPaused_ &&
                    !isStopped_) // an OpenMP loop cannot be left: its remaining iterations do nothing
                    renderRun(integrator, run);
#pragma omp critical(hyaliteReferenceCounts)
            {
                result_.rays += integrator.counts();
                if constexpr (std::is_same_v<Counter, WorkCounter>)
                    result_.work += integrator.counter().counts;
                if constexpr (std::is_same_v<Counter, LedgerCounter>)
                    result_.ledger += integrator.counter().ledger;
            }
        }
    }

    template <class SampleIntegrator> void renderRun(SampleIntegrator &integrator, std::int64_t run) {
        const Crop &crop = result_.film.crop;
        std::uint64_t addedSamples = 0;
        const std::int64_t end = std::min((run + 1) * runLength, pixelCount_);
        for (std::int64_t i = run * runLength; i < end && !isPaused_ && !isStopped_; ++i) {
            const glm::uvec2 pixel(static_cast<std::uint32_t>(crop.x0 + i % crop.width()),
                                   static_cast<std::uint32_t>(crop.y0 + i / crop.width()));
            layout::FilmPixel &film = result_.film.pixels[static_cast<std::size_t>(i)];
            const auto isLast = [this] {
                // A pause inside a pixel would round its sums in double precision.
                return isToStop() || (std::is_same_v<Real, float> && isToPause());
            };
            addedSamples += tallies_ ? tallyPixel(integrator, pixel, sampleCount_, film, isLast)
                                     : renderPixel<Real>(integrator, pixel, sampleCount_, film,
                                                         lightOf(static_cast<std::size_t>(i)), isLast);
            (void)isToPause();
        }
        if constexpr (std::is_same_v<Counter, LedgerCounter>)
            integrator.counter().ledger.shading.filmSamples += addedSamples;
        const std::lock_guard lock(progressMutex_); // of this render alone: a callback may render, too
        finishedSamples_ += addedSamples;
        if (hooks_.onProgress)
            hooks_.onProgress(static_cast<double>(finishedSamples_) / static_cast<double>(pixelCount_) /
                              sampleCount_);
    }

    [[nodiscard]] std::span<float> lightOf(std::size_t pixel) {
        const std::size_t size = result_.film.lightSize();
        return std::span(result_.film.light).subspan(pixel * size, size);
    }

    [[nodiscard]] bool isFinished(std::int64_t run) const {
        const auto begin = result_.film.pixels.begin() + run * runLength;
        const auto end = result_.film.pixels.begin() + std::min((run + 1) * runLength, pixelCount_);
        return std::all_of(begin, end,
                           [this](const auto &pixel) { return pixel.sampleCount >= sampleCount_; });
    }

    [[nodiscard]] bool isToStop() {
        if (hooks_.shouldStop && hooks_.shouldStop())
            isStopped_ = true;
        return isStopped_.load();
    }

    [[nodiscard]] bool isToPause() {
        if (hooks_.snapshots != nullptr && hooks_.snapshots->isWanted())
            isPaused_ = true;
        return isPaused_.load();
    }

    const MakeIntegrator &makeIntegrator_;
    const Options &options_;
    const RenderHooks &hooks_;
    std::uint32_t sampleCount_;
    bool tallies_;
    Result result_;
    std::int64_t pixelCount_;
    std::int64_t firstRun_ = 0; ///< all before it are finished
    std::uint64_t finishedSamples_ = 0;
    std::mutex progressMutex_; ///< of these samples, and of calls of onProgress
    std::atomic<bool> isPaused_ = false;
    std::atomic<bool> isStopped_ = false;
};

/// Calls `use` with a factory of integrators of the requested kind.
template <class Real, class Counter, class Use>
auto withIntegrator(const PackedScene &scene, const RenderSettings &settings, const Use &use) {
    const auto useOf = [&]<class Integrator>(std::type_identity<Integrator>) {
        if constexpr (std::is_same_v<Counter, LedgerCounter>)
            return use([&] { return WorkOf<Real, Integrator>(scene, settings); });
        if constexpr (std::is_same_v<Counter, WorkCounter>)
            if (showsWork(settings))
                return use([&] { return WorkOf<Real, Integrator>(scene, settings); });
        return use([&] { return Integrator(scene, settings); });
    };
    const IntegratorRow &row = rowOf(settings.integrator);
    if (row.kernel == "whitted")
        return useOf(std::type_identity<WhittedIntegrator<Real, Counter>>());
    if (row.kernel == "path")
        return useOf(std::type_identity<PathIntegrator<Real, Counter>>());
    assert(row.kernel == "view");
    return useOf(std::type_identity<ViewIntegrator<Real, Counter>>());
}

template <class Real>
std::vector<layout::TraceEvent> traceAs(const PackedScene &scene, const RenderSettings &settings,
                                        const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                        const glm::dvec2 &shift) {
    return withIntegrator<Real, NoCounter>(scene, settings, [&](const auto &makeIntegrator) {
        std::vector<layout::TraceEvent> events;
        auto integrator = makeIntegrator();
        integrator.traceTo(events);
        static_cast<void>(integrator.sampleRadiance(pixel, sampleIndex, Vec2<Real>(shift)));
        return events;
    });
}

} // namespace

bool canChargeWork(const RenderSettings &settings) { return rowOf(settings.integrator).showsLight; }

Result render(const PackedScene &scene, const RenderSettings &settings, Film begun, const Options &options,
              const RenderHooks &hooks) {
    begun.keepLight(lightPlaneNames(scene, settings));
    const auto renderAs = [&]<class Real, class Counter>() {
        return withIntegrator<Real, Counter>(
            scene, settings, [&]<class MakeIntegrator>(const MakeIntegrator &makeIntegrator) {
                return FilmRenderer<Real, Counter, MakeIntegrator>(makeIntegrator, settings, std::move(begun),
                                                                   options, hooks)
                    .render();
            });
    };
    const bool isDouble = options.precision == Precision::Float64;
    if (options.isCharging) {
        assert(canChargeWork(settings) && !isDouble);
        return renderAs.template operator()<float, LedgerCounter>();
    }
    if (options.isCounting || showsWork(settings))
        return isDouble ? renderAs.template operator()<double, WorkCounter>()
                        : renderAs.template operator()<float, WorkCounter>();
    return isDouble ? renderAs.template operator()<double, NoCounter>()
                    : renderAs.template operator()<float, NoCounter>();
}

std::vector<layout::TraceEvent> trace(const PackedScene &scene, const RenderSettings &settings,
                                      const glm::uvec2 &pixel, std::uint32_t sampleIndex, Precision precision,
                                      const glm::dvec2 &shift) {
    if (precision == Precision::Float64)
        return traceAs<double>(scene, settings, pixel, sampleIndex, shift);
    return traceAs<float>(scene, settings, pixel, sampleIndex, shift);
}

} // namespace hyalite::core::reference
