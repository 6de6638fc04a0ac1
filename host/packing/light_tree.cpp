#include "host/packing/light_tree.h"

#include "host/bvh/bvh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace hyalite::core {

namespace {

constexpr int binCount = 12;
constexpr std::ptrdiff_t smallTask = 4096; ///< lights that a thread takes in one piece

double sineOf(double cosine) { return std::sqrt(std::max(1.0 - cosine * cosine, 0.0)); }

/// Of the sum of two angles in [0, pi], or -1 if it exceeds pi.
double cosineOfSum(double cosineA, double cosineB) {
    const double sineA = sineOf(cosineA);
    const double sineB = sineOf(cosineB);
    return sineA * cosineB + cosineA * sineB < 0.0 ? -1.0 : cosineA * cosineB - sineA * sineB;
}

/// A set of lights, with bounds on their directions.
struct Cluster {
    Box box;
    glm::dvec3 axis{0.0};
    double cosineNormals = 1.0;
    double cosineEmission = 1.0;
    double intensity = 0.0;
    bool isTwoSided = false;

    Cluster() = default;
    explicit Cluster(const TreeLight &light)
        : box{light.lower, light.upper}, axis(light.axis), cosineNormals(light.cosineNormals),
          cosineEmission(light.cosineEmission), intensity(light.intensity), isTwoSided(light.isTwoSided) {}

    void add(const Cluster &other) {
        if (other.intensity == 0.0)
            return;
        if (intensity == 0.0) {
            *this = other;
            return;
        }
        box.extend(other.box);
        addDirections(other);
        cosineEmission = std::min(cosineEmission, other.cosineEmission);
        intensity += other.intensity;
    }

    /// In proportion to the surface of a sphere around the lights, the solid angle of their normals and their
    /// intensity.
    [[nodiscard]] double cost() const {
        if (intensity == 0.0)
            return 0.0;
        // The fourth root is close to the measure of a cone by Conty and Kulla, as a share of that of all directions.
        const double cone = 0.25 + 0.75 * std::sqrt(std::sqrt((1.0 - cosineNormals) / 2.0));
        const glm::dvec3 diagonal = glm::dvec3(box.upper) - glm::dvec3(box.lower);
        return intensity * glm::dot(diagonal, diagonal) * cone * (isTwoSided ? 2.0 : 1.0);
    }

  private:
    /// The axis moves to a mean of both, and the angle takes in the wider of the two cones.
    void addDirections(const Cluster &other) {
        isTwoSided = isTwoSided || other.isTwoSided;
        if (cosineNormals <= -1.0 || other.cosineNormals <= -1.0) {
            cosineNormals = -1.0;
            return;
        }
        const glm::dvec3 turned = isTwoSided && glm::dot(axis, other.axis) < 0.0 ? -other.axis : other.axis;
        const glm::dvec3 sum = axis * intensity + turned * other.intensity;
        const double length = glm::length(sum);
        if (!(length > 1e-6 * (intensity + other.intensity))) {
            cosineNormals = -1.0;
            return;
        }
        const glm::dvec3 mean = sum / length;
        const auto around = [&](const glm::dvec3 &of, double cosine) {
            return cosineOfSum(std::clamp(glm::dot(mean, of), -1.0, 1.0), cosine);
        };
        cosineNormals = std::min(around(axis, cosineNormals), around(turned, other.cosineNormals));
        axis = mean;
    }
};

layout::LightNode nodeOf(const Cluster &cluster, double parentIntensity, std::uint32_t reference) {
    layout::LightNode node{};
    const glm::dvec3 lower(cluster.box.lower);
    const glm::dvec3 upper(cluster.box.upper);
    node.centre = glm::vec3(0.5 * (lower + upper));
    const glm::dvec3 reach = glm::max(upper - glm::dvec3(node.centre), glm::dvec3(node.centre) - lower);
    constexpr double up = 1.0 + 1e-6; // more than the rounding of this, and of the shader's distance
    node.squaredRadius = static_cast<float>(glm::dot(reach, reach) * up);
    constexpr double leastShare = 1e-9; // products of it do not leave the range of floats
    node.share = static_cast<float>(std::clamp(cluster.intensity / parentIntensity, leastShare, 1.0));
    node.axis = glm::vec3(cluster.axis);
    node.cosineNormals = static_cast<float>(cluster.cosineNormals);
    node.sineNormals = static_cast<float>(sineOf(cluster.cosineNormals));
    node.cosineEmission = static_cast<float>(cluster.cosineEmission);
    node.reference = reference | (cluster.isTwoSided ? layout::lightNodeIsTwoSided : 0u);
    return node;
}

/// A light, and where it stands along each axis.
struct Item {
    TreeLight light;
    std::uint32_t index;

    [[nodiscard]] float place(int axis) const { return light.lower[axis] / 2.0f + light.upper[axis] / 2.0f; }
};

/// Lights with the clusters of both halves.
struct Split {
    std::size_t leftCount = 0;
    Cluster left;
    Cluster right;
};

class Builder {
  public:
    Builder(std::vector<Item> items, LightTree &tree) : items_(std::move(items)), tree_(tree) {}

