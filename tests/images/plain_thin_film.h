// Iridescent films for the plain path tracer: Airy's formula, wave by wave.
#pragma once

#include "tests/images/plain_geometry.h"

#include <array>
#include <cstddef>

namespace hyalite::core::testing::plain {

/// Airy's formula: the share of light that a film without absorption reflects together with what lies below, of one
/// wavelength; `upper` and `lower` are the reflectances of its two sides, and `behind` is by how many waves the light
/// is behind that has gone down and up once. isDense: what lies below has the larger refractive index, and turns the
/// phase. Born and Wolf, "Principles of Optics", section 7.6.
[[nodiscard]] double airyReflectance(double upper, double lower, double behind, bool isDense);

/// A film on what reflects `bare` at normal incidence without it, each channel as Schlick's curve. Reflectances are
/// means over the spectrum, by the matching functions that Belcour and Barla 2017 fitted, and relative to white.
class ThinFilm {
  public:
    /// The refractive index of what lies below may be less than that of air: where `isLight`.
    ThinFilm(double index, double thickness, const Vec &bare, bool isLight = false);

    /// At this cosine of the angle of incidence outside: interpolated between quadratures at 513 cosines.
    [[nodiscard]] Vec at(double cosine) const;

    /// By quadrature.
    [[nodiscard]] Vec reflectance(double cosine) const;

    /// Its largest channel: what is kept from what lies below.
    [[nodiscard]] double loss(double cosine) const;

    /// The average over the hemisphere, weighted by the cosine.
    [[nodiscard]] Vec average() const;

    /// What facets that reflect loss() reflect at once of light from one direction. Between quadratures at 65 cosines
    /// it is linear.
    [[nodiscard]] double energy(double cosine, double roughness) const;

  private:
    double index_;
    double thickness_;
    std::array<double, 3> amplitudes_{}; ///< of the lower side at normal incidence
    std::array<Vec, 513> table_{};
};

/// Films are made once.
[[nodiscard]] const ThinFilm &thinFilmOf(double index, double thickness, const Vec &bare,
                                         bool isLight = false);

} // namespace hyalite::core::testing::plain
