#include "host/bvh/skip_list.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

namespace hyalite {

namespace {

constexpr double gridCells = 65535.0;

/// A box in cells of the grid, an axis a word: the lower plane in the low half.
struct GridBox {
    std::array<std::uint32_t, 3> planes;
};

/// What the lists of all octants have in common for the children of a node pair.
struct PairPlan {
    std::array<GridBox, 2> boxes; ///< of the left and the right child, if there is one
    std::uint32_t nodeCount;      ///< list nodes of both children, all below included
    std::uint8_t axis;            ///< on which their centres lie farthest apart
    std::int8_t side; ///< of the right child there: 1 where it is on the upper one, 0 where none is
};

/// The grid on which planes lie: coordinates are rounded outwards.
class Grid {
  public:
    explicit Grid(const SkipList &list) : origin_(list.gridOrigin), scale_(list.gridScale) {}

    [[nodiscard]] GridBox enclose(const glm::vec3 &lower, const glm::vec3 &upper) const {
        GridBox box{};
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::floor((lower[axis] - origin_[axis]) / scale_[axis]);
            const double high = std::ceil((upper[axis] - origin_[axis]) / scale_[axis]);
            // The grid has room beyond all boxes; a cell more on each side makes up for the rounding of the division.
            const auto first = static_cast<std::uint32_t>(std::clamp(low - 1.0, 0.0, gridCells));
            const auto last = static_cast<std::uint32_t>(std::clamp(high + 1.0, 0.0, gridCells));
            assert(origin_[axis] + scale_[axis] * first <= lower[axis] &&
                   origin_[axis] + scale_[axis] * last >= upper[axis]);
            box.planes[static_cast<std::size_t>(axis)] = first | last << 16;
        }
        return box;
    }

  private:
    glm::dvec3 origin_;
    glm::dvec3 scale_;
};

bool isInner(std::uint32_t reference) { return (reference & layout::leafFlag) == 0; } // and not noNode

PairPlan planPair(const layout::NodePair &pair, const Grid &grid) {
    PairPlan plan{};
    if (pair.left != layout::noNode)
        plan.boxes[0] = grid.enclose(pair.leftLower, pair.leftUpper);
    if (pair.right != layout::noNode)
        plan.boxes[1] = grid.enclose(pair.rightLower, pair.rightUpper);
    const glm::vec3 apart =
        (pair.rightLower / 2.0f + pair.rightUpper / 2.0f) - (pair.leftLower / 2.0f + pair.leftUpper / 2.0f);
    int axis = std::abs(apart.x) > std::abs(apart.y) ? 0 : 1;
    if (std::abs(apart.z) > std::abs(apart[axis]))
        axis = 2;
    plan.axis = static_cast<std::uint8_t>(axis);
    plan.side = static_cast<std::int8_t>((apart[axis] > 0.0f) - (apart[axis] < 0.0f));
    return plan;
}

/// Pairs come before those below them: their counts are known when they are met from the end.
void countNodes(const PackedScene &scene, std::vector<PairPlan> &plans) {
    for (std::size_t i = plans.size(); i-- > 0;) {
        for (const std::uint32_t child : {scene.nodes[i].left, scene.nodes[i].right}) {
            if (child == layout::noNode)
                continue;
            assert(!isInner(child) || child > i);
            plans[i].nodeCount += 1 + (isInner(child) ? plans[child].nodeCount : 0);
        }
    }
}

/// Writes a list in the order that suits `octant`, with planes turned for `planesOctant`; it begins at the index
/// `begin`. Where a subtree begins is known before it is written, as all nodes above come first and its sibling's size
/// is known: no stack is needed. `pairBegins` is room for an index a pair.
void writeList(const PackedScene &scene, std::span<const PairPlan> plans, std::uint32_t octant,
               std::uint32_t planesOctant, std::uint32_t begin, std::span<std::uint32_t> pairBegins,
               std::span<layout::SkipNode> nodes) {
    const std::array<int, 3> turns{(planesOctant & 1u) != 0 ? 16 : 0, (planesOctant & 2u) != 0 ? 16 : 0,
                                   (planesOctant & 4u) != 0 ? 16 : 0};
    pairBegins[0] = begin;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const PairPlan &plan = plans[i];
        const std::array<std::uint32_t, 2> references{scene.nodes[i].left, scene.nodes[i].right};
        const int nearSide = (octant >> plan.axis & 1u) != 0 ? 1 : -1;
        const std::size_t nearChild = plan.side == nearSide ? 1 : 0;
        std::uint32_t index = pairBegins[i];
        for (const std::size_t child : {nearChild, 1 - nearChild}) {
            const std::uint32_t reference = references[child];
            if (reference == layout::noNode)
                continue;
            const std::array<std::uint32_t, 3> &planes = plan.boxes[child].planes;
            layout::SkipNode &node = nodes[index++];
            node.x = std::rotl(planes[0], turns[0]);
            node.y = std::rotl(planes[1], turns[1]);
            node.z = std::rotl(planes[2], turns[2]);
            node.link = reference;
            if (isInner(reference)) {
                pairBegins[reference] = index;
                index += plans[reference].nodeCount;
                node.link = index;
            }
        }
    }
}

} // namespace

SkipList makeSkipList(const PackedScene &scene, std::uint32_t orderCount) {
    assert(orderCount == 1 || orderCount == 2 || orderCount == 8);
    SkipList list;
    list.orderCount = orderCount;
    if (!scene.hasTriangles)
        return list;
    const glm::vec3 lower = scene.frame.boundsLower;
    const glm::vec3 upper = scene.frame.boundsUpper;
    for (int axis = 0; axis < 3; ++axis) {
        // Flat boxes get a grid as fine as their coordinates; 16 cells stay free on each side.
        const double extent = std::max(static_cast<double>(upper[axis]) - lower[axis],
                                       1e-6 * std::max(std::abs(lower[axis]), 1e-30f));
        list.gridScale[axis] = static_cast<float>(extent / (gridCells - 32.0));
        list.gridOrigin[axis] = static_cast<float>(lower[axis] - 16.0 * list.gridScale[axis]);
    }
    const auto pairCount = static_cast<std::int64_t>(scene.nodes.size());
    std::vector<PairPlan> plans(scene.nodes.size());
    const Grid grid(list);
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < pairCount; ++i)
        plans[static_cast<std::size_t>(i)] = planPair(scene.nodes[static_cast<std::size_t>(i)], grid);
    countNodes(scene, plans);

    list.length = plans.front().nodeCount;
    list.nodes.resize(std::size_t{orderCount} * list.length);
    const int threadCount = std::min(omp_get_max_threads(), static_cast<int>(orderCount));
    std::vector<std::uint32_t> pairBegins(plans.size() * static_cast<std::size_t>(threadCount));
#pragma omp parallel for schedule(dynamic) num_threads(threadCount)
    for (std::uint32_t order = 0; order < orderCount; ++order) {
        const std::uint32_t octant = orderCount == 8 ? order : order * 7;
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        writeList(scene, plans, octant, orderCount == 8 ? octant : 0, order * list.length,
                  std::span(pairBegins).subspan(plans.size() * thread, plans.size()), list.nodes);
    }
    return list;
}

} // namespace hyalite
