// The blocks of a film that want more samples: renders of parts, and of films that others have begun, leave most alone.
#pragma once

#include "host/gpu/tile.h"
#include "shaders/layout/layout.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// Counts blocks of 8x8 pixels, by a table of sums (F. Crow, "Summed-Area Tables for Texture Mapping", 1984).
class UnfinishedBlocks {
  public:
    /// A film of width x height pixels, row by row, at the start of a render up to `sampleEnd` samples. Without pixels
    /// all blocks are unfinished.
    UnfinishedBlocks(std::span<const layout::FilmPixel> film, std::uint32_t width, std::uint32_t height,
                     std::uint32_t sampleEnd);

    struct Count {
        std::uint64_t unfinished = 0;
        std::uint64_t all = 0;
    };
    /// Of the tile's blocks that are in the film.
    [[nodiscard]] Count in(const Tile &tile) const;

  private:
    [[nodiscard]] std::uint64_t before(std::uint32_t column, std::uint32_t row) const {
        return sums_[std::size_t{row} * (columns_ + 1) + column];
    }

    std::uint32_t columns_;
    std::uint32_t rows_;
    std::vector<std::uint64_t> sums_; ///< of unfinished blocks above and to the left
};

} // namespace hyalite::core::gpu
