#include "host/engine/tile_queue.h"

#include "host/film/partition.h"

#include <algorithm>
#include <utility>

namespace hyalite::core {

namespace {

bool canBeHalved(const Crop &crop) {
    return crop.width() > TileQueue::blockSide || crop.height() > TileQueue::blockSide;
}

/// Side by side or one above the other. Requires canBeHalved().
std::pair<Crop, Crop> halves(const Crop &crop) {
    const auto half = [](int pixels) {
        return (pixels / 2 + TileQueue::blockSide - 1) / TileQueue::blockSide * TileQueue::blockSide;
    };
    std::pair<Crop, Crop> both{crop, crop};
    if (crop.width() > crop.height())
        both.first.x1 = both.second.x0 = crop.x0 + half(crop.width());
    else
        both.first.y1 = both.second.y0 = crop.y0 + half(crop.height());
    return both;
}

std::uint64_t unfinishedPixels(const Film &film, const Crop &crop, std::uint32_t samplesPerPixel) {
    std::uint64_t count = 0;
    visitRowsIn(film, std::span(&crop, 1), [&](std::span<const layout::FilmPixel> row) {
        count += static_cast<std::uint64_t>(std::ranges::count_if(
            row, [&](const layout::FilmPixel &pixel) { return pixel.sampleCount < samplesPerPixel; }));
    });
    return count;
}

} // namespace

TileQueue::TileQueue(const Film &film, std::uint32_t samplesPerPixel) {
    // Finished pixels are cut off as far as that leaves no crumbs.
    constexpr std::uint64_t crumb = 32 * 32;
    std::vector<Crop> toLookAt{film.crop};
    while (!toLookAt.empty()) {
        const Crop crop = toLookAt.back();
        toLookAt.pop_back();
        const std::uint64_t unfinished = unfinishedPixels(film, crop, samplesPerPixel);
        if (unfinished == 0)
            continue;
        if (unfinished == crop.pixelCount() || crop.pixelCount() <= crumb || !canBeHalved(crop)) {
            giveBack(crop);
        } else {
            const auto [first, second] = halves(crop);
            toLookAt.push_back(first); // the second one is looked at first, and given out last
            toLookAt.push_back(second);
        }
    }
}

std::optional<Crop> TileQueue::take(std::uint64_t maxPixels) {
    if (waiting_.empty())
        return std::nullopt;
    Crop tile = waiting_.back();
    waiting_.pop_back();
    pixelCount_ -= tile.pixelCount();
    while (tile.pixelCount() > maxPixels && canBeHalved(tile)) {
        const auto [first, second] = halves(tile);
        giveBack(second);
        tile = first;
    }
    return tile;
}

void TileQueue::giveBack(const Crop &tile) {
    waiting_.push_back(tile);
    pixelCount_ += tile.pixelCount();
}

std::uint64_t tilePixels(const TileWish &wish) {
    constexpr double minSeconds = 0.05;
    constexpr double maxSeconds = 2.0;
    constexpr double growth = 8.0;
    constexpr double minPixels = 64.0;
    constexpr double firstPixels = 4096.0;
    constexpr double firstSamples = 1 << 16; // of a tile for a renderer whose speed is not known
    if (wish.samplesPerSecond == 0.0)
        return static_cast<std::uint64_t>(
            std::clamp(firstSamples / wish.samplesPerPixel, minPixels, firstPixels));
    const double pixelsPerSecond = wish.samplesPerSecond / wish.samplesPerPixel;
    const double share = wish.samplesPerSecond / wish.allSamplesPerSecond;
    const double fair = wish.waitingPixels * (share < 1.0 ? share / 16.0 : 1.0);
    const double wanted =
        std::min(std::clamp(fair, minSeconds * pixelsPerSecond, maxSeconds * pixelsPerSecond),
                 growth * wish.lastSamples / wish.samplesPerPixel);
    return static_cast<std::uint64_t>(std::max(wanted, minPixels));
}

} // namespace hyalite::core
