// Rays through the device's own tree have the hits of rays through ours, bit for bit. HYALITE_RAYS sets how many are traced.
#include "host/gpu/kernel_needs.h"
#include "host/gpu/ray_tracer.h"
#include "tests/fixtures/test_device.h"
#include "tests/kernels/all_kernels.h"
#include "tests/packing/tree_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

constexpr float unbounded = std::numeric_limits<float>::max();
constexpr std::size_t raysAtOnce = std::size_t{1} << 16;

std::size_t rayCount() {
    const char *wanted = std::getenv("HYALITE_RAYS");
    return wanted != nullptr ? std::stoul(wanted) : raysAtOnce;
}

/// Each triangle twice, so that each hit is a tie, and some flat.
Scene soup(float size, const glm::vec3 &centre) {
    Scene scene = randomScene(1000, size, centre);
    TriangleMesh &mesh = scene.meshes.front();
    for (std::size_t i = 0; i < mesh.positions.size() / 4; ++i)
        mesh.positions[i].y = mesh.positions[i / 3 * 3].y;
    const std::vector<MeshTriangle> once = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), once.rbegin(), once.rend());
    return scene;
}

/// The soup in its own place and in others, turned and flattened.
Scene instances() {
    Scene scene = soup(1.0f, glm::vec3(0.0f));
    scene.prototypes.push_back(scene.meshes.front());
    Placement turned;
    turned.rows = {glm::vec3(0.6f, 0.8f, 0.0f), glm::vec3(-0.8f, 0.6f, 0.0f), glm::vec3(0.0f, 0.0f, 1.5f)};
    turned.offset = glm::vec3(1.3f, -0.2f, 0.1f);
    Placement flat;
    flat.rows = {glm::vec3(1.0f, 0.0f, 0.3f), glm::vec3(0.0f, 1e-3f, 0.0f), glm::vec3(0.0f, -2.0f, 1.0f)};
    flat.offset = glm::vec3(-1.0f, 0.7f, 0.2f);
    for (const Placement &placement : {turned, flat}) {
        Instance instance;
        instance.toWorld = placement;
        scene.instances.push_back(instance);
    }
    return scene;
}

/// Rays at corners, edges and insides of triangles and past them, from near and from far, some along axes; to no end, or
/// to the place at which they are aimed.
std::vector<layout::RayRecord> drawRays(const PackedScene &scene, std::mt19937 &random) {
    std::uniform_real_distribution<float> uniform;
    const glm::vec3 middle = (scene.frame.boundsLower + scene.frame.boundsUpper) * 0.5f;
    const glm::vec3 size = scene.frame.boundsUpper - scene.frame.boundsLower;
    std::vector<layout::RayRecord> rays;
    while (rays.size() < raysAtOnce) {
        const layout::TriangleRecord &triangle = scene.triangles[random() % scene.triangles.size()];
        const auto kind = static_cast<std::uint32_t>(random());
        const float u = (kind & 1) != 0 ? uniform(random) : 0.0f;
        const float v = (kind & 2) != 0 ? uniform(random) * (1.0f - u) : 0.0f;
        const glm::vec3 place =
            triangle.v0 + (triangle.v1 - triangle.v0) * u + (triangle.v2 - triangle.v0) * v;
        constexpr float reaches[] = {0.5f, 1.0f, 3.0f, 100.0f};
        const float further = (kind >> 13 & 31) == 0 ? 3000.0f : 1.0f;
        glm::vec3 origin = middle + (glm::vec3(uniform(random), uniform(random), uniform(random)) - 0.5f) *
                                        glm::length(size) * (reaches[kind >> 2 & 3] * further);
        if ((kind >> 4 & 3) == 0)
            origin[kind >> 6 & 1] = place[kind >> 6 & 1];
        if ((kind >> 7 & 7) == 0)
            origin = place - glm::vec3(kind >> 10 & 1, kind >> 11 & 1, 1.0f) * size;
        const float distance = glm::length(place - origin);
        if (!(distance > 0.0f))
            continue;
        rays.push_back({origin, (kind >> 12 & 1) != 0 ? unbounded : distance, (place - origin) / distance,
                        layout::noPrimitive});
    }
    return rays;
}

gpu::RayKernel kernelOf(const char *name) {
    const gpu::KernelRow &row = *gpu::findKernel(name);
    const std::vector<EmbeddedKernel> kernels = allKernels();
    return {row, std::ranges::find(kernels, gpu::moduleName("traceRays", row), &EmbeddedKernel::name)->words};
}

void expectSameHits(const char *name, const PackedScene &scene) {
    const gpu::RayKernel skipList = kernelOf("skip-list");
    const gpu::RayKernel query = kernelOf("ray-query");
    gpu::RayScene ours(testDevice(), scene, skipList.row);
    gpu::RayScene theirs(testDevice(), scene, query.row);
    std::mt19937 random(5);
    std::size_t hitCount = 0;
    for (std::size_t traced = 0; traced < rayCount(); traced += raysAtOnce) {
        const std::vector<layout::RayRecord> rays = drawRays(scene, random);
        for (const gpu::RayGoal goal : {gpu::RayGoal::NearestHit, gpu::RayGoal::AnyHit}) {
            gpu::RayTracer wanted(ours, skipList, goal, rays);
            gpu::RayTracer found(theirs, query, goal, rays);
            wanted.run();
            found.run();
            const std::vector<layout::HitRecord> wantedHits = wanted.hits();
            const std::vector<layout::HitRecord> foundHits = found.hits();
            const auto isSame = [](const layout::HitRecord &a, const layout::HitRecord &b) {
                return std::memcmp(&a, &b, sizeof(a)) == 0;
            };
            const auto differing = std::ranges::mismatch(wantedHits, foundHits, isSame);
            EXPECT_EQ(differing.in1, wantedHits.end())
                << name << ", ray " << traced + static_cast<std::size_t>(differing.in1 - wantedHits.begin());
            hitCount +=
                static_cast<std::size_t>(std::ranges::count_if(wantedHits, [](const layout::HitRecord &hit) {
                    return hit.primitive != layout::noPrimitive;
                }));
        }
    }
    EXPECT_GT(hitCount, rayCount() / 2) << name;
}

TEST(RayQuery, FindsTheHitsOfSkipLists) {
    if (const std::string lack = gpu::lackFor(*gpu::findKernel("ray-query"), testDevice()); !lack.empty())
        GTEST_SKIP() << testDevice().name << " " << lack;
    expectSameHits("at the origin", pack(soup(1.0f, glm::vec3(0.0f)), TreeKind::Sah, 4));
    expectSameHits("far away", pack(soup(1.0f, glm::vec3(300.0f, -1000.0f, 7.0f)), TreeKind::Sah, 4));
    expectSameHits("tiny", pack(soup(1e-6f, glm::vec3(0.0f)), TreeKind::Sah, 4));
    const Scene placed = instances();
    expectSameHits("instances", packScene(placed, buildBvh(TreeKind::Sah, placed, 4)));
}

} // namespace
} // namespace hyalite::core::testing
