// Two triangles at once are met as each by itself.
#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <array>
#include <bit>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;
using hyalite::core::testing::text;

/// Begin and end of the common edge, the first apex and the second.
using Quad = std::array<glm::vec3, 4>;

/// Small and large, near and far, flat, folded, and of slivers; on a lattice, so that edge functions are often 0.
Quad anyQuad(Random &random) {
    Quad quad;
    if (random.below(4) == 0) {
        for (glm::vec3 &corner : quad)
            for (int axis = 0; axis < 3; ++axis)
                corner[axis] = static_cast<float>(random.below(5)) - 2.0f;
        return quad;
    }
    const double scale = random.logUniform(1e-6, 1e6);
    const glm::dvec3 centre = random.inCube(scale * random.logUniform(1e-2, 1e4));
    const double width = random.logUniform(1e-7, 1.0);
    for (std::size_t i = 0; i < 4; ++i)
        quad[i] = glm::vec3(centre + random.inCube(i < 2 ? scale : scale * width));
    return quad;
}

/// The triangle's corners by their numbers, from those in turn from number `corner` on.
std::array<glm::vec3, 3> turned(const std::array<glm::vec3, 3> &inTurn, std::uint32_t corner) {
    std::array<glm::vec3, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i)
        corners[(corner + i) % 3] = inTurn[i];
    return corners;
}

struct Shot {
    glm::vec3 origin;
    glm::vec3 direction;
};

/// Through a corner, a point of an edge or one inside, from anywhere; or along axes.
Shot anyShot(Random &random, const Quad &quad) {
    const glm::dvec3 a(quad[random.below(4)]);
    const glm::dvec3 b(quad[random.below(4)]);
    const glm::dvec3 c(quad[random.below(4)]);
    const glm::dvec3 edge = glm::mix(a, b, random.uniform());
    const glm::dvec3 target =
        std::array<glm::dvec3, 3>{a, edge, glm::mix(edge, c, random.uniform())}[random.below(3)];
    const double size = std::max(glm::distance(a, b), 1e-6) * random.logUniform(1e-1, 1e3);
    if (random.below(4) == 0) {
        glm::vec3 direction(0.0f);
        direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0f : -1.0f;
        return {glm::vec3(target) - direction * static_cast<float>(size), direction};
    }
    const glm::vec3 origin(target + random.direction() * size);
    return {origin, glm::vec3(glm::normalize(target - glm::dvec3(origin) + random.inCube(1e-30)))};
}

bool areSame(const TriangleHit<float> &a, const TriangleHit<float> &b) {
    return std::bit_cast<std::uint32_t>(a.distance) == std::bit_cast<std::uint32_t>(b.distance) &&
           std::bit_cast<std::uint32_t>(a.u) == std::bit_cast<std::uint32_t>(b.u) &&
           std::bit_cast<std::uint32_t>(a.v) == std::bit_cast<std::uint32_t>(b.v) && a.isBehind == b.isBehind;
}

TEST(TrianglePair, IsMetAsItsTrianglesAre) {
    Random random(141);
    Tally differences("differences", random.seed());
    std::array<int, 4> found{}; // none, the first, the second, both
    for (int i = 0; i < 1'000'000; ++i) {
        const Quad quad = anyQuad(random);
        const auto &[begin, end, firstApex, secondApex] = quad;
        const auto firstCorner = static_cast<std::uint32_t>(random.below(3));
        const auto secondCorner = static_cast<std::uint32_t>(random.below(3));
        const auto [a0, a1, a2] = turned({begin, end, firstApex}, firstCorner);
        const auto [b0, b1, b2] = turned({end, begin, secondApex}, secondCorner);
        const Shot shot = anyShot(random, quad);
        if (!(glm::length(shot.direction) > 0.5f))
            continue;
        const glm::vec3 lower = glm::min(glm::min(begin, end), glm::min(firstApex, secondApex));
        const glm::vec3 upper = glm::max(glm::max(begin, end), glm::max(firstApex, secondApex));
        const BoxRay<float> boxRay = makeBoxRay(shot.origin, shot.direction, lower, upper);
        const TriangleRay<float> ray = makeTriangleRay(shot.origin, shot.direction);
        const bool takesFirst = random.below(8) != 0;
        const bool takesSecond = random.below(8) != 0;
        const PairHit<float> pair = intersectPair(
            ray, boxRay, JoinedTriangles<float>{begin, end, firstApex, secondApex, firstCorner, secondCorner},
            takesFirst, takesSecond);
        const TriangleHit<float> first = intersectTriangle(ray, boxRay, a0, a1, a2);
        const TriangleHit<float> second = intersectTriangle(ray, boxRay, b0, b1, b2);
        const bool meetsFirst = takesFirst && first.distance > 0.0f;
        const bool meetsSecond = takesSecond && second.distance > 0.0f;
        ++found[(meetsFirst ? 1u : 0u) + (meetsSecond ? 2u : 0u)];
        bool isRight = false;
        if (!(pair.hit.distance > 0.0f)) // the second, if it is met, is then tested by itself
            isRight = pair.isBoth ? !meetsFirst : !meetsFirst && !meetsSecond;
        else if (pair.isSecond)
            isRight = meetsSecond && !meetsFirst && !pair.isBoth && areSame(pair.hit, second);
        else
            isRight = meetsFirst && areSame(pair.hit, first) && (pair.isBoth || !meetsSecond);
        differences.check(isRight, [&] {
            return fmt::format("{} {} {} {}, corners {} {}, takes {} {}, origin {} direction {}", text(begin),
                               text(end), text(firstApex), text(secondApex), firstCorner, secondCorner,
                               takesFirst, takesSecond, text(shot.origin), text(shot.direction));
        });
    }
    differences.expectNone();
    for (const int count : found)
        EXPECT_GT(count, 10'000);
}

} // namespace
} // namespace hyalite::core::reference
