// Rays meet an instance exactly where they meet the mesh into which it is flattened.
#include "host/reference/closest_hit.h"
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_extent.h"

#include <gtest/gtest.h>

#include <ostream>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;

/// A map with singular values 1, 1/sqrt(condition) and 1/condition, or such, times `scale`.
Placement randomPlacement(Random &random, double scale, double condition, const glm::dvec3 &offset) {
    const glm::dvec3 x = random.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
    const glm::dvec3 z = glm::cross(x, y) * (random.coin() ? 1.0 : -1.0);
    const glm::dvec3 a = random.direction();
    const glm::dvec3 b = glm::normalize(glm::cross(a, random.direction()));
    const glm::dvec3 c = glm::cross(a, b);
    Placement placement;
    for (glm::length_t row = 0; row < 3; ++row)
        placement.rows[static_cast<std::size_t>(row)] =
            glm::vec3(scale * (x[row] * a + y[row] * b / std::sqrt(condition) + z[row] * c / condition));
    placement.offset = glm::vec3(offset);
    return placement;
}

struct Case {
    const char *name;
    double scale;
    double condition;
    glm::dvec3 offset;     ///< of the instances
    glm::dvec3 meshOffset; ///< of the mesh in its own space

    friend std::ostream &operator<<(std::ostream &stream, const Case &each) { return stream << each.name; }
};

constexpr std::array cases{
    Case{"at the origin", 1.0, 2.0, glm::dvec3(0.0), glm::dvec3(0.0)},
    Case{"at offset 1e6", 10.0, 2.0, glm::dvec3(1e6, -1e6, 1e6), glm::dvec3(0.0)},
    Case{"of a mesh at offset 1e6", 1.0, 2.0, glm::dvec3(0.0), glm::dvec3(1e6, 1e6, -1e6)},
    Case{"with condition number 1e6", 1.0, 1e6, glm::dvec3(0.0), glm::dvec3(0.0)},
    Case{"with condition number 1e6 at offset 1e6", 100.0, 1e6, glm::dvec3(1e6, 0.0, 1e6), glm::dvec3(0.0)},
    Case{"scaled by 1e-6", 1e-6, 5.0, glm::dvec3(0.0), glm::dvec3(0.0)},
    Case{"scaled by 1e6", 1e6, 5.0, glm::dvec3(0.0), glm::dvec3(0.0)},
};

/// Eight instances of a mesh, as instances and as meshes.
struct Pair {
    PackedScene instances;
    PackedScene meshes;
    Scene flattened;

    Pair(const TriangleMesh &mesh, const Case &each, Random &random, TreeKind tree) {
        Scene scene;
        scene.materials.push_back({});
        std::vector<Placement> placements;
        const TriangleMesh moved = hyalite::core::testing::placed(mesh, 1.0, each.meshOffset);
        for (int i = 0; i < 8; ++i) {
            Placement placement = randomPlacement(random, each.scale, each.condition,
                                                  each.offset + random.inCube(2.0 * each.scale));
            // Back to the origin from where the mesh is.
            for (glm::length_t row = 0; row < 3; ++row)
                placement.offset[row] -= static_cast<float>(
                    glm::dot(glm::dvec3(placement.rows[static_cast<std::size_t>(row)]), each.meshOffset));
            placements.push_back(placement);
        }
        addInstances(scene, moved, placements);
        instances = packScene(scene, buildBvh(tree, scene, 4));
        flattened = scene;
        arrangeInstances(flattened, Flattening::All);
        meshes = packScene(flattened, buildBvh(tree, flattened, 4));
    }
};

/// Towards a random point of the scene's triangles, a vertex or an edge half of the time.
glm::dvec3 targetOn(const Scene &scene, Random &random) {
    const TriangleMesh &mesh = scene.meshes[random.below(scene.meshes.size())];
    const glm::uvec3 corners = mesh.triangles[random.below(mesh.triangles.size())].positions;
    double u = random.uniform();
    double v = random.uniform(0.0, 1.0 - u);
    if (random.coin()) {
        u = random.coin() ? 0.0 : u;
        v = 0.0;
    }
    return glm::dvec3(mesh.positions[corners.x]) * u + glm::dvec3(mesh.positions[corners.y]) * v +
           glm::dvec3(mesh.positions[corners.z]) * (1.0 - u - v);
}

/// Near a target, in its plane, or far away.
Ray<float> randomRay(const Pair &pair, const Case &each, Random &random) {
    const glm::dvec3 target = targetOn(pair.flattened, random);
    const double distance = each.scale * random.logUniform(1e-3, 1e3);
    const glm::dvec3 away = random.coin() ? random.direction()
                                          : glm::normalize(targetOn(pair.flattened, random) - target + 1e-30);
    const glm::vec3 origin(target + away * distance);
    const glm::dvec3 direction = target - glm::dvec3(origin);
    return {origin, glm::length(direction) > 0.0 ? glm::vec3(glm::normalize(direction)) : glm::vec3(1, 0, 0)};
}

