#include "assets/cat/sparse_grid.h"

#include <algorithm>
#include <cassert>

namespace hyalite::cat {
namespace {

constexpr double halfDiagonal = 0.8660254037844387; // of a unit cube, rounded up
constexpr double unsampled = 0.0;                   // a sampled zero is stored as the smallest outside value
constexpr double tinyOutside = 1e-300;
constexpr double farAway = 1e30;

} // namespace

SparseGrid::SparseGrid(const Field &field, const Box &bounds, double spacing)
    : field_(&field), spacing_(spacing) {
    // One cell of margin, so that the cells around any crossed edge exist.
    origin_ = bounds.low - Vec3{spacing, spacing, spacing};
    const Vec3 size = bounds.high - origin_;
    const std::array<double, 3> sizes{size.x, size.y, size.z};
    int largest = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        blockCount_[axis] = static_cast<int>(std::floor(sizes[axis] / (spacing * blockCells))) + 1;
        largest = std::max(largest, blockCount_[axis]);
    }
    int rootSize = 1;
    while (rootSize < largest)
        rootSize *= 2;
    const auto total = static_cast<std::size_t>(blockCount_[0]) * static_cast<std::size_t>(blockCount_[1]) *
                       static_cast<std::size_t>(blockCount_[2]);
    blockNumbers_.assign(total, -1);
    descend(field.selectAll(), {0, 0, 0}, rootSize);
}

Vec3 SparseGrid::position(const GridIndex &point) const {
    return {origin_.x + spacing_ * point[0], origin_.y + spacing_ * point[1],
            origin_.z + spacing_ * point[2]};
}

std::uint32_t SparseGrid::blockOf(const GridIndex &cell) const {
    const int i = cell[0] / blockCells;
    const int j = cell[1] / blockCells;
    const int k = cell[2] / blockCells;
    const auto flat = static_cast<std::size_t>((k * blockCount_[1] + j) * blockCount_[0] + i);
    assert(blockNumbers_[flat] >= 0);
    return static_cast<std::uint32_t>(blockNumbers_[flat]);
}

void SparseGrid::descend(const Selection &from, const GridIndex &firstBlock, int sizeBlocks) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (firstBlock[axis] >= blockCount_[axis])
            return;
    const double halfCells = 0.5 * blockCells * sizeBlocks;
    const Vec3 centre =
        position({firstBlock[0] * blockCells, firstBlock[1] * blockCells, firstBlock[2] * blockCells}) +
        Vec3{spacing_, spacing_, spacing_} * halfCells;
    const double radius = halfDiagonal * 2.0 * halfCells * spacing_;
    if (std::abs(field_->value(from, centre)) > radius * 1.000001)
        return;
    // Vertices may slide a little outside their block.
    const double margin = halfDiagonal * 4.0 * spacing_;
    Selection selection = field_->select(from, {centre, radius + margin});
    if (sizeBlocks > 1) {
        const int half = sizeBlocks / 2;
        for (int child = 0; child < 8; ++child)
            descend(selection,
                    {firstBlock[0] + (child & 1) * half, firstBlock[1] + ((child >> 1) & 1) * half,
                     firstBlock[2] + ((child >> 2) & 1) * half},
                    half);
        return;
    }
    const auto flat = static_cast<std::size_t>(
        (firstBlock[2] * blockCount_[1] + firstBlock[1]) * blockCount_[0] + firstBlock[0]);
    blockNumbers_[flat] = static_cast<std::int32_t>(blocks_.size());
    Block &block = blocks_.emplace_back();
    block.firstCell = {firstBlock[0] * blockCells, firstBlock[1] * blockCells, firstBlock[2] * blockCells};
    block.selection = std::move(selection);
    block.values.fill(unsampled);
    fill(block, {0, 0, 0}, blockCells);
}

// Samples a cube of cells: one sample at its middle where that settles the sign, each corner otherwise.
void SparseGrid::fill(Block &block, const GridIndex &first, int sizeCells) {
    const GridIndex low{block.firstCell[0] + first[0], block.firstCell[1] + first[1],
                        block.firstCell[2] + first[2]};
    const double half = 0.5 * sizeCells * spacing_;
    const double middle = field_->value(block.selection, position(low) + Vec3{half, half, half});
    const bool isFar = std::abs(middle) > halfDiagonal * 2.0 * half * 1.000001;
    if (!isFar && sizeCells > 2) {
        const int step = sizeCells / 2;
        for (int child = 0; child < 8; ++child)
            fill(block,
                 {first[0] + (child & 1) * step, first[1] + ((child >> 1) & 1) * step,
                  first[2] + ((child >> 2) & 1) * step},
                 step);
        return;
    }
    for (int k = first[2]; k <= first[2] + sizeCells; ++k)
        for (int j = first[1]; j <= first[1] + sizeCells; ++j)
            for (int i = first[0]; i <= first[0] + sizeCells; ++i) {
                double &value = block.values[valueIndex(i, j, k)];
                if (isFar) {
                    if (value == unsampled)
                        value = middle < 0.0 ? -farAway : farAway;
                } else if (value == unsampled || std::abs(value) == farAway) {
                    const GridIndex point{block.firstCell[0] + i, block.firstCell[1] + j,
                                          block.firstCell[2] + k};
                    value = field_->value(block.selection, position(point));
                    if (value == 0.0)
                        value = tinyOutside;
                }
            }
}

std::size_t SparseGrid::crossingCount() const {
    std::size_t count = 0;
    for (const Block &block : blocks_)
        for (int k = 0; k < blockCells; ++k)
            for (int j = 0; j < blockCells; ++j)
                for (int i = 0; i < blockCells; ++i) {
                    const bool inside = block.values[valueIndex(i, j, k)] < 0.0;
                    count += inside != (block.values[valueIndex(i + 1, j, k)] < 0.0) ? 1 : 0;
                    count += inside != (block.values[valueIndex(i, j + 1, k)] < 0.0) ? 1 : 0;
                    count += inside != (block.values[valueIndex(i, j, k + 1)] < 0.0) ? 1 : 0;
                }
    return count;
}

} // namespace hyalite::cat
