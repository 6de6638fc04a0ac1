// A noisy picture, as the denoiser reads it.
#pragma once

#include "shaders/layout/denoiser_records.h"

#include <vector>

namespace hyalite::core {

/// Row by row from the top left.
struct NoisyPicture {
    int width = 0;
    int height = 0;
    std::vector<layout::NoisyPixel> pixels{};
};

} // namespace hyalite::core
