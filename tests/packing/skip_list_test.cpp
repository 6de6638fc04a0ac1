// The skip lists hold the same tree: every leaf, in boxes that enclose the real ones.
#include "host/packing/skip_list.h"

#include "tests/packing/tree_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyalite::core {
namespace {

using testing::pack;
using testing::randomScene;

/// The box that a node stands for, in double as the grid is exact there.
std::pair<glm::dvec3, glm::dvec3> boxOf(const SkipList &list, const layout::SkipNode &node) {
    const std::uint32_t words[3] = {node.x, node.y, node.z};
    glm::dvec3 lower;
    glm::dvec3 upper;
    for (int axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<std::int16_t>(words[axis] & 0xFFFFu);
        const auto high = static_cast<std::int16_t>(words[axis] >> 16);
        lower[axis] = list.trees.front().grid.middle[axis] +
                      static_cast<double>(list.trees.front().grid.scale[axis]) * low;
        upper[axis] = list.trees.front().grid.middle[axis] +
                      static_cast<double>(list.trees.front().grid.scale[axis]) * high;
    }
    return {lower, upper};
}

void expectSound(const PackedScene &scene) {
    const SkipList list = makeSkipList(scene);
    ASSERT_EQ(list.nodes.size(), std::size_t{2} * list.length + 1);
    for (const std::uint32_t first : {0u, list.length}) {
        const std::uint32_t end = first + list.length;
        std::vector<bool> isSeen(scene.triangles.size(), false);
        std::vector<std::uint32_t> ends; // of the subtrees around the node
        for (std::uint32_t index = first; index < end; ++index) {
            const layout::SkipNode &node = list.nodes[index];
            while (!ends.empty() && ends.back() == index)
                ends.pop_back();
            if ((node.link & layout::leafFlag) == 0) {
                ASSERT_GT(node.link, index);
                ASSERT_LE(node.link, ends.empty() ? end : ends.back());
                ends.push_back(node.link);
                continue;
            }
            const auto [lower, upper] = boxOf(list, node);
            for (std::uint32_t record = node.link & ~layout::leafFlag;; ++record) {
                const layout::TriangleRecord &triangle = scene.triangles[record];
                ASSERT_FALSE(isSeen[record]);
                isSeen[record] = true;
                for (const glm::vec3 &vertex : {triangle.v0, triangle.v1, triangle.v2})
                    for (int axis = 0; axis < 3; ++axis) {
                        ASSERT_GE(vertex[axis], lower[axis]);
                        ASSERT_LE(vertex[axis], upper[axis]);
                    }
                if ((triangle.flags & layout::triangleEndsLeaf) != 0)
                    break;
            }
        }
        EXPECT_TRUE(std::all_of(isSeen.begin(), isSeen.end(), [](bool seen) { return seen; })) << first;
    }
}

TEST(SkipList, HoldsEveryTriangleOnceInEnclosingBoxes) {
    for (const int leafSize : {1, 4, 8}) {
        expectSound(pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Midpoint, leafSize));
        expectSound(pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Sah, leafSize));
    }
    expectSound(pack(randomScene(500, 1.0f, glm::vec3(0.0f)), TreeKind::None, 8));
}

TEST(SkipList, EnclosesFarSmallAndFlatMeshes) {
    expectSound(pack(randomScene(1000, 1.0f, glm::vec3(1e6f, -1e6f, 3e5f)), TreeKind::Midpoint, 2));
    expectSound(pack(randomScene(1000, 1e-6f, glm::vec3(0.0f)), TreeKind::Midpoint, 2));
    expectSound(pack(randomScene(1000, 1e9f, glm::vec3(-1e9f)), TreeKind::Midpoint, 2));
    Scene flat = randomScene(1000, 1.0f, glm::vec3(0.0f));
    for (glm::vec3 &position : flat.meshes.front().positions)
        position.y = 5.0f;
    expectSound(pack(flat, TreeKind::Midpoint, 2));
    for (glm::vec3 &position : flat.meshes.front().positions)
        position.y = 0.0f;
    expectSound(pack(flat, TreeKind::Midpoint, 2));
}

TEST(SkipList, EnclosesFlatMeshesFarAwayWhoseGridIsCoarserThanTheirCoordinates) {
    for (const float height : {1.0000001f, -3e7f, 7e-12f}) {
        Scene flat = randomScene(1000, 1e-3f, glm::vec3(0.0f));
        for (glm::vec3 &position : flat.meshes.front().positions)
            position.y = position.x > 0.0f ? height : std::nextafter(height, 0.0f);
        expectSound(pack(flat, TreeKind::Sah, 2));
    }
}

TEST(SkipList, LeavesOutInnerNodesThatHardlyCull) {
    const auto halfArea = [](const std::pair<glm::dvec3, glm::dvec3> &box) {
        const glm::dvec3 size = box.second - box.first;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    };
    const PackedScene scene = pack(randomScene(3000, 1.0f, glm::vec3(0.0f)), TreeKind::Sah, 4);
    const SkipList list = makeSkipList(scene);
    std::size_t childCount = 0;
    for (const layout::NodePair &pair : scene.nodes)
        childCount += (pair.left != layout::noNode ? 1u : 0u) + (pair.right != layout::noNode ? 1u : 0u);
    EXPECT_LT(list.length, childCount);
    std::vector<std::pair<std::uint32_t, double>> around; // ends and areas of the inner nodes around a node
    for (std::uint32_t index = 0; index < list.length; ++index) {
        const layout::SkipNode &node = list.nodes[index];
        while (!around.empty() && around.back().first == index)
            around.pop_back();
        if ((node.link & layout::leafFlag) != 0)
            continue;
        const double area = halfArea(boxOf(list, node));
        if (!around.empty()) {
            EXPECT_LT(area, 0.51 * around.back().second) << index; // rounded to the grid
        }
        around.emplace_back(node.link, area);
    }
}

