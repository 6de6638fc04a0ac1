#include "host/bvh/split.h"

#include "host/bvh/tree_statistics.h"
#include "shaders/layout/layout.h"
#include "tests/fixtures/geometry_fixture.h"

#include <array>
#include <set>

namespace hyalite::core {
namespace {

using testing::Random;

BuildTriangle pointAt(const glm::vec3 &position, std::uint32_t index) {
    BuildTriangle triangle;
    triangle.box.extend(position);
    triangle.centroid = position;
    triangle.inputIndex = index;
    return triangle;
}

std::vector<BuildTriangle> pointsOnX(const std::vector<float> &coordinates) {
    std::vector<BuildTriangle> triangles;
    for (const float x : coordinates)
        triangles.push_back(pointAt({x, 0.0f, 0.0f}, static_cast<std::uint32_t>(triangles.size())));
    return triangles;
}

Box boxOf(const std::vector<BuildTriangle> &triangles) {
    Box box;
    for (const BuildTriangle &triangle : triangles)
        box.extend(triangle.box);
    return box;
}

std::set<std::uint32_t> firstIndices(const std::vector<BuildTriangle> &triangles, std::size_t count) {
    std::set<std::uint32_t> indices;
    for (std::size_t i = 0; i < count; ++i)
        indices.insert(triangles[i].inputIndex);
    return indices;
}

using Indices = std::set<std::uint32_t>;

TEST(Split, MidpointCutsTheLongestAxisOfTheBoxInTheMiddle) {
    // x from 0 to 10: the middle is 5, far from the median (1.5) and from the mean of the centroids (2.6).
    std::vector<BuildTriangle> triangles = pointsOnX({10.0f, 1.0f, 0.0f, 2.0f, 0.0f});
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 1), 4u);
    EXPECT_EQ(firstIndices(triangles, 4), (Indices{1, 2, 3, 4}));
}

TEST(Split, MidpointUsesTheBoxAndNotTheCentroidsExtent) {
    // Centroids at 1, 2, 3; the box reaches to 20, so that its middle at 10 separates nothing.
    std::vector<BuildTriangle> triangles = pointsOnX({3.0f, 1.0f, 2.0f});
    Box box;
    box.extend(glm::vec3(0.0f));
    box.extend(glm::vec3(20.0f, 0.0f, 0.0f));
    EXPECT_EQ(splitAtMidpoint(triangles, box, 1), 0u);
    // With a box to 5 the middle is 2.5.
    triangles = pointsOnX({3.0f, 1.0f, 2.0f});
    box.upper.x = 5.0f;
    EXPECT_EQ(splitAtMidpoint(triangles, box, 1), 2u);
    EXPECT_EQ(firstIndices(triangles, 2), (Indices{1, 2}));
}

TEST(Split, MidpointGoesByCentroidsAndNotByBoxes) {
    // The first triangle's box reaches from 0 to 10, its centroid lies left of the middle at 5.
    std::vector<BuildTriangle> triangles = pointsOnX({4.0f, 6.0f});
    triangles[0].box.extend(glm::vec3(0.0f));
    triangles[0].box.extend(glm::vec3(10.0f, 0.0f, 0.0f));
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 1), 1u);
    EXPECT_EQ(triangles[0].inputIndex, 0u);
}

TEST(Split, MidpointSendsACentroidInTheMiddleToTheRight) {
    std::vector<BuildTriangle> triangles = pointsOnX({0.0f, 5.0f, 10.0f});
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 1), 1u);
    EXPECT_EQ(triangles[0].inputIndex, 0u);
}

TEST(Split, MidpointTakesEachAxisWhenItIsTheLongest) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<BuildTriangle> triangles;
        for (std::uint32_t i = 0; i < 4; ++i) {
            // Along the long axis 0, 1, 2, 9; along the others the order is another one.
            const std::array<float, 4> along{9.0f, 0.0f, 2.0f, 1.0f};
            glm::vec3 position(static_cast<float>((i * 7) % 4));
            position[axis] = along[i];
            triangles.push_back(pointAt(position, i));
        }
        EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 1), 3u) << "axis " << axis;
        EXPECT_EQ(firstIndices(triangles, 3), (Indices{1, 2, 3})) << "axis " << axis;
    }
}

TEST(Split, MidpointStopsAtTheLeafSize) {
    std::vector<BuildTriangle> triangles = pointsOnX({0.0f, 1.0f, 2.0f, 3.0f});
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 4), 0u);
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 3), 2u);
}

TEST(Split, MidpointDoesNotOverflowBetweenTheLargestFloats) {
    const float large = 3e38f;
    std::vector<BuildTriangle> triangles = pointsOnX({large, -large, large / 2, -large / 4});
    EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), 1), 2u);
    EXPECT_EQ(firstIndices(triangles, 2), (Indices{1, 3}));
}

