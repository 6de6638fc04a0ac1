// Motion vectors: how far what a pixel shows moves in the picture between the frames of a sequence.
#pragma once

#include "host/engine/prepare.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hyalite::core {

/// The triangles of a frame by the numbers of primitives, which are the same in all frames of a sequence.
class FrameSurfaces {
  public:
    explicit FrameSurfaces(PackedScene scene);

    /// The point of a triangle by the weights of its first two corners. Empty for spheres, which stay where they are, and
    /// for triangles that the frame's tree dropped.
    [[nodiscard]] std::optional<glm::dvec3> pointOf(std::uint32_t primitive, double u, double v) const;

  private:
    /// The triangle with this number among those of a tree.
    [[nodiscard]] const layout::TriangleRecord *triangleIn(std::size_t tree, std::uint32_t number) const;

    RecordVector<layout::TriangleRecord> triangles_;
    std::vector<layout::InstanceRecord> instances_;     ///< by their first primitives
    std::vector<std::vector<std::uint32_t>> recordsOf_; ///< of each tree, by the numbers of its triangles
    std::uint32_t firstTriangleId_;
};

/// Another frame of a sequence.
struct MotionFrame {
    Camera camera;
    std::shared_ptr<const FrameSurfaces> surfaces{}; ///< null: nothing but the camera moves
};

struct NeighbourFrames {
    MotionFrame before;
    MotionFrame after;
};

/// Of each pixel of the crop, row by row: x and y are where its surface was in the frame before, relative to where it
/// is; z and w are where it is, relative to where it will be in the frame after; in pixels, x to the right and y up. So
/// Cycles has them for Blender's pass Vector (intern/cycles/kernel/geom/primitive.h, primitive_motion_vector). The
/// surface is that at the pixel's centre. Vectors are 0 where nothing is met, and where the surface is behind the
/// other frame's camera.
[[nodiscard]] std::vector<glm::vec4> motionVectors(const PreparedScene &scene,
                                                   const NeighbourFrames &neighbours);

} // namespace hyalite::core
