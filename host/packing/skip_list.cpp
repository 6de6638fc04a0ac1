#include "host/packing/skip_list.h"

#include "host/packing/leaf_pairs.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

namespace hyalite::core {

namespace {

constexpr double lowestPlane = -32768.0;
constexpr double highestPlane = 32767.0;
constexpr std::uint32_t listCount = 2;

/// A box in grid cells: a word per axis, with the lower plane in the low half.
struct GridBox {
    std::array<std::uint32_t, 3> planes;
};

/// The data of a node pair that both lists share.
struct PairPlan {
    std::array<GridBox, 2> boxes;       ///< of the left and the right child, if there is one
    std::array<std::uint32_t, 2> links; ///< of children that are leaves
    std::uint32_t nodeCount;            ///< list nodes of both children and their subtrees
    float areaAround; ///< half area of the box that a ray has hit before it comes to the children
    std::array<bool, 2> isLeftOut;
    /// Side of the right child on the axis on which the centres are farthest apart: 1: above; -1: below; 0: neither.
    std::int8_t side;
};

/// The grid of box planes. Coordinates are rounded outwards.
class Grid {
  public:
    explicit Grid(const SkipGrid &grid) : middle_(grid.middle), scale_(grid.scale) {}

    [[nodiscard]] GridBox enclose(const glm::vec3 &lower, const glm::vec3 &upper) const {
        GridBox box{};
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::floor((lower[axis] - middle_[axis]) / scale_[axis]);
            const double high = std::ceil((upper[axis] - middle_[axis]) / scale_[axis]);
            // The grid extends beyond all boxes. One more cell on each side covers the rounding of the division.
            const auto first = static_cast<std::int32_t>(std::clamp(low - 1.0, lowestPlane, highestPlane));
            const auto last = static_cast<std::int32_t>(std::clamp(high + 1.0, lowestPlane, highestPlane));
            assert(middle_[axis] + scale_[axis] * first <= lower[axis] &&
                   middle_[axis] + scale_[axis] * last >= upper[axis]);
            box.planes[static_cast<std::size_t>(axis)] =
                (static_cast<std::uint32_t>(first) & 0xFFFFu) | static_cast<std::uint32_t>(last) << 16;
        }
        return box;
    }

  private:
    glm::dvec3 middle_;
    glm::dvec3 scale_;
};

bool isInner(std::uint32_t reference) { return (reference & layout::leafFlag) == 0; } // and not noNode

/// The link of a leaf, whose reference among the node pairs is given.
std::uint32_t linkOf(const PackedScene &scene, std::uint32_t leaf) {
    if (!scene.hasPairs || layout::isInstance(leaf))
        return leaf;
    const layout::TriangleRecord *const first = &scene.triangles[leaf & ~layout::leafFlag];
    const bool areTwo =
        (first[0].flags & layout::triangleEndsLeaf) == 0 && (first[1].flags & layout::triangleEndsLeaf) != 0;
    return areTwo ? leaf | pairingOf(first[0], first[1]) : leaf;
}

PairPlan planPair(const PackedScene &scene, const layout::NodePair &pair, const Grid &grid) {
    PairPlan plan{};
    const auto planChild = [&](std::size_t child, std::uint32_t reference, const glm::vec3 &lower,
                               const glm::vec3 &upper) {
        if (reference == layout::noNode)
            return;
        plan.boxes[child] = grid.enclose(lower, upper);
        if (!isInner(reference))
            plan.links[child] = linkOf(scene, reference);
    };
    planChild(0, pair.left, pair.leftLower, pair.leftUpper);
    planChild(1, pair.right, pair.rightLower, pair.rightUpper);
    const glm::vec3 apart =
        (pair.rightLower / 2.0f + pair.rightUpper / 2.0f) - (pair.leftLower / 2.0f + pair.leftUpper / 2.0f);
    int axis = std::abs(apart.x) > std::abs(apart.y) ? 0 : 1;
    if (std::abs(apart.z) > std::abs(apart[axis]))
        axis = 2;
    plan.side = static_cast<std::int8_t>((apart[axis] > 0.0f) - (apart[axis] < 0.0f));
    return plan;
}

/// Omits inner nodes that cull too little. A fraction a / A of the rays that hit a box of area A hit an inner box of
/// area a, and only they visit its two children; without the inner box all do. That is A + 2 a steps against 2 A.
void leaveOutNodes(const PackedScene &scene, std::span<PairPlan> plans) {
    for (const PackedTree &tree : scene.trees)
        plans[tree.firstPair].areaAround = static_cast<float>(tree.box.halfArea());
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const layout::NodePair &pair = scene.nodes[i];
        const auto decide = [&](std::size_t child, std::uint32_t reference, const Box &box) {
            if (!isInner(reference))
                return;
            const auto area = static_cast<float>(box.halfArea());
            plans[i].isLeftOut[child] = area > 0.5f * plans[i].areaAround;
            plans[reference].areaAround = plans[i].isLeftOut[child] ? plans[i].areaAround : area;
        };
        decide(0, pair.left, {pair.leftLower, pair.leftUpper});
        decide(1, pair.right, {pair.rightLower, pair.rightUpper});
    }
}

