#include "host/lab/tree_check.h"

#include "host/reference/closest_hit.h"
#include "host/scene/instances.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace hyalite::core {

namespace {

/// Traces the rays. Returns the hits; `seconds` gets the time.
std::vector<reference::Hit<float>> traceRays(const PackedScene &scene, int count, double &seconds) {
    using Clock = std::chrono::steady_clock;
    std::vector<reference::Hit<float>> hits;
    const reference::SceneView<float> view(scene, layout::samplerCentre);
    hits.reserve(static_cast<std::size_t>(count));
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < count; ++i) {
        const std::uint32_t index = static_cast<std::uint32_t>(i);
        // The golden ratio's low-discrepancy sequence spreads any number of rays evenly.
        const std::uint64_t pixelCount = std::uint64_t{scene.frame.imageWidth} * scene.frame.imageHeight;
        const std::uint64_t position = (std::uint64_t{index * 2654435769u} * pixelCount) >> 32;
        const glm::uvec2 pixel(static_cast<std::uint32_t>(position % scene.frame.imageWidth),
                               static_cast<std::uint32_t>(position / scene.frame.imageWidth));
        const auto primary = reference::primaryRay(view, pixel, 0);
        hits.push_back(
            reference::closestHit(scene, reference::Ray<float>{primary.origin, primary.direction}));
    }
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return hits;
}

} // namespace

TreeCheck checkTree(const PreparedScene &prepared, int rayCount) {
    Scene flattened = prepared.loaded.scene;
    arrangeInstances(flattened, Flattening::All);
    const PackedScene brute = packScene(flattened, buildBvh(TreeKind::None, buildTriangles(flattened), 1));
    TreeCheck check;
    check.rayCount = rayCount;
    check.hasTree = prepared.bvh.depth > 0;
    const auto treeHits = traceRays(prepared.packed, rayCount, check.treeSeconds);
    const auto bruteHits = traceRays(brute, rayCount, check.bruteSeconds);
    const auto isSame = [](const reference::Hit<float> &a, const reference::Hit<float> &b) {
        return a.primitive == b.primitive && a.distance == b.distance && a.u == b.u && a.v == b.v;
    };
    for (std::size_t i = 0; i < treeHits.size(); ++i)
        check.differenceCount += isSame(treeHits[i], bruteHits[i]) ? 0u : 1u;
    return check;
}

} // namespace hyalite::core
