// Default framing of a bare mesh: a camera that shows all of it, and two lights.
#pragma once

#include "host/scene/scene.h"

#include <limits>

namespace hyalite::core {

/// The box of all corners of all triangles. Throws Error{BadInput} where a mesh names none, or where the box is
/// too small or too large to be framed (limits.h: framedExtent).
struct Bounds {
    glm::dvec3 low;
    glm::dvec3 high;

    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * low + 0.5 * high; }
};
/// Of nothing.
inline constexpr Bounds noBounds{glm::dvec3(std::numeric_limits<double>::infinity()),
                                 glm::dvec3(-std::numeric_limits<double>::infinity())};

/// Throws Error{BadInput} for a box that is empty, too small or too large to be framed; `name` is for the message.
void requireFramed(const Bounds &bounds, const std::string &name);

[[nodiscard]] Bounds triangleBounds(const TriangleMesh &mesh);

/// The same of all meshes and instances of the scene; `name` is the scene's, for the message.
[[nodiscard]] Bounds triangleBounds(const Scene &scene, const std::string &name);

/// A direction from an object to an eye around it.
struct ViewDirection {
    double azimuthDegrees = 0.0;   ///< from the front to the right
    double elevationDegrees = 0.0; ///< above the horizon; in [-90, 90]
};
inline constexpr ViewDirection defaultView{35.0, 20.0};
inline constexpr double defaultFovDegrees = 40.0; ///< of frameMesh()

/// The unit vector to the eye, for an up of +y.
[[nodiscard]] glm::dvec3 directionOf(const ViewDirection &view);

/// The camera in front of the box, to the right and slightly above, or in another direction, as near as it may come:
/// the projected box leaves a small margin at each edge of an image of width x height pixels (>= 1), whatever the
/// aspect. The field of view is in (0, 180). From right above or below, the image's right side is that of the front.
///
///            +y
///             |   . camera, 20 degrees up, 35 degrees from +z towards +x
///             |  /
///             | /
///             +------ +x
///            /
///          +z
///
/// `up` is a unit vector; +y in the drawing. Another one turns all of it the short way: +z instead of +y looks from
/// the side of -y, as programs do whose +z is up.
[[nodiscard]] Camera frameCamera(const Bounds &bounds, int width, int height, double horizontalFovDegrees,
                                 const glm::dvec3 &up = {0.0, 1.0, 0.0},
                                 const ViewDirection &from = defaultView);

/// The horizontal field of view of an image of width x height pixels whose vertical one this is.
[[nodiscard]] double horizontalFovDegrees(double verticalFovDegrees, int width, int height);

/// The lights of frameMesh() for an eye elsewhere: they follow its direction around `up`.
[[nodiscard]] std::vector<Light> frameLights(const Bounds &bounds, const glm::dvec3 &up,
                                             const glm::dvec3 &eye);

/// The same lights, seen from a camera that looks at the centre of the box as frameMesh()'s camera sees them.
[[nodiscard]] std::vector<Light> frameLights(const Bounds &bounds, const Camera &camera);

/// The radiance behind a framed mesh.
inline constexpr glm::vec3 frameBackground{0.05f};

/// The material of triangles without one: of albedo 0.8, or 1 where the mesh has colours, which then are seen
/// as they are.
[[nodiscard]] Material neutralMaterial(bool hasColours);

/// A scene of the mesh alone: two-sided, of the neutral material, before dark grey, seen by frameCamera at the default
/// size and 40 degrees. A key light from the upper left and a weaker fill light from near the camera: what
/// faces one of them has a radiance near 0.7 or 0.2, whatever the size of the mesh. Its origin becomes that of the
/// scene.
[[nodiscard]] Scene frameMesh(TriangleMesh mesh);

} // namespace hyalite::core
