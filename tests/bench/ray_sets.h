// The rays that are traced, and their true hits by the reference.
#pragma once

#include "host/gpu/ray_tracer.h"
#include "host/packing/packed_scene.h"

#include <vector>

namespace hyalite::core::bench {

enum class RayKind {
    Primary, ///< through all pixels' centres of the image; 8 neighbours in the array cover 4x2 pixels, 64 cover 8x8
    Shadow, ///< from what these hit to the first light, where that is lit
    Bounce, ///< from what these hit, cosine-distributed around the normal
};

constexpr RayKind rayKinds[] = {RayKind::Primary, RayKind::Shadow, RayKind::Bounce};

[[nodiscard]] const char *nameOf(RayKind kind);

struct RaySet {
    gpu::RayGoal goal = gpu::RayGoal::NearestHit; ///< any hit for shadow rays
    bool isCoherent = true;                       ///< neighbours go the same way: primary rays
    std::vector<layout::RayRecord> rays;
    std::vector<layout::HitRecord> hits; ///< of the reference
};

/// `scene` has triangles and a light, and an image of whole blocks of 8x8 pixels.
[[nodiscard]] RaySet makeRays(const PackedScene &scene, RayKind kind);

/// Follows the rays with the reference renderer's traversal, on all threads. There is room for as many hits.
void traceByReference(const PackedScene &scene, gpu::RayGoal goal, std::span<const layout::RayRecord> rays,
                      std::span<layout::HitRecord> hits);

/// How many hits differ in any bit.
[[nodiscard]] std::size_t countDifferences(std::span<const layout::HitRecord> a,
                                           std::span<const layout::HitRecord> b);

/// How many rays hit something in one case only, or at distances that rounding does not explain.
[[nodiscard]] std::size_t countDisagreements(gpu::RayGoal goal, std::span<const layout::HitRecord> ours,
                                             std::span<const layout::HitRecord> theirs);

} // namespace hyalite::core::bench
