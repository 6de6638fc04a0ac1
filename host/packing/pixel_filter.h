// The pixel filter as a table of quantiles, for importance sampling.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite {

/// Half of the width of the filter, in pixels.
inline constexpr double filterRadius = 1.5;

/// The share of the filter that lies below `x`, in pixels from its middle; 0 from -filterRadius, 1 from filterRadius
/// on. The Blackman-Harris window of four terms: F. J. Harris, "On the Use of Windows for Harmonic Analysis with the
/// Discrete Fourier Transform", Proc. IEEE 66(1), 1978, table 1; integrated.
[[nodiscard]] double filterShareBelow(double x);

/// Appends the filter's quantiles to packed.lookups, and says in packed.frame where.
void packFilter(PackedScene &packed);

} // namespace hyalite
