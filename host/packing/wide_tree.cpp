#include "host/packing/wide_tree.h"

#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace hyalite::core {

namespace {

constexpr std::size_t maxChildren = 8;

struct Child {
    std::uint32_t reference = layout::noNode;
    Box box;

    [[nodiscard]] bool isInner() const { return (reference & layout::leafFlag) == 0; }
};

struct Children {
    std::array<Child, maxChildren> all;
    std::size_t count = 0;

    void add(const layout::NodePair &pair) {
        for (const Child &child : {Child{pair.left, {pair.leftLower, pair.leftUpper}},
                                   Child{pair.right, {pair.rightLower, pair.rightUpper}}})
            if (child.reference != layout::noNode)
                all[count++] = child;
    }
};

/// The descendants of a pair that are the children of its wide node.
Children childrenOf(const PackedScene &scene, std::uint32_t pair) {
    Children children;
    children.add(scene.nodes[pair]);
    while (children.count < maxChildren) {
        const auto end = children.all.begin() + static_cast<std::ptrdiff_t>(children.count);
        const auto largest = std::max_element(children.all.begin(), end, [](const Child &a, const Child &b) {
            const auto areaOf = [](const Child &child) {
                return child.isInner() ? child.box.halfArea() : -1.0;
            };
            return areaOf(a) < areaOf(b);
        });
        if (largest == end || !largest->isInner())
            break;
        const std::uint32_t opened = largest->reference;
        *largest = children.all[--children.count];
        children.add(scene.nodes[opened]);
    }
    return children;
}

/// A slot for each child: pairs of both by how far the child lies in the slot's octant, the farthest first.
std::array<Child, maxChildren> inSlots(const Children &children, const glm::vec3 &middle) {
    std::array<Child, maxChildren> slots;
    std::array<bool, maxChildren> isPlaced{};
    for (std::size_t round = 0; round < children.count; ++round) {
        float best = -std::numeric_limits<float>::infinity();
        std::size_t bestChild = 0;
        std::size_t bestSlot = 0;
        for (std::size_t i = 0; i < children.count; ++i) {
            if (isPlaced[i])
                continue;
            const Box &box = children.all[i].box;
            const glm::vec3 towards = box.lower / 2.0f + box.upper / 2.0f - middle;
            for (std::size_t slot = 0; slot < maxChildren; ++slot) {
                const float along = ((slot & 1) != 0 ? towards.x : -towards.x) +
                                    ((slot & 2) != 0 ? towards.y : -towards.y) +
                                    ((slot & 4) != 0 ? towards.z : -towards.z);
                if (slots[slot].reference != layout::noNode || !(along > best))
                    continue;
                best = along;
                bestChild = i;
                bestSlot = slot;
            }
        }
        isPlaced[bestChild] = true;
        slots[bestSlot] = children.all[bestChild];
    }
    return slots;
}

float cellOf(std::uint32_t exponent) { return std::bit_cast<float>(exponent << 23); }

/// The least exponent of a cell by which 255 cells from `origin` reach `end`.
std::uint32_t exponentFor(float origin, float end) {
    // Cells of subnormal size would be 0 on devices that flush them.
    int exponent = 1;
    if (end > origin)
        std::frexp((double{end} - double{origin}) / 255.0, &exponent);
    auto biased = static_cast<std::uint32_t>(std::clamp(exponent + 126, 1, 254));
    while (origin + cellOf(biased) * 255.0f < end)
        ++biased;
    return biased;
}

/// The last byte whose plane is at or below the coordinate.
std::uint32_t byteBelow(float origin, float cell, float coordinate) {
    auto byte = static_cast<std::uint32_t>(
        std::clamp(std::floor((double{coordinate} - double{origin}) / double{cell}), 0.0, 255.0));
    while (byte > 0 && origin + cell * static_cast<float>(byte) > coordinate)
        --byte;
    return byte;
}

/// The first byte whose plane is at or above the coordinate.
std::uint32_t byteAbove(float origin, float cell, float coordinate) {
    auto byte = static_cast<std::uint32_t>(
        std::clamp(std::ceil((double{coordinate} - double{origin}) / double{cell}), 0.0, 255.0));
    while (byte < 255 && origin + cell * static_cast<float>(byte) < coordinate)
        ++byte;
    return byte;
}

/// Puts a byte into the words of an axis.
void putByte(std::uint32_t &first, std::uint32_t &last, std::size_t slot, std::uint32_t byte) {
    (slot < 4 ? first : last) |= byte << 8 * (slot & 3);
}

layout::WideNode packed(std::span<const Child, maxChildren> slots, const Box &box) {
    layout::WideNode node{};
    node.origin = box.lower;
    const std::array<std::array<std::uint32_t *, 4>, 3> words{
        {{&node.lowerX0, &node.lowerX1, &node.upperX0, &node.upperX1},
         {&node.lowerY0, &node.lowerY1, &node.upperY0, &node.upperY1},
         {&node.lowerZ0, &node.lowerZ1, &node.upperZ0, &node.upperZ1}}};
    const std::array<std::uint32_t *, maxChildren> references{&node.child0, &node.child1, &node.child2,
                                                              &node.child3, &node.child4, &node.child5,
                                                              &node.child6, &node.child7};
    for (int axis = 0; axis < 3; ++axis) {
        const std::array<std::uint32_t *, 4> &word = words[static_cast<std::size_t>(axis)];
        const float origin = box.lower[axis];
        const std::uint32_t exponent = exponentFor(origin, box.upper[axis]);
        node.grid |= exponent << 8 * axis;
        for (std::size_t slot = 0; slot < maxChildren; ++slot) {
            if (slots[slot].reference == layout::noNode)
                continue;
            const float cell = cellOf(exponent);
            putByte(*word[0], *word[1], slot, byteBelow(origin, cell, slots[slot].box.lower[axis]));
            putByte(*word[2], *word[3], slot, byteAbove(origin, cell, slots[slot].box.upper[axis]));
        }
    }
    for (std::size_t slot = 0; slot < maxChildren; ++slot) {
        *references[slot] = slots[slot].reference;
        if (slots[slot].reference != layout::noNode)
            node.grid |= 1u << (24 + slot);
    }
    return node;
}

} // namespace

