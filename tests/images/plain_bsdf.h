// BSDFs of the plain path tracer: textbook lobes, added up. Evaluated as their papers write them, and sampled by the
// simplest way that follows their shape, so that any direction may be drawn by several lobes.
//
// A principled material is Burley's mixture ("Physically Based Shading at Disney", SIGGRAPH 2012 courses) of metal,
// plastic and glass under a clear coat, with four choices of this program: what facets do not reflect at once comes
// back as in Kulla and Conty ("Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses); the colour
// below a plastic surface gets what the surface does not reflect in the same way; what facets of glass do not pass on
// at once makes up for it in what they do (Turquin, "Practical Multiple Scattering Compensation for Microfacet Models",
// 2019); and the coat leaves 1 - coat E(view).
//
// A material of glTF is the specification's, with the first three of these choices, and with facets of thin glass as of
// thick. A base that lets light through has the same plastic on both sides. Of a film, the colour below gets what the
// film does not reflect of the view, and spreads it as without one.
#pragma once

#include "tests/images/plain_microfacets.h"
#include "tests/images/plain_textures.h"
#include "tests/images/plain_thin_film.h"

#include <optional>

namespace hyalite::core::testing::plain {

/// All directions are unit vectors that lead away from the point, in the frame whose z is the normal on the side of the
/// viewer: view.z > 0.
class Bsdf {
  public:
    /// The substance is diffuse, principled, or a rough conductor or dielectric. `indexRatio`, for glass, is the
    /// refractive index on the side of the viewer divided by the one beyond; isBehind: seen against the normal of the
    /// input.
    Bsdf(const Substance &substance, double indexRatio, bool isBehind);

    /// The BSDF times the absolute cosine of `light`, which is below the surface where light passes it.
    [[nodiscard]] Vec evaluate(const Vec &view, const Vec &light) const;

    /// Of what sample() returns, per solid angle.
    [[nodiscard]] double density(const Vec &view, const Vec &light) const;

    /// A direction for light; nothing where a facet sends it to the wrong side.
    [[nodiscard]] std::optional<Vec> sample(const Vec &view, Generator &generator) const;

  private:
    [[nodiscard]] Vec evaluateMetal(const Vec &view, const Vec &light) const;
    [[nodiscard]] double baseShare(const Vec &view, double lightCosine) const;
    [[nodiscard]] Vec evaluatePlastic(const Vec &view, const Vec &light) const;
    [[nodiscard]] Vec evaluateGlass(const Vec &view, const Vec &light) const;
    [[nodiscard]] Vec evaluateThin(const Vec &view, const Vec &light) const;
    [[nodiscard]] Vec glassFresnel(double cosine) const;
    [[nodiscard]] double glassLoss(double cosine) const;
    [[nodiscard]] double plasticEnergy(double cosine) const;
    [[nodiscard]] Vec underSheenAndCoat(const Vec &view, const Vec &light, const Vec &below) const;
    [[nodiscard]] double coatShare(const Vec &view) const;

    // Shares of what lies below the coat; they add up to 1.
    double diffuse_ = 0.0;
    double metal_ = 0.0;
    double plastic_ = 0.0;
    double glass_ = 0.0;
    double thin_ = 0.0; ///< light passes it straight
    double coat_ = 0.0; ///< how much of a coat is above
    bool isGltf_ = false;
    Vec sheen_{0.0};
    double sheenRoughness_ = 0.0;
    double filmShare_ = 0.0; ///< how much of the surface has a film
    const ThinFilm *metalFilm_ = nullptr;
    const ThinFilm *plasticFilm_ = nullptr;
    const ThinFilm *glassFilm_ = nullptr;
    bool isInside_ = false; ///< of glass

    bool isConductor_ = false; ///< the metal has a complex refractive index, else a colour
    Vec index_{0.0};
    Vec extinction_{0.0};
    Vec averageReflectance_{0.0}; ///< of the metal
    Vec colour_{0.0};
    Vec tint_{1.0}; ///< of what glass lets pass
    double indexRatio_ = 1.0;
    Vec plasticReflectance_{0.0}; ///< head on
    double plasticGrazing_ = 1.0;
    double diffuselyReflected_ = 1.0; ///< the base's share
    Vec diffuselyTransmitted_{0.0};   ///< the same of what leaves on the other side, with its colour
    double roughness_ = 0.0;
    double coatRoughness_ = 0.0;

    // How often each way of sampling is taken; they add up to 1.
    double cosineChance_ = 0.0;
    double facetChance_ = 0.0;
    double glassChance_ = 0.0;
    double coatChance_ = 0.0;
    double thinChance_ = 0.0;
    double oppositeChance_ = 0.0; ///< to the other side, by the cosine
};

} // namespace hyalite::core::testing::plain