/// Counts list nodes, from the last pair to the first: parents come before their descendants, so the counts below a
/// pair are known.
void countNodes(const PackedScene &scene, std::span<PairPlan> plans) {
    for (std::size_t i = plans.size(); i-- > 0;) {
        const std::array<std::uint32_t, 2> references{scene.nodes[i].left, scene.nodes[i].right};
        for (std::size_t child = 0; child < 2; ++child) {
            const std::uint32_t reference = references[child];
            if (reference == layout::noNode)
                continue;
            assert(!isInner(reference) || reference > i);
            plans[i].nodeCount +=
                (plans[i].isLeftOut[child] ? 0 : 1) + (isInner(reference) ? plans[reference].nodeCount : 0);
        }
    }
}

/// Writes the list from index `begin` on; in it the siblings on `nearSide`, -1 or 1, of their axis come first. No stack
/// is needed, because the nodes above a subtree come first and the size of its sibling is known, which gives its index.
/// `pairBegins` has room for an index per pair.
void writeList(const PackedScene &scene, std::span<const PairPlan> plans, int nearSide, std::uint32_t begin,
               std::span<const SkipTree> trees, std::span<std::uint32_t> pairBegins,
               std::span<layout::SkipNode> nodes) {
    for (std::size_t i = 0; i < trees.size(); ++i)
        pairBegins[scene.trees[i].firstPair] = begin + trees[i].begin;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const PairPlan &plan = plans[i];
        const std::array<std::uint32_t, 2> references{scene.nodes[i].left, scene.nodes[i].right};
        const std::size_t nearChild = plan.side == nearSide ? 1 : 0;
        std::uint32_t index = pairBegins[i];
        for (const std::size_t child : {nearChild, 1 - nearChild}) {
            const std::uint32_t reference = references[child];
            if (reference == layout::noNode)
                continue;
            const std::array<std::uint32_t, 3> &planes = plan.boxes[child].planes;
            if (plan.isLeftOut[child]) {
                pairBegins[reference] = index;
                index += plans[reference].nodeCount;
                continue;
            }
            layout::SkipNode &node = nodes[index++];
            node.x = planes[0];
            node.y = planes[1];
            node.z = planes[2];
            node.link = plan.links[child];
            if (isInner(reference)) {
                pairBegins[reference] = index;
                index += plans[reference].nodeCount;
                node.link = index;
            }
        }
    }
}

/// The grid over a tree.
SkipGrid gridOver(const Box &box) {
    SkipGrid grid;
    if (box.isEmpty())
        return grid;
    for (int axis = 0; axis < 3; ++axis) {
        grid.middle[axis] = box.lower[axis] / 2.0f + box.upper[axis] / 2.0f;
        const double middle = grid.middle[axis];
        // The grid of a flat box is as fine as its coordinates; 16 cells stay free on each side.
        const double reach = std::max(
            {box.upper[axis] - middle, middle - box.lower[axis], 1e-6 * std::max(std::abs(middle), 1e-20)});
        grid.scale[axis] = static_cast<float>(reach / (highestPlane - 16.0));
    }
    return grid;
}

