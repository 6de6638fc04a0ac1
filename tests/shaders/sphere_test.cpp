#include "tests/fixtures/leaves.h"

#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <optional>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;
using hyalite::core::testing::text;
using LongVec = glm::vec<3, long double>;

/// The roots for a direction of any length, and what the error bound below is made of.
struct ExactSphere {
    long double b;            ///< f.d / d.d: where the ray is nearest to the centre is at -b
    long double discriminant; ///< squared half chord
    long double offCentre;    ///< distance of the ray from the centre

    ExactSphere(const glm::vec3 &origin, const glm::vec3 &direction, const glm::vec3 &centre, float radius) {
        const LongVec d(direction);
        const LongVec f = LongVec(origin) - LongVec(centre);
        const long double dd = glm::dot(d, d);
        b = glm::dot(f, d) / dd;
        const LongVec nearest = f - d * b;
        offCentre = glm::length(nearest);
        discriminant = (static_cast<long double>(radius) - offCentre) *
                       (static_cast<long double>(radius) + offCentre) / dd;
    }

    /// The smallest positive one, or a negative number.
    [[nodiscard]] long double distance() const {
        if (!(discriminant > 0.0L))
            return -1.0L;
        const long double root = std::sqrt(discriminant);
        return -b - root > 0.0L ? -b - root : -b + root;
    }
};

struct SphereKind {
    const char *name;
    double radius;
    double centreDistance;
    double originDistance; ///< from the centre, at most
};

