#include "host/jobs/noisiest_pixels.h"

#include "host/film/noise.h"
#include "host/reference/renderer.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string>

namespace hyalite::core {

namespace {

constexpr std::size_t wantedPixels = 8;
constexpr std::uint32_t maxSamples = 4096; // of a pixel, that are traced
constexpr int distanceApart = 8;           // pixels

struct Candidate {
    std::size_t pixel;
    double squaredNoise;
};

float largestOf(const glm::vec3 &radiance) { return std::max({radiance.x, radiance.y, radiance.z}); }

/// The radiance of a traced sample.
glm::vec3 radianceOf(const std::vector<layout::TraceEvent> &events) {
    glm::vec3 radiance(0.0f);
    for (const layout::TraceEvent &event : events)
        if (event.quantity == layout::traceRadiance)
            radiance = event.value;
    return radiance;
}

/// The name of the object that a primitive is of.
std::string objectOf(const PackedScene &scene, const std::vector<std::string> &names,
                     std::uint32_t primitive) {
    if (primitive == layout::noPrimitive)
        return "the surroundings";
    const auto after =
        std::ranges::upper_bound(scene.places, primitive, {}, &layout::PlaceRecord::firstPrimitive);
    return after == scene.places.begin() ? "?" : names[std::prev(after)->object - 1];
}

/// What the path met, from the eye on, up to where most of its light comes from. Each step is an object, and what the path
/// did there.
std::vector<std::string> pathOf(const PackedScene &scene, const std::vector<layout::TraceEvent> &events) {
    const std::vector<std::string> names = scene.namesOf(Integrator::ObjectNumber);
    std::vector<std::string> steps;
    std::size_t brightest = 0; // the number of steps when most light was added
    std::string brightestEnd;
    glm::vec3 before(0.0f);
    float most = 0.0f;
    std::string object;
    std::string action;
    const auto endStep = [&] {
        if (!object.empty())
            steps.push_back(object + ", " + (action.empty() ? "mirrored" : action));
        action.clear();
    };
    bool isLightSampled = false;
    for (const layout::TraceEvent &event : events) {
        if (event.quantity == layout::traceHit) {
            endStep();
            object = objectOf(scene, names, event.integer);
            isLightSampled = false;
        } else if (event.quantity == layout::traceReflectance) {
            action = "through or off glass";
        } else if (event.quantity == layout::traceScatter) {
            action = "scattered";
        } else if (event.quantity == layout::traceVisibility) {
            isLightSampled = true;
        } else if (event.quantity == layout::traceRadiance) {
            const float added = largestOf(event.value - before);
            before = event.value;
            if (added > most) {
                most = added;
                brightest = steps.size();
                brightestEnd = object + (isLightSampled ? ", lit" : ", whose own light it is");
            }
        }
    }
    steps.resize(brightest);
    steps.push_back(brightestEnd);
    return steps;
}

/// The pixel's brightest sample.
NoisyPixelReport reportOf(const PreparedScene &scene, const Film &film, const Candidate &candidate) {
    const auto across = static_cast<std::size_t>(film.crop.width());
    const layout::FilmPixel &pixel = film.pixels[candidate.pixel];
    const RenderSettings &settings = scene.loaded.settings;
    NoisyPixelReport report;
    report.x = film.crop.x0 + static_cast<int>(candidate.pixel % across);
    report.y = film.crop.y0 + static_cast<int>(candidate.pixel / across);
    report.noise = std::sqrt(candidate.squaredNoise);
    std::vector<layout::TraceEvent> brightest;
    float most = -1.0f;
    for (std::uint32_t sample = 0; sample < std::min(pixel.sampleCount, maxSamples); ++sample) {
        std::vector<layout::TraceEvent> events = reference::trace(
            scene.packed, settings, {report.x, report.y}, sample, reference::Precision::Float32);
        const float radiance = largestOf(radianceOf(events));
        if (radiance > most) {
            most = radiance;
            report.sample = sample;
            brightest = std::move(events);
        }
    }
    const glm::dvec3 sum = sumOf(pixel);
    report.radiance = radianceOf(brightest);
    report.share = static_cast<double>(most) / std::max({sum.x, sum.y, sum.z, 1e-30});
    report.path = pathOf(scene.packed, brightest);
    return report;
}

} // namespace

std::vector<NoisyPixelReport> noisiestPixels(const PreparedScene &scene, const Film &film,
                                             std::span<const Crop> squares) {
    const RenderSettings &settings = scene.loaded.settings;
    if (settings.integrator != Integrator::Path)
        return {};
    std::vector<Candidate> candidates;
    for (const NoiseBlock &block : blocksInFilm(film.crop, squares)) {
        const std::vector<double> noises = squaredNoiseOfPixels(film, block, darknessOf(settings));
        for (std::size_t i = 0; i < noises.size(); ++i)
            if (noises[i] > 0.0)
                candidates.push_back({block.indexOf(i), noises[i]});
    }
    std::ranges::sort(candidates, [](const Candidate &a, const Candidate &b) {
        return a.squaredNoise != b.squaredNoise ? a.squaredNoise > b.squaredNoise : a.pixel < b.pixel;
    });
    const auto across = static_cast<long>(film.crop.width());
    std::vector<Candidate> chosen;
    for (const Candidate &candidate : candidates) {
        if (chosen.size() == wantedPixels)
            break;
        const auto isNear = [&](const Candidate &other) {
            const auto at = static_cast<long>(candidate.pixel);
            const auto there = static_cast<long>(other.pixel);
            return std::abs(at % across - there % across) < distanceApart &&
                   std::abs(at / across - there / across) < distanceApart;
        };
        if (std::ranges::none_of(chosen, isNear))
            chosen.push_back(candidate);
    }
    std::vector<NoisyPixelReport> reports;
    reports.reserve(chosen.size());
    for (const Candidate &candidate : chosen)
        reports.push_back(reportOf(scene, film, candidate));
    return reports;
}

} // namespace hyalite::core
