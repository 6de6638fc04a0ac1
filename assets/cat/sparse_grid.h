// A regular grid of field samples that keeps only the blocks which the surface may pass through.
//
//     point (i, j, k) lies at origin + (i, j, k) * spacing; cell (i, j, k) has it as its lowest corner.
//     block (i, j, k) holds the cells from 8 (i, j, k) to 8 (i, j, k) + 7, and samples at all their corners.
//
// Blocks repeat the samples on their shared faces: both get the same bits, because a point's position comes from
// its index and a field's selection does not change its value.
#pragma once

#include "assets/cat/implicit.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite::cat {

struct Box {
    Vec3 low;
    Vec3 high;
};

using GridIndex = std::array<int, 3>;

class SparseGrid {
  public:
    static constexpr int blockCells = 8;
    static constexpr int blockPoints = blockCells + 1;

    struct Block {
        GridIndex firstCell{};
        Selection selection; // valid in the block and two cells around it
        // Field values; where no surface is near only the sign counts.
        std::array<double, blockPoints * blockPoints * blockPoints> values{};
    };

    // The surface must lie inside `bounds`.
    SparseGrid(const Field &field, const Box &bounds, double spacing);

    [[nodiscard]] double spacing() const { return spacing_; }
    [[nodiscard]] const std::vector<Block> &blocks() const { return blocks_; }
    [[nodiscard]] Vec3 position(const GridIndex &point) const;
    // The block that holds a cell. The surface must pass through the cell.
    [[nodiscard]] std::uint32_t blockOf(const GridIndex &cell) const;

    // Number of edges between neighbouring points of unlike sign.
    [[nodiscard]] std::size_t crossingCount() const;

    // Index into Block::values of a point relative to the block's first.
    [[nodiscard]] static constexpr std::size_t valueIndex(int i, int j, int k) {
        return static_cast<std::size_t>((k * blockPoints + j) * blockPoints + i);
    }

  private:
    void descend(const Selection &from, const GridIndex &firstBlock, int sizeBlocks);
    void fill(Block &block, const GridIndex &first, int sizeCells);

    const Field *field_;
    Vec3 origin_;
    double spacing_;
    GridIndex blockCount_{};
    std::vector<std::int32_t> blockNumbers_; // dense; -1 where the surface cannot be
    std::vector<Block> blocks_;
};

} // namespace hyalite::cat
