// The common part of LDR-FLIP and HDR-FLIP: the error map of two images in opponent colours.
#pragma once

#include "host/image/error_map.h"
#include "host/image/flip_colour.h"
#include "host/image/flip_kernels.h"
#include "host/image/image.h"

#include <vector>

namespace hyalite::core {

/// An image in opponent colours, a plane a channel. Rows are padded to a whole number of blocks.
struct OpponentPlanes {
    /// Columns that are filtered at once; the compiler makes vectors of them.
    static constexpr int blockPixels = 16;

    OpponentPlanes(int imageWidth, int imageHeight);

    /// `toLinear` maps a pixel to linear RGB in [0, 1].
    template <typename ToLinear> void fill(const Image &image, ToLinear toLinear) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::vec3 opponent = opponentFromLinear(toLinear(image.at(x, y)));
                const std::size_t index = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
                achromatic[index] = opponent.x;
                redGreen[index] = opponent.y;
                blueYellow[index] = opponent.z;
            }
        }
    }

    int width = 0;
    int height = 0;
    std::size_t stride = 0;
    std::vector<float> achromatic;
    std::vector<float> redGreen;
    std::vector<float> blueYellow;
};

/// Images of one size.
[[nodiscard]] ErrorMap flipOfOpponents(const OpponentPlanes &reference, const OpponentPlanes &test,
                                       const FlipKernels &kernels);

} // namespace hyalite::core