WideTree makeWideTree(const PackedScene &scene) {
    WideTree tree;
    std::vector<std::uint32_t> roots;
    std::vector<std::uint32_t> pairs; // of wide nodes that are not made yet, in their order
    for (const PackedTree &each : scene.trees) {
        roots.push_back(static_cast<std::uint32_t>(tree.nodes.size()));
        pairs.assign({each.firstPair});
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const Children children = childrenOf(scene, pairs[i]);
            Box box;
            for (std::size_t child = 0; child < children.count; ++child)
                box.extend(children.all[child].box);
            const glm::vec3 middle = box.lower / 2.0f + box.upper / 2.0f;
            std::array<Child, maxChildren> slots = inSlots(children, middle);
            for (Child &child : slots)
                if (child.reference != layout::noNode && child.isInner()) {
                    pairs.push_back(child.reference);
                    child.reference = roots.back() + static_cast<std::uint32_t>(pairs.size() - 1);
                }
            tree.nodes.push_back(
                packed(slots, children.count > 0 ? box : Box{glm::vec3(0.0f), glm::vec3(0.0f)}));
        }
    }
    if (tree.nodes.size() > layout::maxWideNodes)
        throw Error(ErrorKind::LimitExceeded, fmt::format("the tree has {} wide nodes; allowed: {}",
                                                          tree.nodes.size(), layout::maxWideNodes));
    tree.instances = scene.instances;
    for (layout::InstanceRecord &instance : tree.instances)
        instance.root = roots[instance.tree + 1];
    return tree;
}

} // namespace hyalite::core
