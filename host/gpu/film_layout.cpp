#include "host/gpu/film_layout.h"

#include "host/gpu/tile.h"

#include <cmath>

namespace hyalite::core::gpu {

FilmLayout::FilmLayout(const Crop &crop, std::span<const layout::FilmPixel> film, std::uint32_t sampleEnd)
    : crop_(crop), width_(static_cast<std::uint32_t>(crop.width())),
      height_(static_cast<std::uint32_t>(crop.height())) {
    constexpr std::uint32_t side = Tile::blockSide;
    if (std::ranges::none_of(film, [=](const auto &pixel) { return pixel.sampleCount >= sampleEnd; }))
        return;
    // Block by block, so that pixels that are near one another stay so.
    std::vector<std::size_t> wanting;
    for (std::uint32_t blockY = 0; blockY < height_; blockY += side)
        for (std::uint32_t blockX = 0; blockX < width_; blockX += side)
            for (std::uint32_t y = blockY; y < std::min(blockY + side, height_); ++y)
                for (std::uint32_t x = blockX; x < std::min(blockX + side, width_); ++x)
                    if (const std::size_t place = std::size_t{y} * width_ + x;
                        film[place].sampleCount < sampleEnd)
                        wanting.push_back(place);
    const std::size_t blockCount =
        std::max<std::size_t>((wanting.size() + side * side - 1) / (side * side), 1);
    const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(blockCount))));
    const std::size_t down = (blockCount + across - 1) / across;
    if (across * down * side * side >= pixelCount())
        return; // few have all samples
    width_ = static_cast<std::uint32_t>(across * side);
    height_ = static_cast<std::uint32_t>(down * side);
    places_.assign(pixelCount(), noPlace);
    for (std::size_t i = 0; i < wanting.size(); ++i) {
        const std::size_t block = i / (side * side);
        const std::size_t x = block % across * side + i % side;
        const std::size_t y = block / across * side + i / side % side;
        places_[y * width_ + x] = wanting[i];
    }
}

std::vector<std::uint32_t> FilmLayout::positions() const {
    const auto width = static_cast<std::size_t>(crop_.width());
    std::vector<std::uint32_t> positions(places_.size(), layout::noPosition);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::size_t place = places_[i];
        if (place != noPlace)
            positions[i] = layout::packPosition(
                static_cast<std::uint32_t>(crop_.x0) + static_cast<std::uint32_t>(place % width),
                static_cast<std::uint32_t>(crop_.y0) + static_cast<std::uint32_t>(place / width));
    }
    return positions;
}

} // namespace hyalite::core::gpu