struct NameOf {
    std::string operator()(const ::testing::TestParamInfo<Case> &info) const {
        std::string name = info.param.name;
        std::ranges::replace_if(
            name, [](char c) { return c == ' ' || c == '-'; }, '_');
        return name;
    }
};

class InstanceHits : public ::testing::TestWithParam<Case> {};

TEST_P(InstanceHits, AreThoseOfTheFlattenedMesh) {
    const Case each = GetParam();
    Random random(501);
    Tally different(fmt::format("different hits on instances {}", each.name), random.seed());
    std::size_t hitCount = 0;
    const std::array meshes{hyalite::core::testing::icosphere(2), hyalite::core::testing::spikyStar(),
                            hyalite::core::testing::gridCube(4),
                            hyalite::core::testing::triangleSoup(random, 200, 1.0, 0.7)};
    for (const TriangleMesh &mesh : meshes)
        for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
            const Pair pair(mesh, each, random, tree);
            EXPECT_EQ(pair.instances.frame.boundsLower, pair.meshes.frame.boundsLower);
            EXPECT_EQ(pair.instances.frame.boundsUpper, pair.meshes.frame.boundsUpper);
            for (int i = 0; i < hyalite::core::testing::repetitions(3'000, 20'000); ++i) {
                const Ray<float> ray = randomRay(pair, each, random);
                const Hit<float> a = closestHit(pair.instances, ray);
                const Hit<float> b = closestHit(pair.meshes, ray);
                hitCount += b.primitive != layout::noPrimitive ? 1u : 0u;
                different.check(a.primitive == b.primitive &&
                                    hyalite::core::testing::sameBits(a.distance, b.distance) &&
                                    hyalite::core::testing::sameBits(a.u, b.u) &&
                                    hyalite::core::testing::sameBits(a.v, b.v),
                                [&] {
                                    return fmt::format("{} at {:a}, not {} at {:a}", a.primitive, a.distance,
                                                       b.primitive, b.distance);
                                });
            }
        }
    EXPECT_GT(hitCount, different.count() / 4);
    different.expectNone();
}

INSTANTIATE_TEST_SUITE_P(Instances, InstanceHits, ::testing::ValuesIn(cases), NameOf());

// Two texts: the host flattens by its own.
TEST(Flattening, RoundsAsShadersDo) {
    Random random(503);
    Tally different("flattened points and normals that differ from placed ones", random.seed());
    for (int i = 0; i < 100'000; ++i) {
        const Placement placement = randomPlacement(random, random.logUniform(1e-6, 1e6),
                                                    random.logUniform(1.0, 1e6), random.inCube(1e3));
        layout::InstanceRecord record{};
        record.toX = placement.rows[0];
        record.toY = placement.rows[1];
        record.toZ = placement.rows[2];
        record.offsetX = placement.offset.x;
        record.offsetY = placement.offset.y;
        record.offsetZ = placement.offset.z;
        const glm::vec3 point(random.inCube(10.0));
        const glm::vec3 normal(i % 10 == 0 ? glm::dvec3(0.0) : random.direction());
        const auto isSame = [](const glm::vec3 &a, const glm::vec3 &b) {
            return hyalite::core::testing::sameBits(a.x, b.x) && hyalite::core::testing::sameBits(a.y, b.y) &&
                   hyalite::core::testing::sameBits(a.z, b.z);
        };
        different.check(
            isSame(hyalite::core::placedPoint(placement, point), placedPoint<float>(record, point)));
        different.check(
            isSame(hyalite::core::placedNormal(placement, normal), placedNormal<float>(record, normal)));
    }
    different.expectNone();
}

/// Where rounding leaves a closed mesh an inside.
class ClosedInstances : public ::testing::TestWithParam<Case> {};

TEST_P(ClosedInstances, DoNotLeak) {
    const Case each = GetParam();
    Random random(502);
    Tally leaks(fmt::format("leaks of instances {}", each.name), random.seed());
    for (int i = 0; i < 20; ++i) {
        Scene scene;
        scene.materials.push_back({});
        const std::array placements{randomPlacement(random, each.scale, each.condition, each.offset),
                                    randomPlacement(random, each.scale, each.condition, each.offset)};
        addInstances(scene, hyalite::core::testing::icosphere(2), placements);
        const PackedScene packed = packScene(scene, buildBvh(TreeKind::Sah, scene, 4));
        arrangeInstances(scene, Flattening::All);
        for (int k = 0; k < 2000; ++k) {
            const glm::dvec3 inside = each.offset + random.inBall(0.1 * each.scale);
            const glm::vec3 origin(inside);
            const glm::dvec3 direction = glm::normalize(targetOn(scene, random) - glm::dvec3(origin));
            leaks.check(closestHit(packed, Ray<float>{origin, glm::vec3(direction)}).primitive !=
                        layout::noPrimitive);
        }
    }
    leaks.expectNone();
}

INSTANTIATE_TEST_SUITE_P(Instances, ClosedInstances,
                         ::testing::Values(cases[0], cases[1], cases[5], cases[6]), NameOf());

} // namespace
} // namespace hyalite::core::reference
