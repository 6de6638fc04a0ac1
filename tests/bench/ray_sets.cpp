#include "tests/bench/ray_sets.h"

#include "host/reference/closest_hit.h"
#include "tests/bench/parallel.h"
#include "tests/fixtures/leaves.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace hyalite::core::bench {

namespace {

using glm::vec3;

constexpr std::size_t raysAtOnce = 1024;
constexpr float unbounded = std::numeric_limits<float>::max();

/// Pixels in the order of the renderer's path slots (shaders/drive/places.glsl).
glm::uvec2 pixelOf(std::uint32_t index, std::uint32_t imageWidth) {
    const std::uint32_t block = index >> 6;
    const std::uint32_t k = index & 63u;
    const std::uint32_t blocksAcross = imageWidth / 8;
    return {block % blocksAcross * 8 + ((k & 3u) | (k >> 1 & 4u)),
            block / blocksAcross * 8 + ((k >> 2 & 1u) | (k >> 3 & 6u))};
}

/// One ray a pixel, each through the same place of its pixel.
std::vector<layout::RayRecord> primaryRays(const PackedScene &scene, const glm::vec2 &offset) {
    std::vector<layout::RayRecord> rays(std::size_t{scene.frame.imageWidth} * scene.frame.imageHeight);
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        const glm::uvec2 pixel = pixelOf(i, scene.frame.imageWidth);
        rays[i] = {scene.frame.eye, unbounded, reference::primaryDirection<float>(scene.frame, pixel, offset),
                   layout::noPrimitive};
    }
    return rays;
}

/// Where a primary ray arrives.
struct Arrival {
    reference::Surface<float> surface; ///< its geometric normal is on the ray's side
    std::uint32_t primitive;
};

/// Of four images, each sampled elsewhere in its pixels: meshes do not fill the image, and short runs are not steady.
std::vector<Arrival> arrivals(const PackedScene &scene) {
    constexpr glm::vec2 offsets[] = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f}};
    std::vector<Arrival> arrivals;
    for (const glm::vec2 &offset : offsets) {
        for (const layout::RayRecord &ray : primaryRays(scene, offset)) {
            const reference::Hit<float> hit =
                reference::closestHit(scene, reference::Ray<float>{ray.origin, ray.direction, ray.excluded});
            if (hit.primitive == layout::noPrimitive)
                continue;
            reference::Surface<float> surface = reference::triangleSurface<float>(
                scene.triangles[hit.record], layout::NormalRecord{}, hit.u, hit.v);
            if (reference::dotProduct(ray.direction, surface.geometricNormal) > 0.0f)
                surface.geometricNormal = -surface.geometricNormal;
            arrivals.push_back({surface, hit.primitive});
        }
    }
    return arrivals;
}

std::vector<layout::RayRecord> shadowRays(const PackedScene &scene) {
    std::vector<layout::RayRecord> rays;
    for (const Arrival &arrival : arrivals(scene)) {
        const vec3 toLight = scene.lights.front().position - arrival.surface.position;
        const float distance = reference::vectorLength(toLight);
        const vec3 direction = toLight * (1.0f / distance);
        if (reference::dotProduct(arrival.surface.geometricNormal, direction) > 0.0f)
            rays.push_back({reference::offsetRayOrigin(arrival.surface, direction), distance, direction,
                            arrival.primitive});
    }
    return rays;
}

std::vector<layout::RayRecord> bounceRays(const PackedScene &scene) {
    std::vector<layout::RayRecord> rays;
    for (const Arrival &arrival : arrivals(scene)) {
        // A point of the unit sphere around the tip of the normal is cosine-distributed as seen from the normal's foot.
        const glm::uvec3 hash = reference::hashKeys({static_cast<std::uint32_t>(rays.size()), 0, 0});
        const float height = 1.0f - 2.0f * reference::unitFloat<float>(hash.x);
        const float radius = std::sqrt(std::max(0.0f, 1.0f - height * height));
        const float turn = 2.0f * std::numbers::pi_v<float> * reference::unitFloat<float>(hash.y);
        const vec3 onSphere(radius * std::cos(turn), radius * std::sin(turn), height);
        const vec3 direction = reference::unitVector(arrival.surface.geometricNormal + 0.999f * onSphere);
        rays.push_back({reference::offsetRayOrigin(arrival.surface, direction), unbounded, direction,
                        arrival.primitive});
    }
    return rays;
}

bool isSame(const layout::HitRecord &a, const layout::HitRecord &b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

} // namespace

const char *nameOf(RayKind kind) {
    switch (kind) {
    case RayKind::Primary:
        return "primary";
    case RayKind::Shadow:
        return "shadow";
    case RayKind::Bounce:
        break;
    }
    return "bounce";
}

RaySet makeRays(const PackedScene &scene, RayKind kind) {
    RaySet set;
    if (kind == RayKind::Primary)
        set.rays = primaryRays(scene, glm::vec2(0.5f));
    else
        set.rays = kind == RayKind::Shadow ? shadowRays(scene) : bounceRays(scene);
    set.goal = kind == RayKind::Shadow ? gpu::RayGoal::AnyHit : gpu::RayGoal::NearestHit;
    // Embree is faster if this is left unsaid of shadow rays, except on the smallest mesh.
    set.isCoherent = kind == RayKind::Primary;
    set.hits.resize(set.rays.size());
    traceByReference(scene, set.goal, set.rays, set.hits);
    return set;
}

void traceByReference(const PackedScene &scene, gpu::RayGoal goal, std::span<const layout::RayRecord> rays,
                      std::span<layout::HitRecord> hits) {
    inChunks(rays.size(), raysAtOnce, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const reference::Ray<float> ray{rays[i].origin, rays[i].direction, rays[i].excluded};
            hits[i] = {layout::noPrimitive, 0.0f, 0.0f, 0.0f};
            if (goal == gpu::RayGoal::AnyHit) {
                if (reference::castShadowRay(scene, ray, rays[i].maxDistance).isBlocked)
                    hits[i].primitive = layout::hitAnything;
                continue;
            }
            const reference::Hit<float> hit = reference::closestHit(scene, ray);
            if (hit.primitive != layout::noPrimitive)
                hits[i] = {hit.primitive, hit.distance, hit.u, hit.v};
        }
    });
}

std::size_t countDifferences(std::span<const layout::HitRecord> a, std::span<const layout::HitRecord> b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += isSame(a[i], b[i]) ? 0u : 1u;
    return count;
}

std::size_t countDisagreements(gpu::RayGoal goal, std::span<const layout::HitRecord> ours,
                               std::span<const layout::HitRecord> theirs) {
    constexpr float tolerance = 1e-4f; // of the distance
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool isOurs = ours[i].primitive != layout::noPrimitive;
        const bool isTheirs = theirs[i].primitive != layout::noPrimitive;
        const bool isNear =
            goal == gpu::RayGoal::AnyHit || !isOurs ||
            std::abs(ours[i].distance - theirs[i].distance) <= tolerance * (1.0f + ours[i].distance);
        count += isOurs == isTheirs && isNear ? 0u : 1u;
    }
    return count;
}

} // namespace hyalite::core::bench
