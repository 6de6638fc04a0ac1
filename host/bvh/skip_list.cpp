#include "host/bvh/skip_list.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace hyalite {

namespace {

constexpr double gridCells = 65535.0;

/// A child of a node pair: its box and its reference.
struct Child {
    glm::vec3 lower;
    glm::vec3 upper;
    std::uint32_t reference = layout::noNode;
};

std::array<Child, 2> childrenOf(const layout::NodePair &pair) {
    return {Child{pair.leftLower, pair.leftUpper, pair.left},
            Child{pair.rightLower, pair.rightUpper, pair.right}};
}

/// Writes the list of one octant.
class OctantWriter {
  public:
    OctantWriter(const PackedScene &scene, const SkipList &list, std::uint32_t octant,
                 layout::SkipNode *begin, std::uint32_t firstIndex)
        : scene_(scene), list_(list), octant_(octant), begin_(begin), firstIndex_(firstIndex) {}

    /// Returns how many nodes were written, padding not included.
    std::uint32_t write() {
        // A subtree's `link` is known when everything below it is written: then the entry is met again, as an end.
        struct Task {
            Child child;
            std::uint32_t endOf = layout::noNode; ///< else: the list index of the node that ends here
        };
        std::vector<Task> tasks;
        const auto push = [&](const layout::NodePair &pair) {
            std::array<Child, 2> children = childrenOf(pair);
            if (isFirstFarther(children[0], children[1]))
                std::swap(children[0], children[1]);
            tasks.push_back({children[1]});
            tasks.push_back({children[0]});
        };
        push(scene_.nodes.front());
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            if (task.endOf != layout::noNode) {
                begin_[task.endOf].link = firstIndex_ + count_;
                continue;
            }
            if (task.child.reference == layout::noNode)
                continue;
            layout::SkipNode &node = begin_[count_];
            node.x = planes(task.child, 0);
            node.y = planes(task.child, 1);
            node.z = planes(task.child, 2);
            node.link = task.child.reference;
            if ((task.child.reference & layout::leafFlag) == 0) {
                tasks.push_back({{}, count_});
                push(scene_.nodes[task.child.reference]);
            }
            ++count_;
        }
        return count_;
    }

  private:
    [[nodiscard]] bool isNegative(int axis) const { return (octant_ >> axis & 1u) != 0; }

    /// By the centres, on the axis on which they lie farthest apart.
    [[nodiscard]] bool isFirstFarther(const Child &a, const Child &b) const {
        const glm::vec3 apart = (b.lower / 2.0f + b.upper / 2.0f) - (a.lower / 2.0f + a.upper / 2.0f);
        int axis = std::abs(apart.x) > std::abs(apart.y) ? 0 : 1;
        if (std::abs(apart.z) > std::abs(apart[axis]))
            axis = 2;
        return isNegative(axis) ? apart[axis] > 0.0f : apart[axis] < 0.0f;
    }

    [[nodiscard]] std::uint32_t planes(const Child &child, int axis) const {
        const double origin = list_.gridOrigin[axis];
        const double scale = list_.gridScale[axis];
        const double low = std::floor((child.lower[axis] - origin) / scale);
        const double high = std::ceil((child.upper[axis] - origin) / scale);
        // The grid has room beyond all boxes; a cell more on each side makes up for the rounding of the division.
        const std::uint32_t lower = static_cast<std::uint32_t>(std::clamp(low - 1.0, 0.0, gridCells));
        const std::uint32_t upper = static_cast<std::uint32_t>(std::clamp(high + 1.0, 0.0, gridCells));
        assert(origin + scale * lower <= child.lower[axis] && origin + scale * upper >= child.upper[axis]);
        return isNegative(axis) ? upper | lower << 16 : lower | upper << 16;
    }

    const PackedScene &scene_;
    const SkipList &list_;
    std::uint32_t octant_;
    layout::SkipNode *begin_;
    std::uint32_t firstIndex_;
    std::uint32_t count_ = 0;
};

std::uint32_t countNodes(const PackedScene &scene) {
    std::uint32_t count = 0;
    for (const layout::NodePair &pair : scene.nodes)
        count += (pair.left != layout::noNode ? 1u : 0u) + (pair.right != layout::noNode ? 1u : 0u);
    return count;
}

} // namespace

SkipList makeSkipList(const PackedScene &scene) {
    SkipList list;
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
    const std::uint32_t count = countNodes(scene);
    list.length = count + layout::skipPadding;
    // No ray meets the padding: every plane that is met first lies beyond every other.
    list.nodes.resize(std::size_t{8} * list.length,
                      {0x0000FFFFu, 0x0000FFFFu, 0x0000FFFFu, layout::leafFlag});
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const std::uint32_t first = octant * list.length;
        [[maybe_unused]] const std::uint32_t written =
            OctantWriter(scene, list, octant, list.nodes.data() + first, first).write();
        assert(written == count);
    }
    return list;
}

} // namespace hyalite
