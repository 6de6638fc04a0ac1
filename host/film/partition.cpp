#include "host/film/partition.h"

#include "host/scene/limits.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace hyalite::core {

namespace {

// Of each part: with fewer, one costly object decides what a part costs.
constexpr std::uint64_t squaresWanted = 64;

struct Squares {
    int side;
    std::uint32_t columns;
    std::uint32_t rows;

    Squares(const Crop &crop, int squareSide)
        : side(squareSide), columns(static_cast<std::uint32_t>((crop.width() + side - 1) / side)),
          rows(static_cast<std::uint32_t>((crop.height() + side - 1) / side)) {}

    [[nodiscard]] std::uint64_t count() const { return std::uint64_t{columns} * rows; }
};

/// The only part of a picture is all of it, in one piece.
Squares divide(const Crop &crop, std::uint32_t partCount, int smallestSide) {
    if (partCount == 1)
        return {crop, std::max(crop.width(), crop.height())};
    int side = Partition::maxSide;
    while (side > smallestSide && Squares(crop, side).count() < squaresWanted * partCount)
        side /= 2;
    return {crop, side};
}

/// The bits of x, with a zero bit before each.
std::uint64_t spread(std::uint32_t x) {
    std::uint64_t bits = x;
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFFu;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FFu;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0Fu;
    bits = (bits | bits << 2) & 0x3333333333333333u;
    return (bits | bits << 1) & 0x5555555555555555u;
}

/// A sequence of numbers that is the same everywhere: SplitMix64. G. Steele, D. Lea, C. Flood, "Fast Splittable
/// Pseudorandom Number Generators", OOPSLA 2014.
class SplitMix {
  public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}

    /// In [0, bound).
    std::uint64_t below(std::uint64_t bound) {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
        z = (z ^ z >> 27) * 0x94D049BB133111EBu;
        return (z ^ z >> 31) % bound;
    }

  private:
    std::uint64_t state_;
};

} // namespace

std::uint32_t Partition::maxParts(const Crop &crop, int smallest) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(
        Squares(crop, smallest).count(), static_cast<std::uint64_t>(limits::partCount.high)));
}

Partition::Partition(const Crop &crop, std::uint32_t partCount, int smallest)
    : crop_(crop), smallestSide_(smallest) {
    assert(partCount >= 1 && partCount <= maxParts(crop, smallest));
    const Squares squares = divide(crop, partCount, smallest);
    // Along Morton's curve squares that follow one another are near. Of each run of `partCount` every part gets one, in
    // an order that changes from run to run, so that no part has all squares of a column.
    std::vector<std::pair<std::uint64_t, Crop>> curve;
    curve.reserve(squares.count());
    for (std::uint32_t row = 0; row < squares.rows; ++row)
        for (std::uint32_t column = 0; column < squares.columns; ++column) {
            const int x = crop.x0 + static_cast<int>(column) * squares.side;
            const int y = crop.y0 + static_cast<int>(row) * squares.side;
            curve.emplace_back(
                spread(column) | spread(row) << 1,
                Crop{x, std::min(x + squares.side, crop.x1), y, std::min(y + squares.side, crop.y1)});
        }
    std::ranges::sort(curve, {}, [](const auto &square) { return square.first; });
    std::vector<std::uint32_t> order(partCount);
    std::iota(order.begin(), order.end(), 0u);
    std::vector<std::vector<Crop>> parts(partCount);
    SplitMix random(partCount);
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const std::size_t at = i % partCount;
        if (at == 0)
            for (std::size_t j = partCount; j-- > 1;)
                std::swap(order[j], order[random.below(j + 1)]);
        parts[order[at]].push_back(curve[i].second);
    }
    begins_.push_back(0);
    for (const std::vector<Crop> &part : parts) {
        squares_.insert(squares_.end(), part.begin(), part.end());
        begins_.push_back(squares_.size());
    }
}

std::uint64_t Partition::pixelCountOf(std::uint32_t part) const {
    std::uint64_t count = 0;
    for (const Crop &square : squaresOf(part))
        count += square.pixelCount();
    return count;
}

namespace {

/// Calls visit(index of the first pixel, number of pixels) for each row of the film in a square, in order.
template <class Visit> void visitRows(const Film &film, std::span<const Crop> squares, const Visit &visit) {
    for (const Crop &square : squares)
        for (int y = square.y0; y < square.y1; ++y)
            visit(film.crop.indexOf(square.x0, y), static_cast<std::size_t>(square.width()));
}

} // namespace

double shareOutside(const Crop &crop, std::span<const Crop> squares) {
    double own = 0.0;
    for (const Crop &square : squares)
        own += static_cast<double>(square.pixelCount());
    return 1.0 - own / static_cast<double>(crop.pixelCount());
}

void visitRowsIn(const Film &film, std::span<const Crop> squares,
                 const std::function<void(std::span<const layout::FilmPixel>)> &visit) {
    visitRows(film, squares, [&](std::size_t first, std::size_t count) {
        visit(std::span(film.pixels).subspan(first, count));
    });
}

FilmRecords recordsIn(const Film &film, std::span<const Crop> squares) {
    FilmRecords records;
    const std::size_t size = film.lightSize();
    visitRows(film, squares, [&](std::size_t first, std::size_t count) {
        const auto row = std::span(film.pixels).subspan(first, count);
        const auto light = std::span(film.light).subspan(first * size, count * size);
        records.pixels.insert(records.pixels.end(), row.begin(), row.end());
        records.light.insert(records.light.end(), light.begin(), light.end());
        if (!film.first.empty()) {
            const auto ofRow = std::span(film.first).subspan(first, count);
            records.first.insert(records.first.end(), ofRow.begin(), ofRow.end());
        }
        if (!film.wanted.empty()) {
            const auto ofRow = std::span(film.wanted).subspan(first, count);
            records.wanted.insert(records.wanted.end(), ofRow.begin(), ofRow.end());
        }
    });
    return records;
}

void setRecordsIn(Film &film, std::span<const Crop> squares, const FilmRecords &records) {
    const std::size_t size = records.lightSize();
    if (film.lightSize() != size)
        film.light.assign(film.pixels.size() * size, 0.0f);
    if (film.first.empty() != records.first.empty())
        film.first.assign(records.first.empty() ? 0 : film.pixels.size(), {});
    if (film.wanted.empty() != records.wanted.empty())
        film.wanted.assign(records.wanted.empty() ? 0 : film.pixels.size(), 0);
    std::size_t done = 0;
    visitRows(film, squares, [&](std::size_t first, std::size_t count) {
        std::ranges::copy(std::span(records.pixels).subspan(done, count),
                          std::span(film.pixels).subspan(first).begin());
        std::ranges::copy(std::span(records.light).subspan(done * size, count * size),
                          std::span(film.light).subspan(first * size).begin());
        if (!film.first.empty())
            std::ranges::copy(std::span(records.first).subspan(done, count),
                              std::span(film.first).subspan(first).begin());
        if (!film.wanted.empty())
            std::ranges::copy(std::span(records.wanted).subspan(done, count),
                              std::span(film.wanted).subspan(first).begin());
        done += count;
    });
    assert(done == records.pixels.size());
}

Film filmOfSquares(const Crop &crop, std::span<const Crop> squares, std::uint32_t sampleCount) {
    Film film(crop);
    for (layout::FilmPixel &pixel : film.pixels)
        pixel.sampleCount = sampleCount;
    visitRows(film, squares, [&](std::size_t first, std::size_t count) {
        std::ranges::fill(std::span(film.pixels).subspan(first, count), layout::FilmPixel{});
    });
    return film;
}

} // namespace hyalite::core
