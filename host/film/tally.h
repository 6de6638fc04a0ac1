// Tallies: films of views of numbers, which count how many samples of a pixel show each number.
//
// The numbers that come first in the order of the samples are kept apart, layout::tallyNumbers of them; the samples of
// all others are one count. Device and CPU keep the same ones, whatever the tiles, parts and samples in flight.
#pragma once

#include "shaders/layout/layout.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace hyalite::core {

struct NumberCount {
    std::uint32_t number = 0;
    std::uint32_t count = 0; ///< of samples
};

/// A pixel of a tally.
struct Tally {
    std::vector<NumberCount> numbers; ///< in the order in which they come first
    std::uint32_t othersCount = 0;    ///< of samples whose numbers found no room
    std::uint32_t sampleCount = 0;    ///< of all, with those that show nothing
};

/// The words of a pixel, in pairs.
using TallyWords = std::array<NumberCount, layout::tallyPairs>;

/// Adds a sample; number 0 is nothing.
inline void tallySample(layout::FilmPixel &pixel, std::uint32_t number) {
    auto pairs = std::bit_cast<TallyWords>(pixel);
    NumberCount &others =
        pairs[layout::tallyOthers]; // the number is their count, the count that of all samples
    ++others.count;
    if (number != 0) {
        NumberCount *place = nullptr;
        for (NumberCount &pair : pairs)
            if (&pair != &others && place == nullptr && (pair.number == number || pair.number == 0))
                place = &pair;
        if (place != nullptr)
            *place = {number, place->count + 1};
        else
            ++others.number;
    }
    pixel = std::bit_cast<layout::FilmPixel>(pairs);
}

[[nodiscard]] inline Tally tallyOf(const layout::FilmPixel &pixel) {
    const auto pairs = std::bit_cast<TallyWords>(pixel);
    const NumberCount &others = pairs[layout::tallyOthers];
    Tally tally{{}, others.number, others.count};
    for (const NumberCount &pair : pairs)
        if (&pair != &others && pair.number != 0)
            tally.numbers.push_back(pair);
    return tally;
}

} // namespace hyalite::core