    void build() {
        Cluster all;
        for (const Item &item : items_)
            all.intensity += static_cast<double>(item.light.intensity);
#pragma omp parallel if (std::ssize(items_) > smallTask)
#pragma omp single
        grow(std::span(items_), 0, 0, 0, all.intensity);
    }

  private:
    /// Writes the children of a node with these lights at `first`; those below them follow.
    void grow(std::span<Item> items, std::uint32_t first, int depth, std::uint32_t turns, double intensity) {
        const Split split = divide(items, depth);
        const auto left = items.first(split.leftCount);
        const auto right = items.subspan(split.leftCount);
        // Each subtree has two nodes for every light but one.
        const std::uint32_t below = first + 2;
        const auto afterLeft = static_cast<std::uint32_t>(below + 2 * (left.size() - 1));
        const std::uint32_t rightTurns = turns | 1u << depth;
        place(left, first, below, turns, split.left, intensity);
        place(right, first + 1, afterLeft, rightTurns, split.right, intensity);
        const double leftIntensity = split.left.intensity;
        const double rightIntensity = split.right.intensity;
        if (left.size() > 1) {
#pragma omp task default(none)                                                                               \
    firstprivate(left, below, depth, turns, leftIntensity) if (left.size() > smallTask)
            grow(left, below, depth + 1, turns, leftIntensity);
        }
        if (right.size() > 1)
            grow(right, afterLeft, depth + 1, rightTurns, rightIntensity);
    }

    void place(std::span<const Item> items, std::uint32_t node, std::uint32_t children, std::uint32_t turns,
               const Cluster &cluster, double parentIntensity) {
        const bool isLeaf = items.size() == 1;
        if (isLeaf)
            tree_.turns[items.front().index] = turns;
        tree_.nodes[node] = nodeOf(cluster, parentIntensity,
                                   isLeaf ? layout::leafFlag | items.front().light.emitter : children);
    }

    [[nodiscard]] static Split divide(std::span<Item> items, int depth) {
        Box places;
        for (const Item &item : items)
            places.extend(glm::vec3(item.place(0), item.place(1), item.place(2)));
        const glm::vec3 extent = places.upper - places.lower;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
        const bool mustHalve = depth + static_cast<int>(std::bit_width(items.size())) >=
                               static_cast<int>(layout::maxLightTreeDepth);
        if (extent[axis] > 0.0f && !mustHalve)
            if (const Split split = divideByBins(items, axis, places.lower[axis], extent[axis]);
                split.leftCount > 0)
                return split;
        return halve(items, axis);
    }

    /// `leftCount` is 0 if all lights are in one bin.
    [[nodiscard]] static Split divideByBins(std::span<Item> items, int axis, float lower, float extent) {
        const auto binOf = [&](const Item &item) {
            const float share = (item.place(axis) - lower) / extent;
            return std::clamp(static_cast<int>(share * binCount), 0, binCount - 1);
        };
        std::array<Cluster, binCount> bins;
        for (const Item &item : items)
            bins[static_cast<std::size_t>(binOf(item))].add(Cluster(item.light));
        std::array<Cluster, binCount> above; // of each bin, and those after it
        Cluster sum;
        for (std::size_t i = binCount; i-- > 0;) {
            sum.add(bins[i]);
            above[i] = sum;
        }
        Split best;
        int bestCut = 0;
        double bestCost = std::numeric_limits<double>::infinity();
        Cluster below;
        for (int cut = 1; cut < binCount; ++cut) {
            below.add(bins[static_cast<std::size_t>(cut - 1)]);
            const Cluster &rest = above[static_cast<std::size_t>(cut)];
            if (below.intensity == 0.0 || rest.intensity == 0.0)
                continue;
            if (const double cost = below.cost() + rest.cost(); cost < bestCost) {
                bestCost = cost;
                bestCut = cut;
                best.left = below;
                best.right = rest;
            }
        }
        if (bestCut > 0)
            best.leftCount = static_cast<std::size_t>(
                std::stable_partition(items.begin(), items.end(),
                                      [&](const Item &item) { return binOf(item) < bestCut; }) -
                items.begin());
        return best;
    }

    [[nodiscard]] static Split halve(std::span<Item> items, int axis) {
        Split split;
        split.leftCount = items.size() / 2;
        std::sort(items.begin(), items.end(), [&](const Item &a, const Item &b) {
            return a.place(axis) != b.place(axis) ? a.place(axis) < b.place(axis) : a.index < b.index;
        });
        for (std::size_t i = 0; i < items.size(); ++i)
            (i < split.leftCount ? split.left : split.right).add(Cluster(items[i].light));
        return split;
    }

    std::vector<Item> items_;
    LightTree &tree_;
};

} // namespace

LightTree buildLightTree(std::span<const TreeLight> lights) {
    assert(lights.size() >= 2);
    std::vector<Item> items;
    items.reserve(lights.size());
    for (const TreeLight &light : lights)
        items.push_back({light, static_cast<std::uint32_t>(items.size())});
    LightTree tree;
    tree.nodes.resize(2 * (lights.size() - 1));
    tree.turns.resize(lights.size());
    Builder(std::move(items), tree).build();
    return tree;
}

} // namespace hyalite::core