TEST(Sphere, DistancesAreThoseOfTheClosedForm) {
    // With S the larger of the origin's distance to the centre and the radius, h the half chord and n the ray's
    // distance from the centre, b is off by a few u S, n by a few u S, so h by a few u S n / h, and c by a few u S^2,
    // which the quotient divides by |b| + h.
    const SphereKind kinds[] = {{"unit", 1.0, 0.0, 10.0},
                                {"small", 1e-3, 1.0, 2.0},
                                {"tiny", 1e-8, 0.0, 1e-7},
                                {"wall of radius 940 at 1000", 940.0, 1000.0, 940.0},
                                {"giant", 1e6, 1e6, 2e6},
                                {"far", 1.0, 1e4, 1e4},
                                {"far and small", 1e-2, 10., 500.0},
                                {"enormous", 1e15, 1e15, 2e15}};
    Random random(401);
    for (const SphereKind &kind : kinds) {
        Tally wrong(fmt::format("{} spheres: distances off by more than the bound", kind.name),
                    random.seed());
        double worst = 0.0;
        double worstRelative = 0.0;
        for (int i = 0; i < 200'000; ++i) {
            const glm::vec3 centre(random.direction() * kind.centreDistance);
            const float radius = static_cast<float>(kind.radius * random.uniform(0.5, 1.0));
            const glm::vec3 origin(glm::dvec3(centre) +
                                   random.direction() * (kind.originDistance * random.uniform(1e-3, 1.0)));
            const glm::dvec3 target = glm::dvec3(centre) + random.inBall(0.999 * static_cast<double>(radius));
            const glm::vec3 direction(glm::normalize(target - glm::dvec3(origin)));
            const ExactSphere exact(origin, direction, centre, radius);
            const double s =
                std::max(glm::distance(glm::dvec3(origin), glm::dvec3(centre)), static_cast<double>(radius));
            const double u = 0x1p-24;
            const double n = static_cast<double>(exact.offCentre);
            const double h = static_cast<double>(std::sqrt(std::max(exact.discriminant, 0.0L)));
            if (!(h * h > 64.0 * u * s * n)) // grazing: whether it hits is rounding's choice
                continue;
            const double unit = u * (s + s * n / h + s * s / (std::abs(static_cast<double>(exact.b)) + h));
            const long double near = -exact.b - static_cast<long double>(h);
            if (std::abs(static_cast<double>(near)) < 16.0 * unit) // starts on the sphere
                continue;
            const float distance = intersectSphere(origin, direction, centre, radius, false);
            const double expected = static_cast<double>(exact.distance());
            const double error = std::abs(static_cast<double>(distance) - expected);
            if (expected > 0.0) {
                worst = std::max(worst, error / unit);
                worstRelative = std::max(worstRelative, error / expected);
            }
            wrong.check(expected > 0.0 ? error <= 8.0 * unit : distance <= 0.0f, [&] {
                return fmt::format("origin {} direction {} centre {} radius {:a}: {} not {}", text(origin),
                                   text(direction), text(centre), radius, distance, expected);
            });
        }
        fmt::print("    worst: {:.2f} of the unit u (S + S n/h + S^2/(|b|+h)), relative {:.2e}\n", worst,
                   worstRelative);
        EXPECT_GT(wrong.count(), 150'000u);
        wrong.expectNone();
    }
}

TEST(Sphere, HeadOnDistancesAreExact) {
    EXPECT_EQ(intersectSphere<float>({0, 0, 5}, {0, 0, -1}, {0, 0, 0}, 1, false), 4.0f);
    EXPECT_EQ(intersectSphere<float>({0, 0, 0}, {0, 0, -1}, {0, 0, 0}, 1, false), 1.0f);
    EXPECT_EQ(intersectSphere<float>({0, 0, 0.5f}, {0, 0, -1}, {0, 0, 0}, 1, false), 1.5f);
    EXPECT_EQ(intersectSphere<float>({0, 0, 0}, {1, 0, 0}, {1000, 0, 0}, 940, false), 60.0f);
    EXPECT_EQ(intersectSphere<double>({0, 0, 5}, {0, 0, -1}, {0, 0, 0}, 1, false), 4.0);
}

TEST(Sphere, BehindTheOriginIsNeverHit) {
    Random random(402);
    Tally wrong("spheres behind the origin that are hit", random.seed());
    for (int i = 0; i < 1'000'000; ++i) {
        const double radius = random.logUniform(1e-6, 1e6);
        const glm::dvec3 centre = random.inCube(radius * random.logUniform(0.1, 1e4));
        const glm::dvec3 outward = random.direction();
        // By more than the rounding of the coordinates in front of it.
        const double gap = 1e-5 * (glm::length(centre) + radius) * random.logUniform(1.0, 1e4);
        const glm::vec3 origin(centre + outward * (radius + gap));
        const glm::dvec3 any = random.direction();
        const glm::vec3 direction(glm::dot(any, outward) < 0 ? -any : any);
        wrong.check(
            intersectSphere(origin, direction, glm::vec3(centre), static_cast<float>(radius), false) <= 0);
    }
    wrong.expectNone();
}

TEST(Sphere, TangentsAreMissedAndTheirNeighboursAreNot) {
    for (const float radius : {1.0f, 0.25f, 940.0f}) {
        const auto distance = [&](float height) {
            return intersectSphere<float>({-2 * radius, height, 0}, {1, 0, 0}, {0, 0, 0}, radius, false);
        };
        EXPECT_LT(distance(radius), 0.0f);
        EXPECT_LT(distance(std::nextafter(radius, 2 * radius)), 0.0f);
        const float below = distance(std::nextafter(radius, 0.0f));
        EXPECT_GT(below, 0.0f);
        EXPECT_NEAR(below, 2 * radius, 0.001f * radius);
    }
}

/// A point on a sphere as the renderer finds it: by a ray from outside or from inside.
struct SurfacePoint {
    layout::SphereRecord sphere{};
    Surface<float> surface;

    static std::optional<SurfacePoint> find(Random &random, double radius, double centreDistance) {
        SurfacePoint point;
        point.sphere.radius = static_cast<float>(radius);
        point.sphere.centre = glm::vec3(random.direction() * centreDistance);
        const glm::dvec3 centre(point.sphere.centre);
        const glm::vec3 origin(centre + random.direction() * (radius * random.logUniform(1e-2, 1e2)));
        const glm::vec3 direction(glm::normalize(centre + random.inBall(radius) - glm::dvec3(origin)));
        const float distance =
            intersectSphere(origin, direction, point.sphere.centre, point.sphere.radius, false);
        if (!(distance > 0))
            return std::nullopt;
        point.surface = sphereSurface<float>(origin, direction, distance, point.sphere);
        return point;
    }

    [[nodiscard]] float distanceAlong(const glm::vec3 &direction) const {
        return intersectSphere(offsetRayOrigin(surface, direction), direction, sphere.centre, sphere.radius,
                               true);
    }
};

TEST(Sphere, ARayThatLeavesItOutwardsNeverMeetsItAgain) {
    Random random(403);
    Tally again("rays that meet the sphere that they leave", random.seed());
    Tally grazing("grazing rays (cosine below 1e-6) that meet it again", random.seed());
    while (again.count() < 1'000'000) {
        const double radius = random.logUniform(1e-6, 1e6);
        const auto point =
            SurfacePoint::find(random, radius, random.coin() ? 0.0 : radius * random.logUniform(0.1, 1e3));
        if (!point)
            continue;
        const glm::dvec3 normal(point->surface.normal);
        const glm::dvec3 any = random.direction();
        const glm::vec3 direction(glm::dot(any, normal) < 0 ? -any : any);
        if (glm::dot(glm::dvec3(direction), normal) > 1e-6)
            again.check(!(point->distanceAlong(direction) > 0));
        // Tangential up to rounding: the sign of the cosine is not certain, but a chord as short as that does not
        // count.
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, any));
        const glm::vec3 nearlyTangent(glm::normalize(tangent + normal * random.logUniform(1e-9, 1e-6)));
        if (dotProduct(nearlyTangent, point->surface.normal) > 0)
            grazing.check(!(point->distanceAlong(nearlyTangent) > 0));
    }
    again.expectNone();
    grazing.expectNone();
}

