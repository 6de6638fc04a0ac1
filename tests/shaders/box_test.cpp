#include "tests/fixtures/leaves.h"

#include "tests/fixtures/geometry_fixture.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;
using hyalite::core::testing::text;

/// A direction of the kinds that slab tests stumble over, of unit length or of one axis.
glm::vec3 hostileDirection(Random &random) {
    glm::dvec3 direction = random.direction();
    switch (random.below(4)) {
    case 0:
        direction[static_cast<int>(random.below(3))] = random.coin() ? 0.0 : -0.0;
        break;
    case 1: {
        const int axis = static_cast<int>(random.below(3));
        glm::vec3 along(random.coin() ? 0.0f : -0.0f);
        along[axis] = random.coin() ? 1.0f : -1.0f;
        return along;
    }
    case 2:
        direction[static_cast<int>(random.below(3))] =
            random.logUniform(1e-40, 1e-3) * (random.coin() ? 1 : -1);
        break;
    default:
        break;
    }
    return glm::vec3(glm::normalize(direction));
}

TEST(Box, AnOuterBoxesIntervalContainsTheInnerOnesToTheBit) {
    Random random(201);
    Tally wrong("nested boxes with intervals that are not", random.seed());
    for (int i = 0; i < 2'000'000; ++i) {
        const double scale = random.logUniform(1e-12, 1e12);
        glm::vec3 points[4];
        for (glm::vec3 &point : points)
            point = glm::vec3(random.inCube(scale));
        const int kind = static_cast<int>(random.below(4));
        if (kind == 0) // a flat box
            points[1][static_cast<int>(random.below(3))] = points[0][static_cast<int>(random.below(3))];
        if (kind == 1) // of one point
            points[1] = points[0];
        const glm::vec3 lower = glm::min(points[0], points[1]);
        const glm::vec3 upper = glm::max(points[0], points[1]);
        // Larger by something, by one unit in the last place, or not at all.
        glm::vec3 outerLower = lower;
        glm::vec3 outerUpper = upper;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t growth = random.below(4);
            if (growth == 0)
                outerLower[axis] = std::min(lower[axis], points[2][axis]);
            if (growth == 1)
                outerUpper[axis] = std::nextafter(upper[axis], std::numeric_limits<float>::max());
            if (growth == 2)
                outerUpper[axis] = std::max(upper[axis], points[3][axis]);
        }
        glm::vec3 origin(random.inCube(scale * random.logUniform(0.1, 1e3)));
        if (random.coin()) // on a face of the box
            origin[static_cast<int>(random.below(3))] = lower[static_cast<int>(random.below(3))];
        const glm::vec3 direction = hostileDirection(random);
        const BoxRay<float> ray = makeBoxRay(origin, direction, outerLower, outerUpper);
        const Vec2<float> inner = boxInterval(ray, lower, upper);
        const Vec2<float> outer = boxInterval(ray, outerLower, outerUpper);
        wrong.check(outer.x <= inner.x && inner.y <= outer.y && inner.x >= 0, [&] {
            return fmt::format("{} {} in {} {}, origin {}, direction {}", text(lower), text(upper),
                               text(outerLower), text(outerUpper), text(origin), text(direction));
        });
    }
    wrong.expectNone();
}

