// Parts of a film that one dispatch works on.
#pragma once

#include <cstdint>
#include <utility>

namespace hyalite::gpu {

/// Pixels of a film, which may end inside. Sides are multiples of 8: 8x8 pixels are the block that 64 slots take.
struct Tile {
    static constexpr std::uint32_t blockSide = 8;

    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    [[nodiscard]] std::uint64_t pixelCount() const { return std::uint64_t{width} * height; }
    [[nodiscard]] bool canBeHalved() const { return width > blockSide || height > blockSide; }

    /// Two tiles side by side, or one above the other, that are this one; it can be halved.
    [[nodiscard]] std::pair<Tile, Tile> halves() const {
        const auto half = [](std::uint32_t pixels) {
            return (pixels / 2 + blockSide - 1) / blockSide * blockSide;
        };
        if (width > height)
            return {{x, y, half(width), height}, {x + half(width), y, width - half(width), height}};
        return {{x, y, width, half(height)}, {x, y + half(height), width, height - half(height)}};
    }
    bool operator==(const Tile &) const = default;
};

} // namespace hyalite::gpu