TEST(Sphere, TheChordFromInsideEndsOnTheOtherSide) {
    Random random(404);
    Tally wrong("chords that do not end on the sphere", random.seed());
    Tally missing("rays into the sphere without a chord", random.seed());
    while (wrong.count() < 500'000) {
        const double radius = random.logUniform(1e-6, 1e6);
        const double centreDistance = random.coin() ? 0.0 : radius * random.logUniform(0.1, 100.0);
        const auto point = SurfacePoint::find(random, radius, centreDistance);
        if (!point)
            continue;
        const glm::dvec3 normal(point->surface.normal);
        const glm::dvec3 any = random.direction();
        const glm::vec3 direction(glm::dot(any, normal) > 0 ? -any : any);
        const double cosine = -glm::dot(glm::dvec3(direction), normal);
        const double distance = static_cast<double>(point->distanceAlong(direction));
        if (cosine > 1e-6)
            missing.check(distance > 0.0);
        const double expected = 2.0 * static_cast<double>(point->sphere.radius) * cosine;
        wrong.check(std::abs(distance - expected) <= 64.0 * 0x1p-24 * (radius * 101.0 + centreDistance),
                    [&] { return fmt::format("radius {}, chord {} not {}", radius, distance, expected); });
    }
    missing.expectNone();
    wrong.expectNone();
}

TEST(Sphere, NormalsPointOutwardsUnlessTheSphereIsInverted) {
    layout::SphereRecord sphere{};
    sphere.centre = {1, 2, 3};
    sphere.radius = 2;
    Surface<float> surface = sphereSurface<float>({1, 2, 10}, {0, 0, -1}, 5, sphere);
    EXPECT_EQ(surface.position, glm::vec3(1, 2, 5));
    EXPECT_EQ(surface.normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(surface.geometricNormal, glm::vec3(0, 0, 1));
    sphere.materialAndSide = layout::sphereFacesInward;
    surface = sphereSurface<float>({1, 2, 10}, {0, 0, -1}, 5, sphere);
    EXPECT_EQ(surface.normal, glm::vec3(0, 0, -1));
    EXPECT_EQ(offsetRayOrigin(surface, {0, 1, 0}), surface.position) << "spheres need no offset";
}

TEST(Sphere, TwoTouchingBallsAreMetInOrder) {
    Scene scene;
    scene.materials.resize(1);
    scene.spheres.push_back({{-10, 0, 0}, 10.0, 0, false});
    scene.spheres.push_back({{10, 0, 0}, 10.0, 0, false});
    const PackedScene packed = hyalite::core::testing::packed(scene);
    const auto meet = [&](const glm::vec3 &origin, const glm::vec3 &direction, std::uint32_t excluded) {
        return closestHit(packed, Ray<float>{origin, direction, excluded});
    };
    Hit<float> hit = meet({-100, 0, 0}, {1, 0, 0}, layout::noPrimitive);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.distance, 80.0f);
    hit = meet({100, 0, 0}, {-1, 0, 0}, layout::noPrimitive);
    EXPECT_EQ(hit.primitive, 1u);
    EXPECT_EQ(hit.distance, 80.0f);
    // Through the first ball to the point of contact: both spheres are at 20, and the smaller id is the nearer one.
    hit = meet({-20, 0, 0}, {1, 0, 0}, 0);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.distance, 20.0f);
    // From the contact into the second ball: the contact itself, at distance 0, is no hit.
    hit = meet({0, 0, 0}, {1, 0, 0}, 0);
    EXPECT_EQ(hit.primitive, 1u);
    EXPECT_EQ(hit.distance, 20.0f);
    // From the first ball close to the contact, across the narrow gap.
    Random random(405);
    for (int i = 0; i < 10'000; ++i) {
        const double angle = random.logUniform(1e-3, 1e-1);
        const double around = random.uniform(0.0, 2.0 * std::numbers::pi);
        const glm::dvec3 normal(std::cos(angle), std::sin(angle) * std::cos(around),
                                std::sin(angle) * std::sin(around));
        const glm::vec3 origin(glm::dvec3(-10, 0, 0) + normal * 10.0);
        hit = meet(origin, glm::vec3(normal), 0);
        ASSERT_EQ(hit.primitive, 1u) << "seed " << random.seed();
        ASSERT_GT(hit.distance, 0.0f);
        const ExactSphere second(origin, glm::vec3(normal), {10, 0, 0}, 10.0f);
        ASSERT_NEAR(hit.distance, static_cast<double>(second.distance()), 2e-5) << "seed " << random.seed();
    }
}

} // namespace
} // namespace hyalite::core::reference
