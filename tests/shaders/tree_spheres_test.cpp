// Spheres in the tree: rays meet them where a loop over all spheres finds them.
#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;

struct TreeCase {
    const char *name;
    double minRadius;
    double greatestRadius;
    glm::dvec3 offset; ///< of all that is in a cube of edge 2

    friend std::ostream &operator<<(std::ostream &stream, const TreeCase &each) {
        return stream << each.name;
    }
};

constexpr std::array treeCases{
    TreeCase{"alike", 0.05, 0.1, glm::dvec3(0.0)},
    TreeCase{"of every size", 1e-6, 10.0, glm::dvec3(0.0)},
    TreeCase{"smaller than a unit of rounding", 1e-3, 1e-2, glm::dvec3(1e6, -1e6, 1e6)},
    TreeCase{"overlapping", 0.5, 1.0, glm::dvec3(1e3, 0.0, 0.0)},
};

/// Spheres of the case, some twice, around a few triangles.
Scene sceneOf(const TreeCase &each, Random &random) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].kind = MaterialKind::Dielectric;
    for (int i = 0; i < 400; ++i) {
        Sphere sphere;
        sphere.centre = glm::vec3(each.offset + random.inCube(1.0));
        sphere.radius = static_cast<float>(random.logUniform(each.minRadius, each.greatestRadius));
        sphere.materialIndex = static_cast<std::uint32_t>(i % 2);
        scene.spheres.push_back(sphere);
        if (i % 20 == 0)
            scene.spheres.push_back(sphere);
    }
    scene.meshes.push_back(hyalite::core::testing::placed(
        hyalite::core::testing::triangleSoup(random, 40, 1.0, 0.3), 1.0, each.offset));
    return scene;
}

/// Towards some point of a sphere, from near, from far away, or from another one.
Ray<float> randomRay(const Scene &scene, Random &random) {
    const auto pick = [&] { return static_cast<std::uint32_t>(random.below(scene.spheres.size())); };
    const Sphere &target = scene.spheres[pick()];
    const glm::dvec3 to = target.centre + random.direction() * target.radius * random.uniform(0.0, 1.2);
    Ray<float> ray;
    glm::dvec3 from = to + random.direction() * random.logUniform(1e-3, 1e2);
    if (random.coin()) {
        ray.excluded = pick();
        const Sphere &start = scene.spheres[ray.excluded];
        from = start.centre + random.direction() * start.radius;
    }
    ray.origin = glm::vec3(from);
    ray.direction = glm::vec3(glm::normalize(to - glm::dvec3(ray.origin) + 1e-30));
    return ray;
}

/// The nearest hit by the definition, over all primitives of the scene.
Hit<float> hitByLoop(const PackedScene &scene, const Ray<float> &ray) {
    const BoxRay<float> boxRay =
        makeBoxRay(ray.origin, ray.direction, scene.frame.boundsLower, scene.frame.boundsUpper);
    const TriangleRay<float> triangleRay = makeTriangleRay(ray.origin, ray.direction);
    Hit<float> nearest = noHit<float>();
    for (const layout::TriangleRecord &record : scene.triangles) {
        const std::uint32_t id = record.primitiveId;
        const float distance =
            id < scene.spheres.size()
                ? intersectBoxedSphere<float>(boxRay, ray.direction, scene.spheres[id].centre,
                                              scene.spheres[id].radius, id == ray.excluded)
                : intersectTriangle(triangleRay, boxRay, record.v0, record.v1, record.v2).distance;
        if (distance > 0 &&
            (distance < nearest.distance || (distance == nearest.distance && id < nearest.primitive)))
            nearest = {distance, id, id, 0.0f, 0.0f, layout::noInstance};
    }
    return nearest;
}

struct TreeCaseName {
    std::string operator()(const ::testing::TestParamInfo<TreeCase> &info) const {
        std::string name = info.param.name;
        std::ranges::replace(name, ' ', '_');
        return name;
    }
};

class TreeSpheres : public ::testing::TestWithParam<TreeCase> {};

TEST_P(TreeSpheres, AreHitAsByALoop) {
    const TreeCase each = GetParam();
    Random random(811);
    Tally different(fmt::format("other hits on spheres {}", each.name), random.seed());
    std::size_t hitCount = 0;
    for (const TreeKind tree : {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah}) {
        const Scene scene = sceneOf(each, random);
        const PackedScene packed = packScene(scene, buildBvh(tree, scene, 4));
        ASSERT_EQ(packed.treeSpheres, layout::treeHasSpheresToo);
        for (int i = 0; i < 20'000; ++i) {
            const Ray<float> ray = randomRay(scene, random);
            const Hit<float> found = closestHit(packed, ray);
            const Hit<float> wanted = hitByLoop(packed, ray);
            hitCount += wanted.primitive < scene.spheres.size() ? 1 : 0;
            different.check(found.primitive == wanted.primitive &&
                                hyalite::core::testing::sameBits(found.distance, wanted.distance),
                            [&] {
                                return fmt::format("{} at {:a}, not {} at {:a}", found.primitive,
                                                   found.distance, wanted.primitive, wanted.distance);
                            });
        }
    }
    EXPECT_GT(hitCount, different.count() / 3);
    different.expectNone();
}

// The box leaves hits alone: they are those of the sphere by itself, which sphere_test.cpp compares with the closed
// form.
TEST_P(TreeSpheres, AreHitWhereTheyAre) {
    const TreeCase each = GetParam();
    Random random(812);
    Tally moved(fmt::format("moved hits on spheres {}", each.name), random.seed());
    const Scene scene = sceneOf(each, random);
    const PackedScene packed = packScene(scene, buildBvh(TreeKind::Sah, scene, 4));
    for (int i = 0; i < 20'000; ++i) {
        const Ray<float> ray = randomRay(scene, random);
        const BoxRay<float> boxRay =
            makeBoxRay(ray.origin, ray.direction, packed.frame.boundsLower, packed.frame.boundsUpper);
        for (std::uint32_t id = 0; id < 20; ++id) {
            const layout::SphereRecord &sphere = packed.spheres[id];
            const bool startsThere = ray.excluded == id;
            const float alone = intersectSphere<float>(
                ray.origin, ray.direction, makeSphereShape<float>(sphere.centre, sphere.radius), startsThere);
            const float boxed =
                intersectBoxedSphere<float>(boxRay, ray.direction, sphere.centre, sphere.radius, startsThere);
            moved.check(hyalite::core::testing::sameBits(boxed, alone > 0 ? alone : 0.0f),
                        [&] { return fmt::format("{:a}, not {:a}", boxed, alone); });
        }
    }
    moved.expectNone();
}

INSTANTIATE_TEST_SUITE_P(Spheres, TreeSpheres, ::testing::ValuesIn(treeCases), TreeCaseName());

} // namespace
} // namespace hyalite::core::reference
