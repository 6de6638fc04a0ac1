#include "host/reference/renderer.h"

#include "host/reference/path.h"
#include "host/reference/whitted.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace hyalite::reference {

namespace {

/// At most `sampleCount` samples: `isLast` is asked after each.
template <class Real, class SampleIntegrator, class IsLast>
layout::FilmPixel renderPixel(SampleIntegrator &integrator, const glm::uvec2 &pixel,
                              std::uint32_t sampleCount, const IsLast &isLast) {
    Vec3<Real> sum(Real(0));
    Vec3<Real> sumOfSquares(Real(0));
    std::uint32_t finishedCount = 0;
    bool isStopped = false;
    while (finishedCount < sampleCount && !isStopped) {
        const Vec3<Real> radiance = integrator.sampleRadiance(pixel, finishedCount);
        sum = sum + radiance;
        sumOfSquares = sumOfSquares + radiance * radiance;
        ++finishedCount;
        isStopped = isLast();
    }
    return {glm::vec3(sum), finishedCount, glm::vec3(sumOfSquares), 0.0f};
}

template <class SampleIntegrator, class Real, class Counter>
Result renderWith(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                  const Options &options) {
    Result result{Film(crop), {}, {}};
    // Short runs of pixels: some pixels cost a hundred times more than others.
    constexpr std::int64_t runLength = 32;
    const std::int64_t pixelCount = static_cast<std::int64_t>(result.film.pixels.size());
    const std::int64_t runCount = (pixelCount + runLength - 1) / runLength;
    const int threadCount = options.threadCount > 0 ? options.threadCount : omp_get_max_threads();
    std::int64_t finishedRuns = 0;
    std::atomic<bool> isStopped = false;
    const auto askWhetherToStop = [&] {
        if (options.shouldStop && options.shouldStop())
            isStopped = true;
        return isStopped.load();
    };
#pragma omp parallel num_threads(threadCount)
    {
        SampleIntegrator integrator(scene, static_cast<std::uint32_t>(settings.sampler));
#pragma omp for schedule(dynamic)
        for (std::int64_t run = 0; run < runCount; ++run) {
            const std::int64_t end = std::min((run + 1) * runLength, pixelCount);
            for (std::int64_t i = run * runLength; i < end && !isStopped; ++i) {
                const glm::uvec2 pixel(static_cast<std::uint32_t>(crop.x0 + i % crop.width()),
                                       static_cast<std::uint32_t>(crop.y0 + i / crop.width()));
                result.film.pixels[static_cast<std::size_t>(i)] =
                    renderPixel<Real>(integrator, pixel, static_cast<std::uint32_t>(settings.samplesPerPixel),
                                      askWhetherToStop);
            }
            if (isStopped) // a loop of OpenMP cannot be left: what remains of it is skipped
                continue;
#pragma omp critical(hyaliteReferenceProgress)
            {
                ++finishedRuns;
                if (options.onProgress)
                    options.onProgress(static_cast<double>(finishedRuns) / static_cast<double>(runCount));
            }
        }
#pragma omp critical(hyaliteReferenceCounts)
        {
            result.rays += integrator.counts();
            if constexpr (std::is_same_v<Counter, WorkCounter>)
                result.work += integrator.counter().counts;
        }
    }
    return result;
}

template <class Real, class Counter = NoCounter>
Result renderAs(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                const Options &options) {
    if (settings.integrator == Integrator::Path)
        return renderWith<PathIntegrator<Real, Counter>, Real, Counter>(scene, settings, crop, options);
    return renderWith<WhittedIntegrator<Real, Counter>, Real, Counter>(scene, settings, crop, options);
}

template <class SampleIntegrator, class Real>
std::vector<layout::TraceEvent> traceWith(const PackedScene &scene, const RenderSettings &settings,
                                          const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                          const glm::dvec2 &shift) {
    std::vector<layout::TraceEvent> events;
    SampleIntegrator integrator(scene, static_cast<std::uint32_t>(settings.sampler));
    integrator.traceTo(events);
    static_cast<void>(integrator.sampleRadiance(pixel, sampleIndex, Vec2<Real>(shift)));
    return events;
}

template <class Real>
std::vector<layout::TraceEvent> traceAs(const PackedScene &scene, const RenderSettings &settings,
                                        const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                        const glm::dvec2 &shift) {
    if (settings.integrator == Integrator::Path)
        return traceWith<PathIntegrator<Real>, Real>(scene, settings, pixel, sampleIndex, shift);
    return traceWith<WhittedIntegrator<Real>, Real>(scene, settings, pixel, sampleIndex, shift);
}

} // namespace

Result render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
              const Options &options) {
    if (options.isCounting && options.precision == Precision::Float64)
        return renderAs<double, WorkCounter>(scene, settings, crop, options);
    if (options.isCounting)
        return renderAs<float, WorkCounter>(scene, settings, crop, options);
    if (options.precision == Precision::Float64)
        return renderAs<double>(scene, settings, crop, options);
    return renderAs<float>(scene, settings, crop, options);
}

std::vector<layout::TraceEvent> trace(const PackedScene &scene, const RenderSettings &settings,
                                      const glm::uvec2 &pixel, std::uint32_t sampleIndex, Precision precision,
                                      const glm::dvec2 &shift) {
    if (precision == Precision::Float64)
        return traceAs<double>(scene, settings, pixel, sampleIndex, shift);
    return traceAs<float>(scene, settings, pixel, sampleIndex, shift);
}

} // namespace hyalite::reference
