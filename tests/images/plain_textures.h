// Materials of the plain path tracer where a path meets them: numbers of the scene, times what textures say there.
#pragma once

#include "tests/images/plain_geometry.h"

namespace hyalite::core::testing::plain {

/// A material at one point.
struct Substance {
    const Material *material = nullptr;
    Vec colour{0.0};   ///< albedo, or base colour
    Vec emission{0.0}; ///< radiance
    double roughness = 0.0;
    double metallic = 0.0;
    Vec averageReflectance{0.0}; ///< Conductor: of light from all around
};

/// All materials of a scene, which outlives it.
class Substances {
  public:
    explicit Substances(const Scene &scene);

    [[nodiscard]] Substance at(std::uint32_t materialIndex, const Vec2 &uv) const;

    /// The probability with which the shape is there for a ray at this point, by its opacity.
    [[nodiscard]] double presence(std::uint32_t materialIndex, const Vec2 &uv) const;

    /// Turns the point's shading normal by the normal map of its material. `direction` is that of the ray that meets
    /// it.
    void bendNormal(std::uint32_t materialIndex, const Vec &direction, SurfacePoint &point) const;

  private:
    [[nodiscard]] Vec lookUp(const TextureUse &use, std::uint32_t slot, const Vec2 &uv) const;

    const Scene &scene_;
    std::vector<Vec> averageReflectances_; ///< of each material
};

} // namespace hyalite::core::testing::plain