TEST(Box, IsNeverMissedByARayThroughAPointInside) {
    // The ray's own rounding is allowed for by the pad: the direction to a point is off by u of the distance.
    Random random(202);
    Tally missed("boxes that a ray through a point inside misses", random.seed());
    Tally outside("points outside of the interval", random.seed());
    for (int i = 0; i < 2'000'000; ++i) {
        const double scale = random.logUniform(1e-9, 1e9);
        const glm::dvec3 offset = random.inCube(scale * random.logUniform(1.0, 1e5));
        glm::vec3 a(offset + random.inCube(scale));
        glm::vec3 b(offset + random.inCube(scale));
        if (random.below(3) == 0)
            b[static_cast<int>(random.below(3))] = a[static_cast<int>(random.below(3))];
        if (random.below(3) == 0)
            b.x = a.x;
        const glm::vec3 lower = glm::min(a, b);
        const glm::vec3 upper = glm::max(a, b);
        const glm::dvec3 weights(random.uniform(), random.uniform(), random.uniform());
        const glm::vec3 inside(glm::mix(glm::dvec3(lower), glm::dvec3(upper), weights));
        const glm::dvec3 step = glm::dvec3(hostileDirection(random)) * (scale * random.logUniform(1e-3, 1e4));
        const glm::vec3 origin(glm::dvec3(inside) - step);
        const glm::dvec3 way = glm::dvec3(inside) - glm::dvec3(origin);
        const double back = glm::length(way);
        if (back == 0.0)
            continue;
        const glm::vec3 direction(way / back);
        const BoxRay<float> ray = makeBoxRay(origin, direction, lower, upper);
        const Vec2<float> interval = boxInterval(ray, lower, upper);
        missed.check(interval.x <= interval.y, [&] {
            return fmt::format("{} {}, origin {}, direction {}", text(lower), text(upper), text(origin),
                               text(direction));
        });
        const double slack = 0x1p-22 * back;
        outside.check(static_cast<double>(interval.x) <= back + slack &&
                          back - slack <= static_cast<double>(interval.y),
                      [&] {
                          return fmt::format("{} {}, origin {}, direction {}: {} not in [{}, {}]",
                                             text(lower), text(upper), text(origin), text(direction), back,
                                             interval.x, interval.y);
                      });
    }
    missed.expectNone();
    outside.expectNone();
}

TEST(Box, HasNoNanForRaysParallelToItsFaces) {
    Random random(203);
    Tally wrong("intervals that are NaN", random.seed());
    for (int code = 0; code < 27 * 8 * 27; ++code) {
        const auto digit = [](int value) { return static_cast<float>(value % 3 - 1); };
        glm::vec3 direction(digit(code), digit(code / 3), digit(code / 9));
        if (direction == glm::vec3(0.0f))
            continue;
        for (int axis = 0; axis < 3; ++axis) // both zeros
            if (direction[axis] == 0.0f && ((code / 27) >> axis & 1) != 0)
                direction[axis] = -0.0f;
        const int place = code / 216;
        const glm::vec3 origin(digit(place), digit(place / 3),
                               digit(place / 9)); // corners, edges, faces, middle
        for (const float scale : {1.0f, 1e-6f, 1e6f, 1e15f}) {
            for (const glm::vec3 upper : {glm::vec3(scale), glm::vec3(scale, -scale, scale)}) {
                const glm::vec3 lower(-scale);
                const BoxRay<float> ray = makeBoxRay(origin * scale, direction, lower, upper);
                const Vec2<float> interval = boxInterval(ray, lower, upper);
                wrong.check(
                    !std::isnan(interval.x) && !std::isnan(interval.y) && !std::isinf(ray.inverse.x) &&
                        !std::isinf(ray.inverse.y) && !std::isinf(ray.inverse.z),
                    [&] { return fmt::format("origin {}, direction {}", text(origin), text(direction)); });
            }
        }
    }
    wrong.expectNone();
}

