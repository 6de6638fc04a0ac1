// A noisy picture, as the denoiser reads it, and its tiles.
#pragma once

#include "host/image/image.h"
#include "shaders/layout/denoiser_records.h"

#include <functional>
#include <vector>

namespace hyalite::core {

/// Row by row from the top left.
struct NoisyPicture {
    int width = 0;
    int height = 0;
    std::vector<layout::NoisyPixel> pixels{};
};

/// Side of a tile's own pixels where a renderer does not say otherwise.
inline constexpr int denoiserTileSide = 85 * layout::tileAlignment;

/// The picture without noise, by tiles with the pixels around them that decide theirs, which `denoiseTile` gets: with
/// colours of a mean luminance between 1/2 and 1, and no number that is tiny, huge or NaN. It returns the colours of all
/// pixels of the tile. Pixels whose own colour is out of range stay as they are. Tiles have `side` own pixels along a
/// side, or the next smaller multiple of layout::tileAlignment, and that at least; the result does not depend on it.
[[nodiscard]] Image
denoisedByTiles(const NoisyPicture &picture, int side,
                const std::function<std::vector<glm::vec3>(const NoisyPicture &tile)> &denoiseTile);

} // namespace hyalite::core
