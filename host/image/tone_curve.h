// Tone curves in double precision, made of + - * / and host/base/portable_math.h: the same bytes on every machine.
#pragma once

#include "host/image/tone_map.h"

#include <glm/vec3.hpp>

#include <array>

namespace hyalite::core {

/// The transfer function of IEC 61966-2-1, from linear light in [0, 1] to the display encoding.
[[nodiscard]] double srgbEncoded(double linear);
/// Its inverse, from [0, 1] to linear light; by pow(), for tables of floats.
[[nodiscard]] double srgbDecoded(double encoded);
/// The same of the 8-bit levels 0 to 255.
[[nodiscard]] const std::array<float, 256> &srgbDecodedLevels();

/// The display encoding, in [0, 1], of exposed radiance. Negative values and NaN count as 0; larger values than 2^60 as
/// 2^60.
///
/// Gamma and Srgb take each channel by itself. The other two mix channels, so that bright colours lose saturation as
/// film does, rather than clip to primaries:
///
/// Aces: S. Hill's fit of the ACES reference rendering and sRGB output transforms, as published in M. Pettineo's Baking
/// Lab (2016, ACES.hlsl), without the exposure that this program adds; 0.18 is shown as 0.106. Then srgbEncoded().
///
/// Agx: B. Wrensch's "Minimal AgX Implementation" (2023, iolite-engine.com), of T. Sobotka's AgX as in Blender: the
/// base look, with the contrast as a polynomial of degree six over log2 in [-12.47393, 4.026069].
[[nodiscard]] glm::dvec3 displayed(const glm::dvec3 &radiance, ToneCurve curve);

} // namespace hyalite::core
