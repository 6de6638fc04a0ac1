// No hit of a primitive is outside its box as a device may test it.
#include "host/packing/primitive_boxes.h"

#include "host/leaves/leaves.h"
#include "tests/packing/tree_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace hyalite::core::testing {
namespace {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction;
};

/// Whether a device finds the box before `end`: by differences as lavapipe does, or by products.
bool isFound(const Box &box, const Ray &ray, float end, bool isByDifferences) {
    float enter = -std::numeric_limits<float>::infinity();
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float direction = ray.direction[axis];
        const float inverse = direction == 0.0f ? std::numeric_limits<float>::max() : 1.0f / direction;
        const auto distanceTo = [&](float plane) {
            return isByDifferences ? (plane - ray.origin[axis]) * inverse
                                   : plane * inverse - ray.origin[axis] * inverse;
        };
        if (!isByDifferences && direction == 0.0f) {
            if (ray.origin[axis] < box.lower[axis] || ray.origin[axis] > box.upper[axis])
                return false;
            continue;
        }
        const auto [near, far] = std::minmax(distanceTo(box.lower[axis]), distanceTo(box.upper[axis]));
        enter = std::max(enter, near);
        leave = std::min(leave, far);
    }
    return leave >= std::max(enter, 0.0f) && enter < end;
}

/// Draws rays at the corners, edges and insides of a triangle, from up to as far away as pads allow.
std::vector<Ray> raysAt(const leaves::TriangleRecord<float> &triangle, const PackedScene &scene,
                        std::mt19937 &random) {
    std::uniform_real_distribution<float> uniform;
    const glm::vec3 size = scene.frame.boundsUpper - scene.frame.boundsLower;
    const float largest = std::max({size.x, size.y, size.z});
    std::vector<Ray> rays;
    for (const float reach : {0.01f, 1.0f, 20.0f, 120.0f})
        for (const float u : {0.0f, 1.0f, uniform(random)}) {
            const float v = random() % 2 == 0 ? 0.0f : (1.0f - u) * uniform(random);
            const glm::vec3 place =
                triangle.v0 + (triangle.v1 - triangle.v0) * u + (triangle.v2 - triangle.v0) * v;
            glm::vec3 way(uniform(random) - 0.5f, uniform(random) - 0.5f, uniform(random) - 0.5f);
            for (int axis = 0; axis < 3; ++axis)
                if (random() % 4 == 0)
                    way[axis] *= random() % 2 == 0 ? 0.0f : 1e-6f;
            if (way == glm::vec3(0.0f))
                continue;
            const glm::vec3 direction = leaves::unitVector<float>(way);
            rays.push_back({place - direction * (reach * largest), direction});
        }
    return rays;
}

/// Returns how many hits were compared.
std::size_t expectNothingLost(const PackedScene &scene) {
    const PrimitiveBoxes made = makePrimitiveBoxes(scene);
    EXPECT_EQ(made.boxes.size(), countPrimitiveBoxes(scene));
    EXPECT_EQ(made.counts.size(), 1 + scene.instances.size());
    const glm::vec3 &lower = scene.frame.boundsLower;
    const glm::vec3 &upper = scene.frame.boundsUpper;
    const float pad = leaves::queryBoxPad<float>(lower, upper);
    std::mt19937 random(3);
    std::size_t box = 0;
    std::size_t hitCount = 0;
    std::size_t lostCount = 0;
    for (std::size_t geometry = 0; geometry < made.counts.size(); ++geometry) {
        for (std::uint32_t i = 0; i < made.counts[geometry]; ++i, ++box) {
            const std::uint32_t begin = geometry == 0 ? 0 : made.instances[geometry - 1].listBegin;
            leaves::TriangleRecord<float> triangle = scene.triangles[begin + i];
            if (geometry > 0)
                triangle = leaves::placedTriangle<float>(made.instances[geometry - 1], triangle);
            for (const Ray &ray : raysAt(triangle, scene, random)) {
                const auto boxRay = leaves::makeBoxRay<float>(ray.origin, ray.direction, lower, upper);
                const auto hit = leaves::intersectTriangle<float>(
                    leaves::makeTriangleRay<float>(ray.origin, ray.direction), boxRay, triangle.v0,
                    triangle.v1, triangle.v2);
                if (!(hit.distance > 0.0f) || 2.0f * boxRay.pad > pad)
                    continue;
                ++hitCount;
                for (const bool isByDifferences : {true, false})
                    lostCount += isFound(made.boxes[box], ray, hit.distance, isByDifferences) ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(lostCount, 0u);
    return hitCount;
}

TEST(PrimitiveBoxes, LoseNoHit) {
    for (const auto &[size, centre] :
         {std::pair(1.0f, glm::vec3(0.0f)), std::pair(1e-9f, glm::vec3(0.0f)),
          std::pair(1e6f, glm::vec3(3e6f, 0.0f, -2e7f)), std::pair(1.0f, glm::vec3(2000.0f, -9000.0f, 7.0f))})
        EXPECT_GT(expectNothingLost(pack(randomScene(1000, size, centre), TreeKind::Sah, 4)), 3000u) << size;
}

TEST(PrimitiveBoxes, ArePlacedWithInstances) {
    Scene scene = randomScene(300, 1.0f, glm::vec3(0.0f));
    scene.prototypes.push_back(scene.meshes.front());
    for (const float height : {1.0f, 1e-4f}) {
        Instance instance;
        instance.toWorld.rows = {glm::vec3(0.6f, 0.8f, 0.0f), glm::vec3(-0.8f, 0.6f, 0.3f) * height,
                                 glm::vec3(0.0f, 0.2f, 1.5f)};
        instance.toWorld.offset = glm::vec3(1.3f, height, -40.0f);
        scene.instances.push_back(instance);
    }
    EXPECT_GT(expectNothingLost(packScene(scene, buildBvh(TreeKind::Sah, scene, 4))), 3000u);
}

} // namespace
} // namespace hyalite::core::testing