/// The instances of the scene, with where their trees are in the list and the maps from the grids.
std::vector<layout::InstanceRecord> instancesOnGrids(const PackedScene &scene, const SkipList &list) {
    std::vector<layout::InstanceRecord> instances = scene.instances;
    const auto count = static_cast<std::int64_t>(instances.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < count; ++i) {
        layout::InstanceRecord &instance = instances[static_cast<std::size_t>(i)];
        const SkipTree &tree = list.trees[instance.tree + 1];
        const glm::dvec3 middle(tree.grid.middle);
        const glm::dvec3 halfCell = glm::dvec3(tree.grid.scale) / 2.0;
        const auto toGrid = [&](const glm::vec3 &row, float offset, glm::vec3 &gridRow, float &gridOffset) {
            gridRow = glm::vec3(glm::dvec3(row) * halfCell);
            gridOffset = static_cast<float>(glm::dot(glm::dvec3(row), middle) + double{offset});
        };
        toGrid(instance.toX, instance.offsetX, instance.gridToX, instance.gridOffsetX);
        toGrid(instance.toY, instance.offsetY, instance.gridToY, instance.gridOffsetY);
        toGrid(instance.toZ, instance.offsetZ, instance.gridToZ, instance.gridOffsetZ);
        instance.listBegin = tree.begin;
        instance.listEnd = tree.end;
    }
    return instances;
}

} // namespace

SkipList makeSkipList(const PackedScene &scene) {
    SkipList list;
    if (!scene.hasTriangles)
        return list;
    UnsetVector<PairPlan> plans(scene.nodes.size());
    for (std::size_t tree = 0; tree < scene.trees.size(); ++tree) {
        list.trees.push_back({0, 0, gridOver(scene.trees[tree].box)});
        const Grid grid(list.trees.back().grid);
        const std::int64_t first = scene.trees[tree].firstPair;
        const auto end = static_cast<std::int64_t>(
            tree + 1 < scene.trees.size() ? scene.trees[tree + 1].firstPair : scene.nodes.size());
#pragma omp parallel for schedule(static)
        for (std::int64_t i = first; i < end; ++i)
            plans[static_cast<std::size_t>(i)] =
                planPair(scene, scene.nodes[static_cast<std::size_t>(i)], grid);
    }
    leaveOutNodes(scene, plans);
    countNodes(scene, plans);
    for (std::size_t tree = 0; tree < scene.trees.size(); ++tree) {
        list.trees[tree].begin = list.length;
        list.length += plans[scene.trees[tree].firstPair].nodeCount;
        list.trees[tree].end = list.length;
    }
    list.nodes.resize(std::size_t{listCount} * list.length + 1);
    list.nodes.back() = {};
    UnsetVector<std::uint32_t> pairBegins(plans.size() * listCount);
#pragma omp parallel for schedule(static) num_threads(listCount)
    for (std::uint32_t i = 0; i < listCount; ++i)
        writeList(scene, plans, i == 0 ? -1 : 1, i * list.length, list.trees,
                  std::span(pairBegins).subspan(plans.size() * i, plans.size()), list.nodes);
    list.instances = instancesOnGrids(scene, list);
    return list;
}

void SkipList::describe(layout::FrameRecord &frame) const {
    if (!trees.empty()) {
        frame.gridMiddle = trees.front().grid.middle;
        frame.gridScale = trees.front().grid.scale;
        frame.topListLength = trees.front().end;
    }
    frame.skipListLength = length;
}

std::uint64_t maxSkipListBytes(std::size_t pairCount) {
    return (std::uint64_t{listCount} * 2 * pairCount + 1) * sizeof(layout::SkipNode);
}

std::uint64_t skipListWorkBytes(std::size_t pairCount) {
    return pairCount * (sizeof(PairPlan) + listCount * sizeof(std::uint32_t));
}

} // namespace hyalite::core
