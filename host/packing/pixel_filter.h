// The pixel filter as a table of quantiles, for importance sampling.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite::core {

/// Radius of the filter, in pixels.
inline constexpr double filterRadius = 1.5;

/// Integral of the filter below `x`, in pixels from its centre: 0 up to -filterRadius, 1 from filterRadius on. The
/// filter is the four-term Blackman-Harris window: F. J. Harris, "On the Use of Windows for Harmonic Analysis with the
/// Discrete Fourier Transform", Proc. IEEE 66(1), 1978, table 1.
[[nodiscard]] double filterShareBelow(double x);

/// Appends the quantiles of the Blackman-Harris filter to packed.lookups, and their position to packed.frame.
void packFilter(PackedScene &packed);

} // namespace hyalite::core
