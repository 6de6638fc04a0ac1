// Textbook functions of surfaces for the plain path tracer: Fresnel's equations, the GGX distribution, Smith's masking,
// and the share of light that microfacets reflect, by quadrature.
#pragma once

#include "tests/images/plain_geometry.h"

#include <functional>

namespace hyalite::core::testing::plain {

/// Fresnel's equations for unpolarised light between two dielectrics; `indexRatio` is the refractive index on the side
/// of the light divided by the one beyond. Born and Wolf, "Principles of Optics", section 1.5.2.
[[nodiscard]] double dielectricFresnel(double cosine, double indexRatio);

/// Likewise from vacuum to the complex index n + i k: Born and Wolf, section 14.2.
[[nodiscard]] double conductorFresnel(double cosine, double n, double k);

/// Its average over the hemisphere, weighted by the cosine.
[[nodiscard]] double averageConductorFresnel(double n, double k);

/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, equation 15.
[[nodiscard]] Vec schlickFresnel(double cosine, const Vec &normalReflectance, double grazing = 1.0);

/// Roughness as an artist gives it to GGX's alpha: its square (Burley 2012, section 5.4), from 0.04 on.
[[nodiscard]] double alphaOf(double roughness);

/// Walter, Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equation
/// 33.
[[nodiscard]] double ggx(const Vec &facet, double alpha);

/// Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014, equations 72 and
/// 99: 1 / (1 + Lambda(v) + Lambda(l)), for light on either side.
[[nodiscard]] double smith(const Vec &view, const Vec &light, double alpha);

/// A facet drawn with the density ggx(facet) facet.z per solid angle: Walter 2007, equations 35 and 36.
[[nodiscard]] Vec randomFacet(double alpha, Generator &generator);

/// The sheen lobe of white fibres, times the cosine of the light: Estevez and Kulla, "Production Friendly Microfacet
/// Sheen BRDF", SIGGRAPH 2017 courses, equations 2 to 4, as KHR_materials_sheen has them, except for the least
/// roughness.
[[nodiscard]] double sheen(const Vec &view, const Vec &light, double roughness);

/// The share of light from one direction that it reflects. Between quadratures at 65 cosines it is linear.
[[nodiscard]] double sheenEnergy(double cosine, double roughness);

/// What facets reflect at once of light from one direction.
struct Energy {
    double white = 1.0;   ///< if they reflect everything
    double grazing = 0.0; ///< if they reflect (1 - cosine)^5

    /// By Schlick's Fresnel term.
    [[nodiscard]] double of(double normalReflectance, double atGrazing = 1.0) const {
        return normalReflectance * white + (atGrazing - normalReflectance) * grazing;
    }
};

/// By quadrature over facets; `cosine` in [0, 1] is that of the direction. Between quadratures at multiples of 1/128 of
/// the roughness and at 65 cosines it is linear, with an error of 2e-4, and of 2e-3 below a cosine
/// of 0.1.
[[nodiscard]] Energy directionalEnergy(double cosine, double roughness);

/// Its average over the hemisphere, weighted by the cosine.
[[nodiscard]] Energy averageEnergy(double roughness);

/// The quadrature itself, with steps * steps facets.
[[nodiscard]] Energy integrateEnergy(double cosine, double alpha, int steps);

/// Likewise, of facets that reflect `fresnel` of the cosine to the direction.
[[nodiscard]] double integrateReflected(double cosine, double alpha, int steps,
                                        const std::function<double(double)> &fresnel);

/// What facets of glass reflect and refract at once of light from one direction, both together, as power. Likewise
/// between quadratures, for every `indexRatio` that is asked for.
[[nodiscard]] double glassEnergy(double cosine, double roughness, double indexRatio);

/// The quadrature itself.
[[nodiscard]] double integrateGlassEnergy(double cosine, double alpha, double indexRatio, int steps);

} // namespace hyalite::core::testing::plain