TEST(Split, MedianHalvesByTheCentroidsAndThenByTheInputIndex) {
    std::vector<BuildTriangle> triangles = pointsOnX({5.0f, 1.0f, 4.0f, 2.0f, 3.0f});
    EXPECT_EQ(splitAtMedian(triangles, boxOf(triangles)), 2u);
    EXPECT_EQ(firstIndices(triangles, 2), (Indices{1, 3}));
    triangles = pointsOnX({7.0f, 7.0f, 7.0f, 7.0f, 7.0f, 7.0f});
    std::swap(triangles[0], triangles[5]);
    std::swap(triangles[1], triangles[3]);
    EXPECT_EQ(splitAtMedian(triangles, boxOf(triangles)), 3u);
    EXPECT_EQ(firstIndices(triangles, 3), (Indices{0, 1, 2}));
}

TEST(Split, WhatCentroidsDoNotSeparateIsLeftWholeButForTheMedian) {
    std::vector<BuildTriangle> triangles = pointsOnX({2.0f, 2.0f, 2.0f, 2.0f, 2.0f});
    for (const std::size_t leafSize : {1u, 5u}) {
        EXPECT_EQ(splitAtMidpoint(triangles, boxOf(triangles), leafSize), 0u);
        EXPECT_EQ(splitBySah(triangles, RangeBounds(triangles), leafSize), 0u);
    }
    EXPECT_EQ(splitAtMedian(triangles, boxOf(triangles)), 2u);
    EXPECT_EQ(firstIndices(triangles, 2), (Indices{0, 1}));
}

TEST(Split, SahCutsBetweenTwoClustersOfUnequalSize) {
    // 3 on the left, 13 on the right of a wide gap: any other cut gives a child the size of the parent.
    Random random(1);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<BuildTriangle> triangles;
        for (std::uint32_t i = 0; i < 16; ++i) {
            glm::vec3 position(random.inCube(1.0));
            position[axis] += i % 5 == 0 && i < 15 ? -10.0f : 10.0f;
            triangles.push_back(pointAt(position, i));
        }
        EXPECT_EQ(splitBySah(triangles, RangeBounds(triangles), 1), 3u);
        EXPECT_EQ(firstIndices(triangles, 3), (Indices{0, 5, 10}));
    }
}

TEST(Split, SahFindsTheCheapestOfItsCandidates) {
    // Three boxes in each of the sixteen bins of x, as many bins as 48 have: every cut between bins is a candidate, and
    // on y and z there is none. The cost of each is computed here anew.
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
        SCOPED_TRACE(fmt::format("seed {}, trial {}", random.seed(), trial));
        std::vector<BuildTriangle> triangles;
        for (std::uint32_t i = 0; i < 48; ++i) {
            const std::uint32_t bin = i / 3;
            BuildTriangle triangle = pointAt({static_cast<float>(bin), 0.0f, 0.0f}, i);
            triangle.box.extend(glm::vec3(static_cast<float>(bin),
                                          static_cast<float>(random.uniform(0.0, 20.0)),
                                          static_cast<float>(random.uniform(0.0, 20.0))));
            triangles.push_back(triangle);
        }
        double least = std::numeric_limits<double>::infinity();
        std::size_t best = 0;
        for (std::size_t cut = 3; cut < 48; cut += 3) {
            const std::vector<BuildTriangle> left(triangles.begin(),
                                                  triangles.begin() + static_cast<std::ptrdiff_t>(cut));
            const std::vector<BuildTriangle> right(triangles.begin() + static_cast<std::ptrdiff_t>(cut),
                                                   triangles.end());
            const double cost = boxOf(left).halfArea() * static_cast<double>(left.size()) +
                                boxOf(right).halfArea() * static_cast<double>(right.size());
            if (cost < least) {
                least = cost;
                best = cut;
            }
        }
        EXPECT_EQ(splitBySah(triangles, RangeBounds(triangles), 1), best);
    }
}

TEST(Split, SahMakesALeafOnlyWhereItIsCheaperAndAllowed) {
    // Four identical boxes side by side at nearly no distance: any split visits two children for nothing.
    std::vector<BuildTriangle> triangles;
    for (std::uint32_t i = 0; i < 4; ++i) {
        BuildTriangle triangle;
        triangle.box.extend(glm::vec3(-1.0f));
        triangle.box.extend(glm::vec3(1.0f));
        triangle.centroid = glm::vec3(0.001f * static_cast<float>(i), 0.0f, 0.0f);
        triangle.inputIndex = i;
        triangles.push_back(triangle);
    }
    EXPECT_EQ(splitBySah(triangles, RangeBounds(triangles), 4), 0u);
    EXPECT_GT(splitBySah(triangles, RangeBounds(triangles), 3), 0u);
    // Two far apart: worth a node even though a leaf could hold both.
    triangles = {triangles[0], triangles[1]};
    triangles[1].box = {glm::vec3(99.0f), glm::vec3(101.0f)};
    triangles[1].centroid = glm::vec3(100.0f);
    EXPECT_EQ(splitBySah(triangles, RangeBounds(triangles), 64), 1u);
}

} // namespace
} // namespace hyalite::core
