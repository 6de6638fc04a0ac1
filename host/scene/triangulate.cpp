#include "host/scene/triangulate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace hyalite {

namespace {

constexpr std::uint32_t notReflex = std::numeric_limits<std::uint32_t>::max();

enum CornerState : std::uint8_t {
    clipped = 1,  // no longer part of the polygon
    deferred = 2, // next to an ear that was clipped in this round
    queued = 4,   // waits in nextRound
};

// Twice the signed area of abc, > 0 where it turns counter-clockwise. The coordinates are floats: in double
// the differences are exact as long as the exponents are less than 29 apart, and so is the sign, nearly always.
double orient(const glm::dvec2 &a, const glm::dvec2 &b, const glm::dvec2 &c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

glm::dvec3 newellNormal(std::span<const glm::vec3> corners) {
    const glm::dvec3 origin(corners[0]);
    glm::dvec3 normal(0.0);
    glm::dvec3 a(0.0);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const glm::dvec3 b = glm::dvec3(corners[i]) - origin;
        normal += glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        a = b;
    }
    return normal;
}

} // namespace

// Drops the axis along which the normal is longest. For a planar polygon this is an affine picture of its
// plane, and unlike coordinates in a rotated frame it keeps the corners' bits: collinear stays collinear.
void Triangulator::project(std::span<const glm::vec3> corners) {
    const glm::dvec3 normal = newellNormal(corners);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis]))
            axis = i;
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (normal[axis] < 0.0)
        std::swap(u, v);
    points.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        points[i] = glm::dvec2(corners[i][u], corners[i][v]);
}

void Triangulator::linkCorners() {
    const auto count = static_cast<std::uint32_t>(points.size());
    remaining = count;
    previous.resize(count);
    next.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        previous[i] = (i == 0 ? count : i) - 1;
        next[i] = i + 1 == count ? 0 : i + 1;
    }
    state.assign(count, 0);
    reflexSlot.assign(count, notReflex);
    reflex.clear();
    for (std::uint32_t i = 0; i < count; ++i)
        updateReflex(i);
}

double Triangulator::turn(std::uint32_t corner) const {
    return orient(points[previous[corner]], points[corner], points[next[corner]]);
}

void Triangulator::forgetReflex(std::uint32_t corner) {
    const std::uint32_t slot = reflexSlot[corner];
    if (slot == notReflex)
        return;
    reflex[slot] = reflex.back();
    reflexSlot[reflex[slot].corner] = slot;
    reflex.pop_back();
    reflexSlot[corner] = notReflex;
}

void Triangulator::updateReflex(std::uint32_t corner) {
    if (turn(corner) > 0.0) {
        forgetReflex(corner);
    } else if (reflexSlot[corner] == notReflex) {
        reflexSlot[corner] = static_cast<std::uint32_t>(reflex.size());
        reflex.push_back({points[corner], corner});
    }
}

bool Triangulator::isEar(std::uint32_t corner, Ear kind) const {
    if (kind == Ear::Any)
        return true;
    if (reflexSlot[corner] != notReflex)
        return false;
    if (kind == Ear::Convex)
        return true;

    const std::uint32_t before = previous[corner];
    const std::uint32_t after = next[corner];
    const glm::dvec2 a = points[before];
    const glm::dvec2 b = points[corner];
    const glm::dvec2 c = points[after];
    const glm::dvec2 low(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}));
    const glm::dvec2 high(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}));
    for (const ReflexCorner &candidate : reflex) {
        const glm::dvec2 p = candidate.point;
        if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y)
            continue;
        if (candidate.corner == before || candidate.corner == after)
            continue;
        const double ab = orient(a, b, p);
        const double bc = orient(b, c, p);
        const double ca = orient(c, a, p);
        const bool blocks = kind == Ear::Strict ? ab >= 0.0 && bc >= 0.0 && ca >= 0.0
                                                : (ab > 0.0 && bc > 0.0 && ca > 0.0) || p == b;
        if (blocks)
            return false;
    }
    return true;
}

void Triangulator::queueForNextRound(std::uint32_t corner) {
    if (state[corner] & queued)
        return;
    state[corner] = static_cast<std::uint8_t>(state[corner] | queued);
    nextRound.push_back(corner);
}

void Triangulator::clip(std::uint32_t corner) {
    const std::uint32_t before = previous[corner];
    const std::uint32_t after = next[corner];
    triangles.emplace_back(before, corner, after);
    next[before] = after;
    previous[after] = before;
    state[corner] = clipped;
    forgetReflex(corner);
    --remaining;
    updateReflex(before);
    updateReflex(after);
    queueForNextRound(before);
    queueForNextRound(after);
    state[after] = static_cast<std::uint8_t>(state[after] | deferred);
}

// A corner is looked at once, and again after each clipping beside it: at most 3 n looks. The corner after an
// ear waits for the next round, so that a convex polygon is cut down by halves instead of into a fan of slivers.
void Triangulator::clipEars(Ear kind) {
    nextRound.clear();
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 1; i <= count; ++i)
        if (const std::uint32_t corner = i % count; !(state[corner] & clipped))
            nextRound.push_back(corner);
    while (!nextRound.empty() && remaining > 3) {
        std::swap(thisRound, nextRound);
        nextRound.clear();
        for (const std::uint32_t corner : thisRound)
            if (!(state[corner] & clipped))
                state[corner] = 0;
        for (const std::uint32_t corner : thisRound) {
            if (remaining == 3)
                return;
            if (!(state[corner] & (clipped | deferred)) && isEar(corner, kind))
                clip(corner);
        }
    }
}

std::span<const glm::uvec3> Triangulator::triangulate(std::span<const glm::vec3> corners) {
    assert(corners.size() >= 3 && corners.size() < notReflex);
    triangles.clear();
    if (corners.size() == 3) {
        triangles.emplace_back(0, 1, 2);
        return triangles;
    }
    project(corners);
    linkCorners();
    for (const Ear kind : {Ear::Strict, Ear::Touching, Ear::Convex, Ear::Any})
        if (remaining > 3)
            clipEars(kind);
    std::uint32_t first = 0;
    while (state[first] & clipped)
        ++first;
    triangles.emplace_back(first, next[first], next[next[first]]);
    return triangles;
}

} // namespace hyalite
