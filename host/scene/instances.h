// Instances of meshes: their order among all triangles, and how they are flattened.
#pragma once

#include "host/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hyalite::core {

/// Input indices of triangles: they count up over meshes and instances in the order of the input, as if each instance
/// were a mesh.
struct InputOrder {
    std::vector<std::uint32_t> meshes;    ///< of each mesh, the index of its first triangle
    std::vector<std::uint32_t> instances; ///< of each instance
    std::uint64_t triangleCount = 0;      ///< of all
};

/// Indices wrap around where `triangleCount` exceeds 2^32, which validateScene does not allow.
[[nodiscard]] InputOrder inputOrder(const Scene &scene);

/// Of the map without its offset; negative where it mirrors.
[[nodiscard]] double determinant(const Placement &placement);
[[nodiscard]] inline bool isMirroring(const Placement &placement) { return determinant(placement) < 0.0; }

/// The point in world space. As shaders/geometry/instance.glsl places it.
[[nodiscard]] glm::vec3 placedPoint(const Placement &placement, const glm::vec3 &point);

/// The unit normal in world space, or 0 for a normal of 0. As shaders/geometry/instance.glsl places it.
[[nodiscard]] glm::vec3 placedNormal(const Placement &placement, const glm::vec3 &normal);

/// The tangent in world space, of any length; w stays. As shaders/geometry/instance.glsl places it.
[[nodiscard]] glm::vec4 placedTangent(const Placement &placement, const glm::vec4 &tangent);

/// The mesh for mirroring instances: other winding, negative normals, and tangents with the other side. So its places
/// have the winding and the normals of a mesh that is seen from outside.
[[nodiscard]] TriangleMesh mirrored(TriangleMesh mesh);

/// Makes the mesh a prototype, and a mirrored one if some maps mirror, with an instance at each placement. They come
/// after all meshes and instances that the scene has. `nodes` are those of the placements, or none.
void addInstances(Scene &scene, TriangleMesh mesh, std::span<const Placement> placements,
                  std::span<const std::uint32_t> nodes = {});

/// Bound on each coordinate of a point of a mesh whose coordinates are at most `size`, while it is placed.
[[nodiscard]] glm::dvec3 placedExtent(const Placement &placement, const glm::dvec3 &size);

/// The instances that become meshes.
enum class Flattening {
    All,
    /// Lights; those whose prototype has one instance; and those whose maps nearly make everything flat, for which bounds
    /// on rounding are not proven.
    Needed,
    /// These, and of the others as many as there is memory for: rays are faster in one tree. Those with the fewest
    /// triangles more come first.
    Fitting
};

/// Triangles that a scene has at most after Flattening::Fitting: those that take no longer to build than they spare.
inline constexpr std::uint64_t fittingTriangles = 4'000'000;

/// What became of the instances.
struct Arrangement {
    std::size_t instanceCount = 0;  ///< before
    std::size_t prototypeCount = 0; ///< that they use
    std::size_t flattenedCount = 0; ///< that became meshes

    bool operator==(const Arrangement &) const = default;
};

/// Replaces instances by meshes in their place of the order, and drops prototypes that are not used any more. No pixel
/// changes. The scene is valid. Throws Error{LimitExceeded} if the meshes are too large.
Arrangement arrangeInstances(Scene &scene, Flattening flattening);

/// The same for the instances, by their indices, that `becomesMesh` names.
void flattenInstances(Scene &scene, const std::function<bool(std::size_t)> &becomesMesh);

} // namespace hyalite::core
