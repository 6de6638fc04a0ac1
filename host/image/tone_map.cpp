#include "host/image/tone_map.h"

#include "host/base/portable_math.h"
#include "host/image/tone_curve.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hyalite::core {

namespace {

float roundUpToFloat(double x) {
    const float nearest = static_cast<float>(x);
    return static_cast<double>(nearest) >= x
               ? nearest
               : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

} // namespace

// pow() has an error of about an ulp and differs between C libraries. None of the 255 thresholds is close enough to a
// rounding boundary for this error, a billionth of the step between floats, to change it. So the table is the same
// everywhere, and so are levels found by comparison with it; pow() per pixel would not be.
const std::array<float, 255> &toneMapThresholds() {
    static const std::array<float, 255> thresholds = [] {
        std::array<float, 255> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = roundUpToFloat(std::pow((static_cast<double>(i) + 0.5) / 255.0, 2.2));
        return table;
    }();
    return thresholds;
}

namespace {

/// Looks up levels without a search: [2^-20, 1) is cut into 32 pieces per power of two, and each piece contains few
/// thresholds.
class LevelFinder {
  public:
    LevelFinder() : thresholds_(toneMapThresholds()) {
        assert(thresholds_.front() > std::bit_cast<float>(firstPiece << pieceShift));
        for (std::uint32_t piece = 0; piece < pieceCount; ++piece) {
            const float low = std::bit_cast<float>((firstPiece + piece) << pieceShift);
            levels_[piece] = static_cast<std::uint8_t>(
                std::upper_bound(thresholds_.begin(), thresholds_.end(), low) - thresholds_.begin());
        }
    }

    /// `linear` is in [0, infinity].
    [[nodiscard]] std::uint8_t levelOf(float linear) const {
        const std::uint32_t piece = (std::bit_cast<std::uint32_t>(linear) >> pieceShift) - firstPiece;
        if (piece >= pieceCount)
            return linear < 1.0f ? 0 : 255;
        std::size_t level = levels_[piece];
        while (level < thresholds_.size() && linear >= thresholds_[level])
            ++level;
        return static_cast<std::uint8_t>(level);
    }

  private:
    static constexpr std::uint32_t pieceShift = 18; ///< keeps the exponent and five of the 23 mantissa bits
    static constexpr std::uint32_t firstPiece = std::bit_cast<std::uint32_t>(0x1p-20f) >> pieceShift;
    static constexpr std::uint32_t pieceCount =
        (std::bit_cast<std::uint32_t>(1.0f) >> pieceShift) - firstPiece;

    const std::array<float, 255> &thresholds_;
    std::array<std::uint8_t, pieceCount> levels_{}; ///< at the lower end of each piece
};

const LevelFinder &levelFinder() {
    static const LevelFinder finder;
    return finder;
}

} // namespace

std::uint8_t encodeLevel(float linear) {
    return linear > 0.0f ? levelFinder().levelOf(linear) : 0; // NaN is 0, too
}

namespace {

/// Exposed radiance, bounded to the range of float; everything from 1 on is white. NaN is black.
float exposed(float linear, double scale) {
    const double product = static_cast<double>(linear) * scale;
    return product >= 1.0 ? 1.0f : product > 0.0 ? static_cast<float>(product) : 0.0f;
}

std::uint8_t levelOf(double display) {
    return static_cast<std::uint8_t>(std::clamp(display, 0.0, 1.0) * 255.0 + 0.5);
}

} // namespace

std::vector<std::uint8_t> toneMap(const Image &image, double exposureStops, ToneCurve curve) {
    assert(std::isfinite(exposureStops));
    // 2^300 makes the smallest positive float white, and 2^-300 the largest one black: stronger exposures change
    // nothing.
    const double scale = exp2Portable(std::clamp(exposureStops, -300.0, 300.0));
    const LevelFinder &finder = levelFinder();
    std::vector<std::uint8_t> bytes(image.pixels().size() * 3);
    std::uint8_t *next = bytes.data();
    for (const glm::vec3 &pixel : image.pixels()) {
        if (curve == ToneCurve::Gamma) {
            for (int channel = 0; channel < 3; ++channel)
                *next++ = finder.levelOf(exposed(pixel[channel], scale));
            continue;
        }
        const glm::dvec3 display = displayed(glm::dvec3(pixel) * scale, curve);
        for (int channel = 0; channel < 3; ++channel)
            *next++ = levelOf(display[channel]);
    }
    return bytes;
}

Image displayed(const Image &linear) {
    Image image(linear.width(), linear.height());
    const std::vector<std::uint8_t> levels = toneMap(linear, 0.0);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        image.pixels()[i] = glm::vec3(levels[3 * i], levels[3 * i + 1], levels[3 * i + 2]) / 255.0f;
    return image;
}

} // namespace hyalite::core
