#include "host/reference/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

namespace hyalite::core {

namespace {

using layout::TraceEvent;

constexpr std::array<std::string_view, layout::traceQuantityCount> quantityNames{
    "ray origin",  "ray direction",    "hit",      "surface position",   "surface normal", "throughput",
    "reflectance", "light visibility", "radiance", "scattered direction"};

std::string floatText(float value) {
    return fmt::format("{:.9g} (0x{:08x})", value, std::bit_cast<std::uint32_t>(value));
}

std::string vectorText(const glm::vec3 &v) {
    return fmt::format("({}, {}, {})", floatText(v.x), floatText(v.y), floatText(v.z));
}

/// Bits are those of the scene's coordinates.
std::string pointText(const glm::vec3 &v, const glm::dvec3 &origin) {
    if (origin == glm::dvec3(0.0))
        return vectorText(v);
    const auto text = [&](glm::length_t axis) {
        return fmt::format("{:.15g} (0x{:08x})", static_cast<double>(v[axis]) + origin[axis],
                           std::bit_cast<std::uint32_t>(v[axis]));
    };
    return fmt::format("({}, {}, {})", text(0), text(1), text(2));
}

std::string primitiveText(std::uint32_t id, std::uint32_t firstTriangleId) {
    if (id == layout::noPrimitive)
        return "none";
    return id < firstTriangleId ? fmt::format("sphere {}", id)
                                : fmt::format("triangle {}", id - firstTriangleId);
}

std::string visibilityText(const TraceEvent &event) {
    constexpr std::array<std::string_view, 4> words{"on the unlit side", "blocked", "dimmed by glass",
                                                    "clear"};
    return fmt::format("light {} {}", static_cast<int>(event.value.x),
                       event.integer < words.size() ? words[event.integer] : "?");
}

std::string nameOf(std::uint32_t quantity) {
    return std::string(quantity < quantityNames.size() ? quantityNames[quantity] : "?");
}

std::string valueText(const TraceEvent &event, std::uint32_t firstTriangleId, const glm::dvec3 &origin) {
    switch (event.quantity) {
    case layout::traceHit:
        return fmt::format("{} at distance {}", primitiveText(event.integer, firstTriangleId),
                           floatText(event.value.x));
    case layout::traceVisibility:
        return visibilityText(event);
    case layout::traceReflectance:
        return (event.integer != 0 ? "total, " : "") + floatText(event.value.x);
    case layout::traceRayOrigin:
    case layout::traceSurfacePosition:
        return pointText(event.value, origin);
    case layout::traceScatter:
        return fmt::format("{}, pdf {}", vectorText(event.value),
                           floatText(std::bit_cast<float>(event.integer)));
    default:
        return vectorText(event.value);
    }
}

bool areSameBits(const glm::vec3 &a, const glm::vec3 &b) {
    return std::bit_cast<std::array<std::uint32_t, 3>>(a) == std::bit_cast<std::array<std::uint32_t, 3>>(b);
}

bool isSameDecision(const TraceEvent &a, const TraceEvent &b) {
    return a.quantity == b.quantity && a.rayDepth == b.rayDepth && a.integer == b.integer;
}

Divergence describe(const TraceEvent &a, const TraceEvent &b, std::size_t index,
                    std::uint32_t firstTriangleId, const glm::dvec3 &origin) {
    Divergence divergence;
    divergence.sampleIndex = a.sampleIndex;
    divergence.rayDepth = a.rayDepth;
    divergence.isDiscrete = !isSameDecision(a, b);
    divergence.eventIndex = static_cast<std::uint32_t>(index);
    if (a.quantity != b.quantity || a.rayDepth != b.rayDepth) {
        divergence.quantity = "what comes next";
        divergence.valueA = fmt::format("{} at depth {}", nameOf(a.quantity), a.rayDepth);
        divergence.valueB = fmt::format("{} at depth {}", nameOf(b.quantity), b.rayDepth);
        return divergence;
    }
    divergence.quantity = nameOf(a.quantity);
    if (a.quantity == layout::traceHit && a.integer == b.integer) {
        const bool isDistance =
            std::bit_cast<std::uint32_t>(a.value.x) != std::bit_cast<std::uint32_t>(b.value.x);
        divergence.quantity = isDistance ? "hit distance" : "hit weights";
        divergence.valueA = isDistance ? floatText(a.value.x) : vectorText(a.value);
        divergence.valueB = isDistance ? floatText(b.value.x) : vectorText(b.value);
    } else {
        if (a.quantity == layout::traceHit)
            divergence.quantity = "hit primitive";
        divergence.valueA = valueText(a, firstTriangleId, origin);
        divergence.valueB = valueText(b, firstTriangleId, origin);
    }
    return divergence;
}

template <class IsSame>
std::optional<Divergence> findFirst(const std::vector<TraceEvent> &a, const std::vector<TraceEvent> &b,
                                    std::uint32_t firstTriangleId, const glm::dvec3 &origin, IsSame isSame) {
    const std::size_t common = std::min(a.size(), b.size());
    for (std::size_t i = 0; i < common; ++i)
        if (!isSame(a[i], b[i]))
            return describe(a[i], b[i], i, firstTriangleId, origin);
    if (a.size() == b.size())
        return std::nullopt;
    Divergence divergence;
    const TraceEvent &last = a.size() > common ? a[common] : b[common];
    divergence.sampleIndex = last.sampleIndex;
    divergence.rayDepth = last.rayDepth;
    divergence.quantity = "what comes next";
    divergence.valueA = a.size() > common ? "the path goes on" : "the path ends";
    divergence.valueB = b.size() > common ? "the path goes on" : "the path ends";
    divergence.isDiscrete = true;
    divergence.eventIndex = static_cast<std::uint32_t>(common);
    return divergence;
}

} // namespace

std::vector<TraceStep> describeTrace(const std::vector<TraceEvent> &trace, std::uint32_t firstTriangleId,
                                     const glm::dvec3 &origin) {
    std::vector<TraceStep> steps;
    steps.reserve(trace.size());
    for (const TraceEvent &event : trace)
        steps.push_back({event.rayDepth, nameOf(event.quantity), valueText(event, firstTriangleId, origin)});
    return steps;
}

std::optional<Divergence> findDivergence(const std::vector<TraceEvent> &a, const std::vector<TraceEvent> &b,
                                         std::uint32_t firstTriangleId, const glm::dvec3 &origin) {
    return findFirst(a, b, firstTriangleId, origin, [](const TraceEvent &x, const TraceEvent &y) {
        return isSameDecision(x, y) && areSameBits(x.value, y.value);
    });
}

std::optional<Divergence> findDiscreteDivergence(const std::vector<TraceEvent> &a,
                                                 const std::vector<TraceEvent> &b,
                                                 std::uint32_t firstTriangleId) {
    return findFirst(a, b, firstTriangleId, glm::dvec3(0.0), isSameDecision);
}

} // namespace hyalite::core