TEST(SkipList, NearerSiblingsComeFirst) {
    // Sixteen triangles in a row on each axis, a leaf each: the lists hold them as rays along the axis and against it
    // meet them.
    for (int axis = 0; axis < 3; ++axis) {
        Scene scene = randomScene(16, 0.0f, glm::vec3(0.0f));
        for (std::uint32_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
            glm::vec3 &position = scene.meshes[0].positions[i];
            position = glm::vec3(0.1f * static_cast<float>(i % 3));
            position[axis] += static_cast<float>(i / 3);
        }
        const PackedScene packed = pack(scene, TreeKind::Midpoint, 1);
        const SkipList list = makeSkipList(packed);
        for (const bool isBackwards : {false, true}) {
            std::vector<std::uint32_t> met;
            for (std::uint32_t i = 0; i < list.length; ++i)
                if (const std::uint32_t link = list.nodes[isBackwards ? list.length + i : i].link;
                    link & layout::leafFlag)
                    met.push_back(packed.triangles[link & ~layout::leafFlag].primitiveId);
            ASSERT_EQ(met.size(), 16u);
            EXPECT_TRUE(isBackwards ? std::is_sorted(met.rbegin(), met.rend())
                                    : std::is_sorted(met.begin(), met.end()))
                << "axis " << axis << (isBackwards ? ", backwards" : "");
        }
    }
}

TEST(SkipList, IsEmptyWithoutTriangles) {
    EXPECT_TRUE(makeSkipList(packScene(Scene{}, Bvh{})).nodes.empty());
}

/// The triangles' corners.
std::array<glm::vec3, 3> cornersOf(const layout::TriangleRecord &triangle) {
    return {triangle.v0, triangle.v1, triangle.v2};
}

TEST(SkipList, KnowsTheCommonEdgesOfPairs) {
    // Quads with every pair of corners at which the common edge may begin.
    Scene scene;
    scene.materials.push_back({});
    TriangleMesh &mesh = scene.meshes.emplace_back();
    for (std::uint32_t i = 0; i < 90; ++i) {
        const auto x = static_cast<float>(i);
        mesh.positions.insert(mesh.positions.end(),
                              {{x, 0, 0}, {x + 0.5f, 0, 1}, {x + 0.5f, 1, 0}, {x, 1, 1}});
        glm::uvec3 first(4 * i, 4 * i + 1, 4 * i + 2);
        glm::uvec3 second(4 * i, 4 * i + 2, 4 * i + 3);
        for (std::uint32_t turn = 0; turn < i % 3; ++turn)
            first = {first.y, first.z, first.x};
        for (std::uint32_t turn = 0; turn < i / 3 % 3; ++turn)
            second = {second.y, second.z, second.x};
        mesh.triangles.push_back({first});
        mesh.triangles.push_back({second});
    }
    const PackedScene packed = packScene(scene, buildBvh(TreeKind::Sah, scene, 8));
    ASSERT_TRUE(packed.hasPairs);
    const SkipList list = makeSkipList(packed);
    std::size_t pairCount = 0;
    for (std::uint32_t index = 0; index < 2 * list.length; ++index) {
        const std::uint32_t link = list.nodes[index].link;
        if ((link & layout::leafFlag) == 0)
            continue;
        ASSERT_TRUE(layout::isPairOfTriangles(link));
        ++pairCount;
        const std::uint32_t record = layout::leafRecordOf(link);
        const std::uint32_t first = layout::firstCornerOf(link);
        const std::uint32_t second = layout::secondCornerOf(link);
        EXPECT_EQ(packed.triangles[record + 1].primitiveId, packed.triangles[record].primitiveId + 1);
        const std::array<glm::vec3, 3> a = cornersOf(packed.triangles[record]);
        const std::array<glm::vec3, 3> b = cornersOf(packed.triangles[record + 1]);
        EXPECT_EQ(a[first], b[(second + 1) % 3]);
        EXPECT_EQ(a[(first + 1) % 3], b[second]);
    }
    EXPECT_EQ(pairCount, 2u * 90u);
}

TEST(SkipList, HasNoPairsWhereFewTrianglesShareAnEdge) {
    const Scene soup = randomScene(1000, 1.0f, glm::vec3(0.0f));
    const PackedScene packed = packScene(soup, buildBvh(TreeKind::Sah, soup, 8));
    EXPECT_FALSE(packed.hasPairs);
    for (const layout::SkipNode &node : makeSkipList(packed).nodes)
        if ((node.link & layout::leafFlag) != 0) {
            EXPECT_LT(node.link & ~layout::leafFlag, 1000u);
        }
}

} // namespace
} // namespace hyalite::core
