#include "host/reference/explain.h"

#include "host/reference/divergence.h"

#include <algorithm>
#include <array>

namespace hyalite::core::reference {

namespace {

using layout::TraceEvent;

Cause causeOf(const TraceEvent &a, const TraceEvent &b) {
    if (a.quantity != b.quantity)
        return Cause::Edge;
    if (a.quantity == layout::traceReflectance)
        return Cause::CriticalAngle;
    if (a.quantity != layout::traceVisibility)
        return Cause::Edge;
    const bool isHorizon = a.integer == layout::visibilityUnlit || b.integer == layout::visibilityUnlit;
    return isHorizon ? Cause::LightHorizon : Cause::ShadowBoundary;
}

/// The smallest shift, a power of two in pixels and in one of eight directions, with which the oracle takes the same
/// decisions as `wanted`, up to and including the given event.
std::optional<double> findMargin(const PackedScene &scene, const RenderSettings &settings,
                                 const glm::uvec2 &pixel, const std::vector<TraceEvent> &wanted,
                                 std::uint32_t sampleIndex, std::size_t eventIndex) {
    constexpr std::array<glm::dvec2, 8> directions{{{1.0, 0.0},
                                                    {-1.0, 0.0},
                                                    {0.0, 1.0},
                                                    {0.0, -1.0},
                                                    {0.7, 0.7},
                                                    {-0.7, 0.7},
                                                    {0.7, -0.7},
                                                    {-0.7, -0.7}}};
    for (double distance = 0x1p-24; distance <= 0.25; distance *= 2.0) {
        for (const glm::dvec2 &direction : directions) {
            const std::vector<TraceEvent> moved =
                trace(scene, settings, pixel, sampleIndex, Precision::Float64, direction * distance);
            const std::optional<Divergence> rest =
                findDiscreteDivergence(wanted, moved, scene.frame.firstTriangleId);
            if (!rest || rest->eventIndex > eventIndex)
                return distance;
        }
    }
    return std::nullopt;
}

} // namespace

const char *causeName(Cause cause) {
    switch (cause) {
    case Cause::Edge:
        return "edge";
    case Cause::ShadowBoundary:
        return "shadow boundary";
    case Cause::LightHorizon:
        return "light on the horizon";
    case Cause::CriticalAngle:
        return "critical angle";
    case Cause::Rounding:
        break;
    }
    return "rounding alone";
}

Explanation explainOutlier(const PackedScene &scene, const RenderSettings &settings,
                           const glm::uvec2 &pixel) {
    Explanation explanation;
    for (std::uint32_t sample = 0; sample < static_cast<std::uint32_t>(settings.samplesPerPixel); ++sample) {
        const std::vector<TraceEvent> narrow = trace(scene, settings, pixel, sample, Precision::Float32);
        const std::vector<TraceEvent> wide = trace(scene, settings, pixel, sample, Precision::Float64);
        const std::optional<Divergence> divergence =
            findDiscreteDivergence(narrow, wide, scene.frame.firstTriangleId);
        if (!divergence)
            continue;
        const std::size_t index = divergence->eventIndex;
        explanation.cause =
            index < narrow.size() && index < wide.size() ? causeOf(narrow[index], wide[index]) : Cause::Edge;
        explanation.sampleIndex = sample;
        explanation.rayDepth = divergence->rayDepth;
        explanation.marginPixels = findMargin(scene, settings, pixel, narrow, sample, index);
        break;
    }
    return explanation;
}

} // namespace hyalite::core::reference
