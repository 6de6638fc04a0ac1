// Tone mapping: from linear radiance to the 8-bit values of a picture file.
#pragma once

#include "host/image/image.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

/// Tone curves.
enum class ToneCurve {
    Gamma, ///< c^(1/2.2), clipped: the default
    Srgb,  ///< IEC 61966-2-1, clipped: the inverse of a screen
    Aces,  ///< filmic: contrast, a shoulder, bright colours go to white; see tone_curve.h
    Agx,   ///< softer, and keeps hues better as they go to white; see tone_curve.h
};

/// The words of options.
inline constexpr std::array<std::pair<std::string_view, ToneCurve>, 4> toneCurveNames{
    {{"gamma", ToneCurve::Gamma},
     {"srgb", ToneCurve::Srgb},
     {"aces", ToneCurve::Aces},
     {"agx", ToneCurve::Agx}}};

/// Entry i - 1 is the smallest float c with 255 * c^(1/2.2) >= i - 1/2: the smallest that is shown as level i.
/// Ascending; i = 1..255.
[[nodiscard]] const std::array<float, 255> &toneMapThresholds();

/// 255 * clamp(c, 0, 1)^(1/2.2), rounded to nearest. NaN is shown as 0, like everything that is not positive.
[[nodiscard]] std::uint8_t encodeLevel(float linear);

/// Three bytes R, G, B a pixel, row by row from the top left: of c * 2^exposureStops, by the curve. By the default they
/// are encodeLevel() of that product, rounded to float. `exposureStops` is finite. NaN is black, and infinity white
/// where the curve does not mix channels. The same bytes on every machine.
[[nodiscard]] std::vector<std::uint8_t> toneMap(const Image &image, double exposureStops,
                                                ToneCurve curve = ToneCurve::Gamma);

/// The numbers of the image in [0, 1], as a PNG of it would have them.
[[nodiscard]] Image displayed(const Image &linear);

} // namespace hyalite::core
