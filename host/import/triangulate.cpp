#include "host/import/triangulate.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::size_t leafCornerCount = 16;

enum CornerState : std::uint8_t {
    clipped = 1,  // no longer part of the polygon
    deferred = 2, // next to an ear that was clipped in this round
    queued = 4,   // waits in nextRound_
    reflex = 8,   // not strictly convex
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
    points_.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        points_[i] = glm::dvec2(corners[i][u], corners[i][v]);
}

void Triangulator::linkCorners() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    remaining_ = count;
    previous_.resize(count);
    next_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        previous_[i] = (i == 0 ? count : i) - 1;
        next_[i] = i + 1 == count ? 0 : i + 1;
    }
    state_.assign(count, 0);
    buildTree();
    for (std::uint32_t i = 0; i < count; ++i)
        updateReflex(i);
}

double Triangulator::turn(std::uint32_t corner) const {
    return orient(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

// Builds a k-d tree: halves the corners along the longer side of their bounds until few are left. J. L. Bentley,
// "Multidimensional Binary Search Trees Used for Associative Searching", Communications of the ACM 18 (1975).
void Triangulator::buildTree() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    std::size_t leafCount = 1;
    while (leafCount * leafCornerCount < count)
        leafCount *= 2;
    treeOrder_.resize(count);
    std::iota(treeOrder_.begin(), treeOrder_.end(), 0u);
    leafOf_.resize(count);
    tree_.resize(2 * leafCount);
    tree_[1].begin = 0;
    tree_[1].end = count;
    for (std::uint32_t i = 1; i < tree_.size(); ++i) {
        TreeNode &node = tree_[i];
        node.reflexCount = 0;
        node.low = node.high = points_[treeOrder_[node.begin]];
        for (std::uint32_t k = node.begin; k < node.end; ++k) {
            node.low = glm::min(node.low, points_[treeOrder_[k]]);
            node.high = glm::max(node.high, points_[treeOrder_[k]]);
        }
        if (i >= leafCount) {
            for (std::uint32_t k = node.begin; k < node.end; ++k)
                leafOf_[treeOrder_[k]] = i;
            continue;
        }
        const int axis = node.high.x - node.low.x >= node.high.y - node.low.y ? 0 : 1;
        const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
        const auto at = [&](std::uint32_t k) { return treeOrder_.begin() + k; };
        const auto key = [&](std::uint32_t corner) { // NaN needs a place in the order
            const double coordinate = points_[corner][axis];
            return std::isnan(coordinate) ? std::numeric_limits<double>::infinity() : coordinate;
        };
        std::nth_element(at(node.begin), at(middle), at(node.end),
                         [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        tree_[2 * i].begin = node.begin;
        tree_[2 * i].end = tree_[2 * i + 1].begin = middle;
        tree_[2 * i + 1].end = node.end;
    }
}

void Triangulator::setReflex(std::uint32_t corner, bool isReflex) {
    if (((state_[corner] & reflex) != 0) == isReflex)
        return;
    state_[corner] = static_cast<std::uint8_t>(state_[corner] ^ reflex);
    for (std::uint32_t node = leafOf_[corner]; node > 0; node /= 2)
        tree_[node].reflexCount += isReflex ? 1u : ~0u;
}

void Triangulator::updateReflex(std::uint32_t corner) { setReflex(corner, !(turn(corner) > 0.0)); }

bool Triangulator::isEar(std::uint32_t corner, Ear kind) const {
    if (kind == Ear::Any)
        return true;
    if (state_[corner] & reflex)
        return false;
    return kind == Ear::Convex || !isBlocked(corner, kind);
}

bool Triangulator::isBlocked(std::uint32_t corner, Ear kind) const {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    const glm::dvec2 a = points_[before];
    const glm::dvec2 b = points_[corner];
    const glm::dvec2 c = points_[after];
    const glm::dvec2 low = glm::min(glm::min(a, b), c);
    const glm::dvec2 high = glm::max(glm::max(a, b), c);

    const auto isInside = [&](double ab, double bc, double ca) {
        return kind == Ear::Strict ? ab >= 0.0 && bc >= 0.0 && ca >= 0.0 : ab > 0.0 && bc > 0.0 && ca > 0.0;
    };
    // With its rounding, orient() is monotone in both coordinates of its last point. So no point in a box has a larger
    // value than the corner of the box farthest to the left of the line, and no blocking point is skipped.
    const auto highest = [](const TreeNode &node, const glm::dvec2 &from, const glm::dvec2 &to) {
        return orient(from, to,
                      {to.y > from.y ? node.low.x : node.high.x, to.x > from.x ? node.high.y : node.low.y});
    };
    const auto mayBlock = [&](const TreeNode &node) {
        if (node.reflexCount == 0 || node.low.x > high.x || node.high.x < low.x || node.low.y > high.y ||
            node.high.y < low.y)
            return false;
        const bool holdsTip =
            node.low.x <= b.x && b.x <= node.high.x && node.low.y <= b.y && b.y <= node.high.y;
        return holdsTip || isInside(highest(node, a, b), highest(node, b, c), highest(node, c, a));
    };
    const auto blocks = [&](std::uint32_t candidate) {
        if (!(state_[candidate] & reflex) || candidate == before || candidate == after)
            return false;
        const glm::dvec2 p = points_[candidate];
        if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y)
            return false;
        return isInside(orient(a, b, p), orient(b, c, p), orient(c, a, p)) || p == b;
    };

    std::array<std::uint32_t, 2 * std::numeric_limits<std::uint32_t>::digits> pending; // two per level
    std::size_t pendingCount = 0;
    pending[pendingCount++] = 1;
    while (pendingCount > 0) {
        const std::uint32_t i = pending[--pendingCount];
        const TreeNode &node = tree_[i];
        if (!mayBlock(node))
            continue;
        if (2 * i < tree_.size()) {
            pending[pendingCount++] = 2 * i;
            pending[pendingCount++] = 2 * i + 1;
            continue;
        }
        for (std::uint32_t k = node.begin; k < node.end; ++k)
            if (blocks(treeOrder_[k]))
                return true;
    }
    return false;
}

void Triangulator::queueForNextRound(std::uint32_t corner) {
    if (state_[corner] & queued)
        return;
    state_[corner] = static_cast<std::uint8_t>(state_[corner] | queued);
    nextRound_.push_back(corner);
}

void Triangulator::clip(std::uint32_t corner) {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    triangles_.emplace_back(before, corner, after);
    next_[before] = after;
    previous_[after] = before;
    setReflex(corner, false);
    state_[corner] = clipped;
    --remaining_;
    updateReflex(before);
    updateReflex(after);
    queueForNextRound(before);
    queueForNextRound(after);
    state_[after] = static_cast<std::uint8_t>(state_[after] | deferred);
}

// Each corner is examined once, and again after each clipping beside it: at most 3 n times. The corner after an ear is
// deferred to the next round, so that a convex polygon is halved repeatedly instead of cut into a fan of slivers.
void Triangulator::clipEars(Ear kind) {
    nextRound_.clear();
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 1; i <= count; ++i)
        if (const std::uint32_t corner = i % count; !(state_[corner] & clipped))
            nextRound_.push_back(corner);
    while (!nextRound_.empty() && remaining_ > 3) {
        std::swap(thisRound_, nextRound_);
        nextRound_.clear();
        for (const std::uint32_t corner : thisRound_)
            if (!(state_[corner] & clipped))
                state_[corner] = static_cast<std::uint8_t>(state_[corner] & reflex);
        for (const std::uint32_t corner : thisRound_) {
            if (remaining_ == 3)
                return;
            if (!(state_[corner] & (clipped | deferred)) && isEar(corner, kind))
                clip(corner);
        }
    }
}

std::span<const glm::uvec3> Triangulator::triangulate(std::span<const glm::vec3> corners) {
    assert(corners.size() >= 3 && corners.size() < std::numeric_limits<std::uint32_t>::max());
    triangles_.clear();
    if (corners.size() == 3) {
        triangles_.emplace_back(0, 1, 2);
        return triangles_;
    }
    project(corners);
    linkCorners();
    for (const Ear kind : {Ear::Strict, Ear::Touching, Ear::Convex, Ear::Any})
        if (remaining_ > 3)
            clipEars(kind);
    std::uint32_t first = 0;
    while (state_[first] & clipped)
        ++first;
    triangles_.emplace_back(first, next_[first], next_[next_[first]]);
    return triangles_;
}

} // namespace hyalite::core
