// Tiles: the part of a film that one dispatch works on.
#pragma once

#include <cstdint>
#include <utility>

namespace hyalite::core::gpu {

/// A rectangle of pixels; the film may end inside. Sides are multiples of 8, because 64 slots work on a block of 8x8
/// pixels.
struct Tile {
    static constexpr std::uint32_t blockSide = 8;

    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    [[nodiscard]] std::uint64_t pixelCount() const { return std::uint64_t{width} * height; }
    [[nodiscard]] bool canBeHalved() const { return width > blockSide || height > blockSide; }

    /// The two halves, side by side or one above the other. Requires canBeHalved().
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

} // namespace hyalite::core::gpu
