#include "host/jobs/motion.h"

#include "host/jobs/projection.h"
#include "host/reference/first_hits.h"
#include "host/reference/scene_view.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hyalite::core {

namespace {

constexpr std::uint32_t noRecord = std::numeric_limits<std::uint32_t>::max();

/// From `from` to `to` in the picture, y up. A panorama goes around: the shorter way counts.
glm::dvec2 wayBetween(const glm::dvec2 &from, const glm::dvec2 &to, const Camera &camera) {
    glm::dvec2 way(to.x - from.x, from.y - to.y);
    if (camera.kind == CameraKind::Panorama)
        way.x = std::remainder(way.x, static_cast<double>(camera.width));
    return way;
}

/// From where the hit of this frame is in the picture to where it is in the other frame.
glm::dvec2 wayTo(const MotionFrame &other, const reference::FirstHit &hit, const glm::dvec2 &here) {
    glm::dvec3 point = hit.position;
    if (other.surfaces != nullptr)
        point = other.surfaces->pointOf(hit.primitive, hit.u, hit.v).value_or(point);
    const std::optional<glm::dvec2> there = pixelOf(other.camera, point);
    return there ? wayBetween(here, *there, other.camera) : glm::dvec2(0.0);
}

} // namespace

FrameSurfaces::FrameSurfaces(PackedScene scene)
    : triangles_(std::move(scene.triangles)), instances_(std::move(scene.instances)),
      firstTriangleId_(scene.frame.firstTriangleId) {
    std::ranges::sort(instances_, {}, &layout::InstanceRecord::firstPrimitive);
    for (std::size_t tree = 0; tree < scene.trees.size(); ++tree) {
        const std::size_t begin = scene.trees[tree].firstRecord;
        const std::size_t end =
            tree + 1 < scene.trees.size() ? scene.trees[tree + 1].firstRecord : triangles_.size();
        const std::uint32_t firstId = tree == 0 ? firstTriangleId_ : 0;
        std::vector<std::uint32_t> &records = recordsOf_.emplace_back();
        for (std::size_t record = begin; record < end; ++record) {
            const layout::TriangleRecord &triangle = triangles_[record];
            if ((triangle.flags & layout::triangleIsSphere) != 0)
                continue;
            const std::size_t number = triangle.primitiveId - firstId;
            if (number >= records.size())
                records.resize(number + 1, noRecord);
            records[number] = static_cast<std::uint32_t>(record);
        }
    }
}

const layout::TriangleRecord *FrameSurfaces::triangleIn(std::size_t tree, std::uint32_t number) const {
    const std::vector<std::uint32_t> &records = recordsOf_[tree];
    return number < records.size() && records[number] != noRecord ? &triangles_[records[number]] : nullptr;
}

std::optional<glm::dvec3> FrameSurfaces::pointOf(std::uint32_t primitive, double u, double v) const {
    if (primitive < firstTriangleId_ || recordsOf_.empty())
        return std::nullopt;
    if (const layout::TriangleRecord *mesh = triangleIn(0, primitive - firstTriangleId_))
        return reference::pointIn(*mesh, u, v);
    const auto after =
        std::ranges::upper_bound(instances_, primitive, {}, &layout::InstanceRecord::firstPrimitive);
    if (after == instances_.begin())
        return std::nullopt;
    const layout::InstanceRecord &instance = *(after - 1);
    const layout::TriangleRecord *triangle =
        triangleIn(instance.tree + 1, primitive - instance.firstPrimitive);
    if (triangle == nullptr)
        return std::nullopt;
    return reference::pointIn(leaves::placedTriangle<float>(instance, *triangle), u, v);
}

std::vector<glm::vec4> motionVectors(const PreparedScene &scene, const NeighbourFrames &neighbours) {
    const Crop &crop = scene.crop;
    std::vector<glm::vec4> vectors(crop.pixelCount(), glm::vec4(0.0f));
    const Camera &camera = scene.loaded.scene.camera;
    reference::visitFirstHits(scene.packed, crop, [&](int y, std::span<const reference::FirstHit> hits) {
        glm::vec4 *row = &vectors[crop.indexOf(crop.x0, y)];
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].primitive == layout::noPrimitive)
                continue;
            const std::optional<glm::dvec2> here = pixelOf(camera, hits[i].position);
            if (!here)
                continue;
            const glm::dvec2 before = wayTo(neighbours.before, hits[i], *here);
            const glm::dvec2 after = wayTo(neighbours.after, hits[i], *here);
            row[i] = glm::vec4(glm::dvec4(before, -after));
        }
    });
    return vectors;
}

} // namespace hyalite::core
