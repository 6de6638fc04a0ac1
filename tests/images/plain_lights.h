// Lights of the plain path tracer: lights without size, the image or the background around, and points of emitters.
#pragma once

#include "tests/images/plain_textures.h"

#include <vector>

namespace hyalite::core::testing::plain {

/// What a light without size sends to a point.
struct Arrival {
    Vec direction;   ///< towards the light
    double distance; ///< infinity for a directional light
    Vec irradiance;  ///< of a surface that faces it
};

[[nodiscard]] Arrival arrivalFrom(const Scene &scene, const Light &light, const Vec &position);

/// Radiance that comes from infinitely far away in this direction, which leads there.
[[nodiscard]] Vec surroundings(const Scene &scene, const Vec &direction);

/// Shapes that emit, and where each ends on a line as long as all of them are large.
class Emitters {
  public:
    Emitters(const Scene &scene, const std::vector<Shape> &shapes);

    struct Choice {
        const Shape *shape;
        Vec position;
    };
    /// A point uniformly distributed over the area of all of them, of which there is one at least.
    [[nodiscard]] Choice choose(Generator &generator) const;

    [[nodiscard]] double area() const { return ends_.empty() ? 0.0 : ends_.back(); }

  private:
    std::vector<const Shape *> shapes_;
    std::vector<double> ends_;
};

} // namespace hyalite::core::testing::plain
