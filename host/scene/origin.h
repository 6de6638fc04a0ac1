// The origin of a scene: what is small and far away is moved near zero before its coordinates become float.
//
// A float at the distance d from zero has steps of up to 2^-23 d. Beyond 2^10 times the extent of a scene they exceed
// 2^-13 of it, half a pixel of a picture 4,096 wide that shows all of it: what is round gets terraces. Such scenes, of
// geodesy mostly, are read relative to an origin near them; nearer ones, relative to zero, with the bits that their
// file has. The origin depends on triangles and spheres alone. Readers, options and messages speak in the file's
// coordinates, which are those of the scene + Scene::origin.
#pragma once

#include "host/scene/camera_path.h"
#include "host/scene/framing.h"
#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace hyalite::core {

/// Extents from zero, each the largest of a coordinate, beyond which the nearest point of a far box is.
inline constexpr double farExtents = 1024.0;

/// Zero, or for a far box a point near its centre: in each coordinate the nearest to it among the multiples of a power
/// of ten and of a power of two, each the next one above twice the extent. So the numbers of a file lose the digits
/// that they share, and differences are exact.
[[nodiscard]] glm::dvec3 originOf(const Bounds &bounds);

/// Finds the origin of points that are added one by one.
class OriginFinder {
  public:
    /// Returns whether the points so far are far: once they are not, no further ones can make them so.
    bool add(const glm::dvec3 &point);
    /// Adds the corners of a box under a map.
    bool addBox(const Bounds &box, const glm::dmat4x3 &map);
    [[nodiscard]] bool isEmpty() const { return !(bounds_.low.x <= bounds_.high.x); }
    /// Zero without any points.
    [[nodiscard]] glm::dvec3 origin() const;

  private:
    Bounds bounds_ = noBounds;
};

/// The origin of a mesh alone: of its triangles, or of all positions if no triangle is left.
[[nodiscard]] glm::dvec3 originOf(const TriangleMesh &mesh);

/// Reads a mesh by read(origin), positions relative to `origin`: relative to zero and, if it turns out to be far, once
/// more.
template <class Read> [[nodiscard]] auto readNear(const Read &read) {
    auto loaded = read(glm::dvec3(0.0));
    // Before the second one takes memory.
    if (const glm::dvec3 origin = originOf(loaded.mesh); origin != glm::dvec3(0.0)) {
        loaded = {};
        loaded = read(origin);
    }
    return loaded;
}

/// Gives the scene its origin, unless it has one, and its meshes the same: moves meshes, instances, spheres, lights,
/// the camera and its path. `known` is the origin of a scene that moves by time; empty: that of what is there.
void moveNear(Scene &scene, CameraPath &path, const std::optional<glm::dvec3> &known = {});

} // namespace hyalite::core
