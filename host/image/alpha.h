// Alpha: the opacity of pixels, beside their colours.
//
// Linear colours are premultiplied (associated): what a pixel adds to a background b that it leaves (1 - alpha) b of, as
// OpenEXR has them. Such a picture by itself is its composite over black. Display-encoded colours are straight, as PNG
// has them: those of an opaque pixel. T. Porter and T. Duff, "Compositing Digital Images" (SIGGRAPH 1984).
#pragma once

#include "host/image/image.h"
#include "host/image/mask.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// An image with its alpha, in [0, 1] unless its file has others. Empty: it is opaque.
struct AlphaImage {
    Image image;
    std::vector<float> alpha;
};

/// Level of alpha in 8 bits, rounded to nearest. NaN is 0.
[[nodiscard]] std::uint8_t alphaLevel(float alpha);

/// Straight colours of premultiplied ones; black where the level of alpha is 0.
[[nodiscard]] Image straightened(const Image &premultiplied, std::span<const float> alpha);

/// Straight display-encoded colours over black, as a viewer shows them: multiplied by alpha as they are encoded.
[[nodiscard]] Image overBlack(const Image &straight, std::span<const float> alpha);

/// R, G, B and A of each pixel, from three levels of each.
[[nodiscard]] std::vector<std::uint8_t> withAlphaLevels(std::span<const std::uint8_t> rgb,
                                                        std::span<const float> alpha);

/// The differences of alpha over the compared pixels. One whose bits differ and that is not finite differs infinitely.
struct AlphaMetrics {
    bool hasReference = false; ///< whether the image has alpha; one without is opaque
    bool hasTest = false;
    std::uint64_t differingPixelCount = 0; ///< with any bit different
    double maxAbsoluteDifference = 0.0;
    double meanAbsoluteDifference = 0.0;
    std::size_t worstIndex = 0; ///< the first pixel with the largest difference, row by row

    [[nodiscard]] bool identical() const { return differingPixelCount == 0; }
};

/// Compares the alpha of images of `pixelCount` pixels, of which the mask leaves one. Empty spans are opaque.
[[nodiscard]] AlphaMetrics compareAlpha(std::span<const float> reference, std::span<const float> test,
                                        std::size_t pixelCount, const Mask &mask = {});

} // namespace hyalite::core
