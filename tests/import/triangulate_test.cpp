#include "host/import/triangulate.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace hyalite::core {
namespace {

using Polygon = std::vector<glm::vec3>;

std::vector<glm::uvec3> triangulate(const Polygon &polygon) {
    Triangulator triangulator;
    const auto triangles = triangulator.triangulate(polygon);
    return {triangles.begin(), triangles.end()};
}

glm::dvec3 areaVector(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 areaVector(const Polygon &polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += areaVector(polygon[0], polygon[i - 1], polygon[i]);
    return sum;
}

// A triangulation covers the polygon once exactly when all of its triangles are wound as the polygon is and
// their areas sum up to the polygon's.
void expectCoversOnce(const Polygon &polygon, double relativeTolerance) {
    const std::vector<glm::uvec3> triangles = triangulate(polygon);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    const glm::dvec3 whole = areaVector(polygon);
    const double area = glm::length(whole);
    double sum = 0.0;
    for (const glm::uvec3 &t : triangles) {
        ASSERT_LT(std::max({t.x, t.y, t.z}), polygon.size());
        const glm::dvec3 part = areaVector(polygon[t.x], polygon[t.y], polygon[t.z]);
        EXPECT_GE(glm::dot(part, whole), -relativeTolerance * area * area);
        sum += glm::length(part);
    }
    EXPECT_NEAR(sum, area, relativeTolerance * area);
}

// Radii about a centre: simple whatever they are.
Polygon makeStar(int count, std::mt19937 &random) {
    std::uniform_real_distribution<double> radius(0.05, 1.0);
    Polygon polygon;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const double r = radius(random);
        polygon.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return polygon;
}

double orient(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Random points whose path is untangled by reversing a stretch between two crossing edges until none cross:
// each reversal shortens the path, so it ends.
Polygon makeUntangled(int count, std::mt19937 &random) {
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    Polygon p;
    for (int i = 0; i < count; ++i)
        p.emplace_back(coordinate(random), coordinate(random), 0.0f);
    const std::size_t n = p.size();
    for (bool crossed = true; crossed;) {
        crossed = false;
        for (std::size_t i = 0; i + 2 < n; ++i)
            for (std::size_t j = i + 2; j < n; ++j) {
                const glm::vec3 a = p[i], b = p[i + 1], c = p[j], d = p[(j + 1) % n];
                if (a == d || orient(a, b, c) * orient(a, b, d) >= 0.0 ||
                    orient(c, d, a) * orient(c, d, b) >= 0.0)
                    continue;
                std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                             p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                crossed = true;
            }
    }
    return p;
}

TEST(Triangulate, SplitsConvexQuadsBetweenCorners0And2) {
    const Polygon square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> triangles = triangulate(square);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_EQ(triangles[1], glm::uvec3(0, 2, 3));
}

TEST(Triangulate, CoversConcaveQuadsWhicheverCornerIsReflex) {
    Polygon arrow{{0, 0, 0}, {2, 0, 0}, {0.5f, 0.5f, 0}, {0, 2, 0}};
    for (int i = 0; i < 4; ++i) {
        expectCoversOnce(arrow, 1e-12);
        std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    }
}

TEST(Triangulate, KeepsTheWindingInEveryPlane) {
    const Polygon ell{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    for (int axis = 0; axis < 3; ++axis)
        for (const bool reversed : {false, true}) {
            Polygon turned;
            for (const glm::vec3 &p : ell) {
                glm::vec3 q;
                q[axis] = 7.0f;
                q[(axis + 1) % 3] = p.x;
                q[(axis + 2) % 3] = p.y;
                turned.push_back(q);
            }
            if (reversed)
                std::reverse(turned.begin(), turned.end());
            expectCoversOnce(turned, 1e-12);
        }
}

TEST(Triangulate, CollinearCornersGiveNoTriangleWithoutArea) {
    Polygon polygon;
    for (int i = 0; i < 10; ++i)
        polygon.emplace_back(i, 0, 0);
    for (int i = 0; i < 10; ++i)
        polygon.emplace_back(10, i, 0);
    for (int i = 0; i < 10; ++i)
        polygon.emplace_back(10 - i, 10, 0);
    for (int i = 0; i < 10; ++i)
        polygon.emplace_back(0, 10 - i, 0);
    expectCoversOnce(polygon, 1e-12);
    for (const glm::uvec3 &t : triangulate(polygon))
        EXPECT_GT(glm::length(areaVector(polygon[t.x], polygon[t.y], polygon[t.z])), 0.0);
}

TEST(Triangulate, CoversAPolygonWithAHoleOnABridge) {
    const Polygon keyhole{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},
                          {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};
    EXPECT_NEAR(glm::length(areaVector(keyhole)), 72.0, 1e-12);
    expectCoversOnce(keyhole, 1e-12);
}

TEST(Triangulate, RandomPolygonsKeepTheirArea) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(::testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const int count = 3 + static_cast<int>(random() % 60);
        expectCoversOnce(makeStar(count, random), 1e-10);
        expectCoversOnce(makeUntangled(count, random), 1e-10);
    }
}

TEST(Triangulate, RandomPolygonsInTiltedPlanesKeepTheirArea) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(::testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        std::normal_distribution<double> gauss;
        const glm::dvec3 normal = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
        const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.6, -0.48, 0.64)));
        const glm::dvec3 v = glm::cross(normal, u);
        Polygon polygon = makeUntangled(3 + static_cast<int>(random() % 40), random);
        for (glm::vec3 &p : polygon)
            p = glm::vec3(100.0 * normal + u * double(p.x) + v * double(p.y));
        expectCoversOnce(polygon, 1e-3); // the corners are rounded to 8e-6 in a unit polygon
    }
}

