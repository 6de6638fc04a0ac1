// Mask: the pixels of a comparison.
#pragma once

#include "host/image/image.h"

#include <cstdint>
#include <vector>

namespace hyalite::core {

/// Non-zero for each pixel that is compared, row by row from the top left. Empty: every pixel is.
using Mask = std::vector<std::uint8_t>;

[[nodiscard]] inline bool isCompared(const Mask &mask, std::size_t pixelIndex) {
    return mask.empty() || mask[pixelIndex] != 0;
}

/// A pixel is compared where the largest of its channels is at least a half: white on black.
[[nodiscard]] inline Mask maskFromImage(const Image &image) {
    Mask mask;
    mask.reserve(image.pixels().size());
    for (const glm::vec3 &pixel : image.pixels())
        mask.push_back(pixel.x >= 0.5f || pixel.y >= 0.5f || pixel.z >= 0.5f ? 1 : 0);
    return mask;
}

} // namespace hyalite::core
