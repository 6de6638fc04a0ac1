// The wide tree holds the same tree: every leaf, in boxes that enclose the real ones as kernels unpack them.
#include "host/packing/wide_tree.h"

#include "tests/packing/tree_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace hyalite::core {
namespace {

using testing::pack;
using testing::randomScene;

constexpr std::size_t slotCount = 8;

struct Unpacked {
    std::array<std::uint32_t, slotCount> children;
    std::array<Box, slotCount> boxes;
    std::uint32_t mask;
};

std::uint32_t byteOf(std::uint32_t first, std::uint32_t last, std::size_t slot) {
    return (slot < 4 ? first : last) >> 8 * (slot & 3) & 0xFFu;
}

/// By the sums of shaders/trace/wide_node.glsl.
Unpacked unpacked(const layout::WideNode &node) {
    Unpacked all{{node.child0, node.child1, node.child2, node.child3, node.child4, node.child5, node.child6,
                  node.child7},
                 {},
                 node.grid >> 24};
    glm::vec3 cell;
    for (int axis = 0; axis < 3; ++axis)
        cell[axis] = std::bit_cast<float>((node.grid >> 8 * axis & 0xFFu) << 23);
    for (std::size_t slot = 0; slot < slotCount; ++slot) {
        const auto lower =
            glm::vec3(byteOf(node.lowerX0, node.lowerX1, slot), byteOf(node.lowerY0, node.lowerY1, slot),
                      byteOf(node.lowerZ0, node.lowerZ1, slot));
        const auto upper =
            glm::vec3(byteOf(node.upperX0, node.upperX1, slot), byteOf(node.upperY0, node.upperY1, slot),
                      byteOf(node.upperZ0, node.upperZ1, slot));
        all.boxes[slot] = {node.origin + cell * lower, node.origin + cell * upper};
    }
    return all;
}

/// Marks the triangles below a node, and expects them in all boxes around them.
void visit(const PackedScene &scene, const WideTree &tree, std::uint32_t reference, std::vector<Box> &around,
           std::vector<bool> &isSeen) {
    if ((reference & layout::leafFlag) == 0) {
        const Unpacked node = unpacked(tree.nodes.at(reference));
        for (std::size_t slot = 0; slot < slotCount; ++slot) {
            ASSERT_EQ(node.children[slot] != layout::noNode, (node.mask >> slot & 1u) != 0);
            if (node.children[slot] == layout::noNode)
                continue;
            around.push_back(node.boxes[slot]);
            visit(scene, tree, node.children[slot], around, isSeen);
            around.pop_back();
        }
        return;
    }
    for (std::uint32_t record = reference & ~layout::leafFlag;; ++record) {
        const layout::TriangleRecord &triangle = scene.triangles[record];
        ASSERT_FALSE(isSeen[record]);
        isSeen[record] = true;
        Box box;
        for (const glm::vec3 &vertex : {triangle.v0, triangle.v1, triangle.v2})
            box.extend(vertex);
        for (const Box &each : around)
            ASSERT_TRUE(each.contains(box)) << record;
        if ((triangle.flags & layout::triangleEndsLeaf) != 0)
            break;
    }
}

void expectSoundWideTree(const PackedScene &scene) {
    const WideTree tree = makeWideTree(scene);
    std::vector<bool> isSeen(scene.triangles.size(), false);
    std::vector<Box> around;
    visit(scene, tree, 0, around, isSeen);
    EXPECT_TRUE(std::ranges::all_of(isSeen, [](bool seen) { return seen; }));
}

TEST(WideTree, HoldsEveryTriangleOnceInEnclosingBoxes) {
    for (const int leafSize : {1, 4, 8}) {
        expectSoundWideTree(pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Midpoint, leafSize));
        expectSoundWideTree(pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Sah, leafSize));
    }
    expectSoundWideTree(pack(randomScene(500, 1.0f, glm::vec3(0.0f)), TreeKind::None, 8));
    expectSoundWideTree(pack(randomScene(1, 1.0f, glm::vec3(0.0f)), TreeKind::Sah, 8));
}

TEST(WideTree, EnclosesFarSmallAndFlatMeshes) {
    expectSoundWideTree(pack(randomScene(1000, 1.0f, glm::vec3(1e6f, -1e6f, 3e5f)), TreeKind::Midpoint, 2));
    expectSoundWideTree(pack(randomScene(1000, 1e-6f, glm::vec3(0.0f)), TreeKind::Midpoint, 2));
    expectSoundWideTree(pack(randomScene(1000, 1e9f, glm::vec3(-1e9f)), TreeKind::Midpoint, 2));
    expectSoundWideTree(pack(randomScene(1000, 1e-12f, glm::vec3(1.0f)), TreeKind::Midpoint, 2));
    for (const float height : {0.0f, 5.0f, 1.0000001f, -3e7f, 7e-12f}) {
        Scene flat = randomScene(1000, 1e-3f, glm::vec3(0.0f));
        for (glm::vec3 &position : flat.meshes.front().positions)
            position.y = position.x > 0.0f ? height : std::nextafter(height, 0.0f);
        expectSoundWideTree(pack(flat, TreeKind::Sah, 2));
    }
}

TEST(WideTree, FillsItsNodesAndIsAsFineAsABox) {
    const PackedScene scene = pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Sah, 4);
    const WideTree tree = makeWideTree(scene);
    std::size_t childCount = 0;
    for (const layout::WideNode &node : tree.nodes)
        childCount += static_cast<std::size_t>(std::popcount(node.grid >> 24));
    EXPECT_GT(childCount, 5 * tree.nodes.size());
    EXPECT_LT(tree.nodes.size() * sizeof(layout::WideNode),
              scene.nodes.size() * sizeof(layout::NodePair) / 2);
}

TEST(WideTree, HasNearerChildrenFirst) {
    // Eight triangles, one in each octant, a leaf each: slots are octants.
    Scene scene = randomScene(8, 0.0f, glm::vec3(0.0f));
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t corner = 0; corner < 3; ++corner)
            scene.meshes.front().positions[3 * i + corner] =
                glm::vec3(i & 1, i >> 1 & 1, i >> 2) + glm::vec3(corner == 1, corner == 2, 0.0f) * 0.1f;
    const PackedScene packed = pack(scene, TreeKind::Sah, 1);
    const WideTree tree = makeWideTree(packed);
    ASSERT_EQ(tree.nodes.size(), 1u);
    const Unpacked node = unpacked(tree.nodes.front());
    for (std::uint32_t slot = 0; slot < slotCount; ++slot)
        EXPECT_EQ(packed.triangles[node.children[slot] & ~layout::leafFlag].primitiveId -
                      layout::minFirstTriangleId,
                  slot);
}

} // namespace
} // namespace hyalite::core
