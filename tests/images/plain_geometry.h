// Geometry of the plain path tracer: triangles and spheres in double precision, tested one after another without a
// tree.
#pragma once

#include "host/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace hyalite::core::testing::plain {

using Vec = glm::dvec3;
using Vec2 = glm::dvec2;
using Generator = std::mt19937_64;

[[nodiscard]] inline double uniform(Generator &generator) {
    return std::uniform_real_distribution<double>()(generator);
}

/// A triangle or a sphere of the scene.
struct Shape {
    std::uint32_t materialIndex = 0;
    bool isSphere = false;
    std::array<Vec, 3> corners{}; ///< Triangle
    std::array<Vec, 3> normals{}; ///< Triangle: at its corners, where it is smooth
    std::array<Vec2, 3> uvs{};    ///< Triangle: texture coordinates of its corners
    bool isSmooth = false;        ///< Triangle: it has normals
    Vec centre{0.0};              ///< Sphere
    double radius = 0.0;          ///< Sphere
    bool isInward = false;        ///< Sphere: its normal points to its centre
    bool isAlphaTested = false;   ///< its material is not there for every ray
    bool isCulled = false;        ///< Triangle: it is not there for rays from behind

    [[nodiscard]] double area() const;

    /// A point uniformly distributed over its area.
    [[nodiscard]] Vec randomPoint(Generator &generator) const;
};

/// Where a ray hits a shape.
struct Hit {
    const Shape *shape = nullptr;
    double distance = 0.0; ///< > 0
    Vec weights{0.0};      ///< Triangle: of its corners; they add up to 1
};

/// A point of a shape.
struct SurfacePoint {
    Vec position;
    Vec geometricNormal; ///< unit length, on the side of `normal`
    Vec normal;          ///< for shading, unit length
    Vec2 uv;             ///< texture coordinates
    Vec alongU;          ///< direction in which u grows, of any length; 0: not known
    Vec alongV;          ///< and v
};

/// All shapes of a scene, spheres first.
[[nodiscard]] std::vector<Shape> shapesOf(const Scene &scene);

/// Where a ray that leaves the shape `left` (or none) hits `shape`. `direction` is of unit length.
[[nodiscard]] std::optional<Hit> intersect(const Shape &shape, const Vec &origin, const Vec &direction,
                                           const Shape *left);

[[nodiscard]] SurfacePoint pointAt(const Hit &hit, const Vec &origin, const Vec &direction);

/// Texture coordinates alone.
[[nodiscard]] Vec2 uvOf(const Hit &hit, const Vec &position);

/// Coordinates of a direction in the frame whose z is the unit vector `normal`, and back.
class Frame {
  public:
    explicit Frame(const Vec &normal);
    [[nodiscard]] Vec toLocal(const Vec &v) const;
    [[nodiscard]] Vec toWorld(const Vec &v) const;

  private:
    Vec x_;
    Vec y_;
    Vec z_;
};

} // namespace hyalite::core::testing::plain
