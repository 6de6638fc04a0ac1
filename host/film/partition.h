// The partition of a picture into parts, so that each can be rendered by itself and on any machine: squares of pixels,
// scattered so that parts have as many of them and cost alike. It depends on the crop, the number of parts and the smallest
// side of a square alone.
#pragma once

#include "host/film/film.h"
#include "host/image/crop.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hyalite::core {

/// Part `index` of `count`, counted from 1.
struct Part {
    std::uint32_t index = 1;
    std::uint32_t count = 1;

    [[nodiscard]] bool operator==(const Part &) const = default;
};

class Partition {
  public:
    static constexpr int minSide = 8; // as many pixels as a workgroup has slots
    static constexpr int maxSide = 64;

    /// The most parts that a crop can be divided into, 65536 at most: each has a square, of the smallest side except for
    /// those at the edges. Sides are at least `smallestSide`, which is minSide
    /// times a power of two.
    [[nodiscard]] static std::uint32_t maxParts(const Crop &crop, int smallestSide = minSide);

    /// 1 <= partCount <= maxParts(crop, smallestSide). The only part of one is all of the crop, as one square.
    Partition(const Crop &crop, std::uint32_t partCount, int smallestSide = minSide);

    [[nodiscard]] const Crop &crop() const { return crop_; }
    [[nodiscard]] int smallestSide() const { return smallestSide_; }
    [[nodiscard]] std::uint32_t partCount() const { return static_cast<std::uint32_t>(begins_.size() - 1); }

    /// The squares of a part, 1 <= part <= partCount(), inside the crop; those at its right and lower edges are cut.
    [[nodiscard]] std::span<const Crop> squaresOf(std::uint32_t part) const {
        return std::span(squares_).subspan(begins_[part - 1], begins_[part] - begins_[part - 1]);
    }
    [[nodiscard]] std::uint64_t pixelCountOf(std::uint32_t part) const;

  private:
    Crop crop_;
    int smallestSide_;
    std::vector<Crop> squares_;       // part by part
    std::vector<std::size_t> begins_; // of each part, and the end
};

/// The share of the crop's pixels, in [0, 1), that is in none of the squares.
[[nodiscard]] double shareOutside(const Crop &crop, std::span<const Crop> squares);

/// Calls visit(pixels) for each row of the film in each of the squares, in their order.
void visitRowsIn(const Film &film, std::span<const Crop> squares,
                 const std::function<void(std::span<const layout::FilmPixel>)> &visit);

/// What the film has in the squares: of each in their order, row by row.
[[nodiscard]] FilmRecords recordsIn(const Film &film, std::span<const Crop> squares);

/// The opposite: gives the film these records, as many as the squares have pixels. Layers of light, first samples
/// and wanted counts are kept from then on, if the records have any.
void setRecordsIn(Film &film, std::span<const Crop> squares, const FilmRecords &records);

/// A film in which pixels outside of the squares have `sampleCount` samples already: a render leaves them alone.
[[nodiscard]] Film filmOfSquares(const Crop &crop, std::span<const Crop> squares, std::uint32_t sampleCount);

} // namespace hyalite::core
