#include "host/image/alpha.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace hyalite::core {

std::uint8_t alphaLevel(float alpha) {
    return alpha > 0.0f ? static_cast<std::uint8_t>(std::lround(255.0f * std::min(alpha, 1.0f))) : 0;
}

Image straightened(const Image &premultiplied, std::span<const float> alpha) {
    assert(alpha.size() == premultiplied.pixels().size());
    Image straight = premultiplied;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        straight.pixels()[i] = alphaLevel(alpha[i]) > 0 ? straight.pixels()[i] / alpha[i] : glm::vec3(0.0f);
    return straight;
}

Image overBlack(const Image &straight, std::span<const float> alpha) {
    assert(alpha.size() == straight.pixels().size());
    Image composite = straight;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        composite.pixels()[i] *= alpha[i];
    return composite;
}

std::vector<std::uint8_t> withAlphaLevels(std::span<const std::uint8_t> rgb, std::span<const float> alpha) {
    assert(rgb.size() == 3 * alpha.size());
    std::vector<std::uint8_t> levels;
    levels.reserve(4 * alpha.size());
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        levels.insert(levels.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
        levels.push_back(alphaLevel(alpha[i]));
    }
    return levels;
}

AlphaMetrics compareAlpha(std::span<const float> reference, std::span<const float> test,
                          std::size_t pixelCount, const Mask &mask) {
    AlphaMetrics metrics;
    metrics.hasReference = !reference.empty();
    metrics.hasTest = !test.empty();
    std::uint64_t comparedCount = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < pixelCount; ++i) {
        if (!isCompared(mask, i))
            continue;
        ++comparedCount;
        const float a = reference.empty() ? 1.0f : reference[i];
        const float b = test.empty() ? 1.0f : test[i];
        if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b))
            continue;
        ++metrics.differingPixelCount;
        const double difference = std::isfinite(a) && std::isfinite(b)
                                      ? std::abs(double{a} - double{b})
                                      : std::numeric_limits<double>::infinity();
        sum += difference;
        if (difference > metrics.maxAbsoluteDifference) {
            metrics.maxAbsoluteDifference = difference;
            metrics.worstIndex = i;
        }
    }
    assert(comparedCount > 0);
    metrics.meanAbsoluteDifference = sum / static_cast<double>(comparedCount);
    return metrics;
}

} // namespace hyalite::core
