// Wrong films: what differs between a film and the one that it should be, to the bit, and which sample did it.
#pragma once

#include "host/film/film.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// A word of a pixel of the film.
struct WrongFilmWord {
    std::string_view name; ///< "sum.red", "sampleCount"
    std::uint32_t found = 0;
    std::uint32_t expected = 0;

    bool operator==(const WrongFilmWord &) const = default;
};

/// Words of a pixel that differ, in their order.
[[nodiscard]] std::vector<WrongFilmWord> wrongWords(const layout::FilmPixel &found,
                                                    const layout::FilmPixel &expected);

/// The samples of a pixel of which one, had it another value, would explain the difference of the sums; several, if
/// they have like values. Empty: more than one sample is wrong, or the sums themselves are, or rounding hides it.
/// `values` are those of the samples as they should be. From the differences dS of the sums and dQ of the sums of
/// squares follows the right value of the one sample that was replaced, x = (dQ / dS - dS) / 2.
[[nodiscard]] std::vector<std::uint32_t> samplesThatExplain(const layout::FilmPixel &found,
                                                            const layout::FilmPixel &expected,
                                                            std::span<const glm::dvec3> values);

/// How often each bit of a word was wrong, each name of a word, and each lane of a subgroup, over many pixels.
struct WrongPatterns {
    std::array<std::uint64_t, 32> bits{};
    std::vector<std::pair<std::string_view, std::uint64_t>> words{};
    std::vector<std::uint64_t> lanes{}; ///< by index, as far as one was hit

    void add(const WrongFilmWord &word);
    void addBits(std::uint32_t found, std::uint32_t expected);
    void addLane(std::uint32_t lane);
};

} // namespace hyalite::core
