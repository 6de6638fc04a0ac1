#include "host/gpu/unfinished_blocks.h"

#include <algorithm>

namespace hyalite::core::gpu {

namespace {

std::uint32_t blocksFor(std::uint32_t pixels) { return (pixels + Tile::blockSide - 1) / Tile::blockSide; }

} // namespace

UnfinishedBlocks::UnfinishedBlocks(std::span<const layout::FilmPixel> film, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t sampleEnd)
    : columns_(blocksFor(width)), rows_(blocksFor(height)), sums_((std::size_t{columns_} + 1) * (rows_ + 1)) {
    std::vector<std::uint8_t> isUnfinished(std::size_t{columns_} * rows_, film.empty() ? 1 : 0);
    for (std::size_t i = 0; i < film.size(); ++i)
        if (film[i].sampleCount < sampleEnd)
            isUnfinished[i / width / Tile::blockSide * columns_ + i % width / Tile::blockSide] = 1;
    for (std::size_t row = 1; row <= rows_; ++row)
        for (std::size_t column = 1; column <= columns_; ++column) {
            const std::size_t here = row * (columns_ + 1) + column;
            const std::size_t above = here - (columns_ + 1);
            sums_[here] = sums_[here - 1] + sums_[above] - sums_[above - 1] +
                          isUnfinished[(row - 1) * columns_ + column - 1];
        }
}

UnfinishedBlocks::Count UnfinishedBlocks::in(const Tile &tile) const {
    const std::uint32_t x0 = std::min(tile.x / Tile::blockSide, columns_);
    const std::uint32_t y0 = std::min(tile.y / Tile::blockSide, rows_);
    const std::uint32_t x1 = std::min(blocksFor(tile.x + tile.width), columns_);
    const std::uint32_t y1 = std::min(blocksFor(tile.y + tile.height), rows_);
    return {before(x1, y1) - before(x0, y1) - before(x1, y0) + before(x0, y0),
            std::uint64_t{x1 - x0} * (y1 - y0)};
}

} // namespace hyalite::core::gpu