TEST(Box, ClosedFormsOfTheInterval) {
    const glm::vec3 lower(-1.0f, -2.0f, -3.0f);
    const glm::vec3 upper(1.0f, 2.0f, 3.0f);
    const auto interval = [&](const glm::dvec3 &origin, const glm::dvec3 &direction) {
        return boxInterval(makeBoxRay(origin, direction, glm::dvec3(lower), glm::dvec3(upper)),
                           glm::dvec3(lower), glm::dvec3(upper));
    };
    const double pad = 0x1p-20; // of boxes that reach as far as 1 from the origin of the ray
    EXPECT_NEAR(interval({-5, 0, 0}, {1, 0, 0}).x, 4.0 - 6.0 * pad, 1e-13);
    EXPECT_NEAR(interval({-5, 0, 0}, {1, 0, 0}).y, 6.0 + 6.0 * pad, 1e-13);
    EXPECT_EQ(interval({0, 0, 0}, {0, -1, 0}).x, 0.0);
    EXPECT_NEAR(interval({0, 0, 0}, {0, -1, 0}).y, 2.0 + 3.0 * pad, 1e-13);
    EXPECT_LT(interval({5, 0, 0}, {1, 0, 0}).y, 0.0);
    const Vec2<double> miss = interval({-5, 2.1, 0}, {1, 0, 0});
    EXPECT_GT(miss.x, miss.y);
    const Vec2<double> diagonal = interval({-3, -3, 0}, glm::normalize(glm::dvec3(1, 1, 0)));
    EXPECT_NEAR(diagonal.x, (2.0 - 5.0 * pad) * std::numbers::sqrt2, 1e-13);
    EXPECT_NEAR(diagonal.y, (4.0 + 5.0 * pad) * std::numbers::sqrt2, 1e-13);
}

TEST(Box, IsWiderByAllThatTheTriangleTestMayBeOff) {
    // box.glsl: the triangle test and the slab test together move a plane by up to 11 u M. No smaller pad is promised
    // to do, however rare the rays are that show it.
    Random random(205);
    Tally missed("boxes missed within 11 u M", random.seed());
    for (int i = 0; i < 500'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::vec3 half(glm::abs(random.inCube(scale)) + glm::dvec3(0.01 * scale));
        const int axis = static_cast<int>(random.below(3));
        const int other = (axis + 1 + static_cast<int>(random.below(2))) % 3;
        const double side = random.coin() ? 1.0 : -1.0;
        glm::vec3 origin(random.inCube(0.01 * scale));
        origin[axis] = static_cast<float>((random.coin() ? 1 : -1) * scale * random.logUniform(1.0, 1e3));
        const double reach = std::abs(static_cast<double>(origin[axis])) + static_cast<double>(half[axis]);
        const double allowed = 11.0 * 0x1p-24 * reach;
        origin[other] = static_cast<float>(side * (static_cast<double>(half[other]) + 0.98 * allowed));
        const double outside =
            std::abs(static_cast<double>(origin[other])) - static_cast<double>(half[other]);
        if (outside > allowed || static_cast<double>(half[other]) + std::abs(origin[other]) > reach)
            continue; // by the rounding of the origin, or another axis is the longest
        glm::vec3 direction(0.0f);
        direction[axis] = origin[axis] > 0 ? -1.0f : 1.0f;
        const BoxRay<float> ray = makeBoxRay(origin, direction, -half, half);
        const Vec2<float> interval = boxInterval(ray, -half, half);
        missed.check(interval.x <= interval.y, [&] {
            return fmt::format("{}, origin {}, direction {}", text(half), text(origin), text(direction));
        });
    }
    EXPECT_GT(missed.count(), 300'000u);
    missed.expectNone();
}

TEST(Box, IsNotMuchWiderThanItIs) {
    // The pad is 16 u M: a ray that passes at 64 u of that distance misses.
    Random random(204);
    Tally wrong("rays that pass by but are not told so", random.seed());
    for (int i = 0; i < 500'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::vec3 half(glm::abs(random.inCube(scale)) + glm::dvec3(0.01 * scale));
        const int axis = static_cast<int>(random.below(3));
        const int other = (axis + 1) % 3;
        glm::vec3 origin(random.inCube(scale));
        origin[axis] = static_cast<float>(-4.0 * scale);
        const double reach = 5.0 * scale;
        origin[other] = static_cast<float>(static_cast<double>(half[other]) + 64.0 * 0x1p-24 * reach);
        glm::vec3 direction(0.0f);
        direction[axis] = 1.0f;
        const BoxRay<float> ray = makeBoxRay(origin, direction, -half, half);
        const Vec2<float> interval = boxInterval(ray, -half, half);
        wrong.check(interval.x > interval.y);
    }
    wrong.expectNone();
}

} // namespace
} // namespace hyalite::core::reference