TEST(Triangulate, LargePolygonsAreCoveredOnce) {
    std::mt19937 random(1);
    expectCoversOnce(makeStar(300, random), 1e-9);
    expectCoversOnce(makeStar(20'000, random), 1e-9);
}

TEST(Triangulate, SmallIntegerPolygonsOfAnyShapeGiveCornersMinusTwo) {
    for (unsigned seed = 0; seed < 20'000; ++seed) {
        std::mt19937 random(seed);
        Polygon polygon(3 + random() % 12); // mostly self-crossing, folded, or with repeated corners
        for (glm::vec3 &p : polygon)
            p = glm::vec3(random() % 4, random() % 4, random() % 2);
        const std::vector<glm::uvec3> triangles = triangulate(polygon);
        ASSERT_EQ(triangles.size(), polygon.size() - 2) << "seed " << seed;
        // Whatever the shape, each step replaces two edges by their sum, so the area vector stays.
        glm::dvec3 sum(0.0);
        for (const glm::uvec3 &t : triangles)
            sum += areaVector(polygon[t.x], polygon[t.y], polygon[t.z]);
        ASSERT_EQ(sum, areaVector(polygon)) << "seed " << seed;
    }
}

TEST(Triangulate, DegenerateAndNonFinitePolygonsEnd) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const float huge = std::numeric_limits<float>::max();
    const Polygon corners{{nan, 0, 0}, {0, infinity, 0}, {huge, -huge, huge}, {0, 0, nan}, {-infinity, 1, 1}};
    EXPECT_EQ(triangulate(corners).size(), 3u);
    EXPECT_EQ(triangulate(Polygon(1000, glm::vec3(1.0f))).size(), 998u);
    Polygon line;
    for (int i = 0; i < 1000; ++i)
        line.emplace_back(i, 2 * i, 3 * i);
    EXPECT_EQ(triangulate(line).size(), 998u);
}

// Each would take seconds to minutes where every ear is held against every reflex corner.
TEST(Triangulate, LargeUglyPolygonsEnd) {
    constexpr int count = 65'536;
    Polygon fewPoints, comb, spiral, zigzag;
    for (int i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        fewPoints.emplace_back(i % 3 == 1, i % 3 == 2, 0);
        comb.emplace_back(x, i % 2 == 0 ? 0.0f : 1e6f, 0);
        spiral.emplace_back(x * std::cos(x), x * std::sin(x), 0); // crosses itself again and again
        zigzag.emplace_back(i % 2 == 0 ? x : -x, i % 4 < 2 ? x : -x, 0);
    }
    for (const Polygon &polygon : {fewPoints, comb, spiral, zigzag})
        EXPECT_EQ(triangulate(polygon).size(), polygon.size() - 2);
}

TEST(Triangulate, ALargeCombIsCoveredOnce) {
    Polygon comb;
    for (int i = 0; i < 10'000; ++i) {
        comb.emplace_back(2 * i, 1000, 0);
        comb.emplace_back(2 * i + 1, 0, 0);
    }
    comb.emplace_back(20'000, 1000, 0);
    comb.emplace_back(20'000, -1, 0);
    comb.emplace_back(0, -1, 0);
    std::reverse(comb.begin(), comb.end());
    expectCoversOnce(comb, 1e-9);
}

TEST(Triangulate, GivesTheSameAnswerWhateverItDidBefore) {
    std::mt19937 random(3);
    const Polygon star = makeStar(50, random);
    Triangulator used;
    (void)used.triangulate(makeStar(70, random));
    const auto again = used.triangulate(star);
    EXPECT_EQ(std::vector<glm::uvec3>(again.begin(), again.end()), triangulate(star));
}

} // namespace
} // namespace hyalite::core
