#include "host/lab/wrong_film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace hyalite::core {

namespace {

constexpr std::size_t wordCount = sizeof(layout::FilmPixel) / sizeof(std::uint32_t);

/// The members of layout::FilmPixel, word by word.
constexpr std::array<std::string_view, wordCount> wordNames{
    "sum.red",         "sum.green",         "sum.blue",         "sampleCount",
    "sumRest.red",     "sumRest.green",     "sumRest.blue",     "padding",
    "squares.red",     "squares.green",     "squares.blue",     "transparency",
    "squaresRest.red", "squaresRest.green", "squaresRest.blue", "transparencyRest"};

glm::dvec3 squaresOf(const layout::FilmPixel &pixel) {
    return glm::dvec3(pixel.sumOfSquares) + glm::dvec3(pixel.squaresRest);
}

} // namespace

std::vector<WrongFilmWord> wrongWords(const layout::FilmPixel &found, const layout::FilmPixel &expected) {
    using Words = std::array<std::uint32_t, wordCount>;
    const auto a = std::bit_cast<Words>(found);
    const auto b = std::bit_cast<Words>(expected);
    std::vector<WrongFilmWord> wrong;
    for (std::size_t i = 0; i < wordCount; ++i)
        if (a[i] != b[i])
            wrong.push_back({wordNames[i], a[i], b[i]});
    return wrong;
}

std::vector<std::uint32_t> samplesThatExplain(const layout::FilmPixel &found,
                                              const layout::FilmPixel &expected,
                                              std::span<const glm::dvec3> values) {
    if (found.sampleCount != expected.sampleCount)
        return {};
    const glm::dvec3 sums = sumOf(found) - sumOf(expected);
    const glm::dvec3 squares = squaresOf(found) - squaresOf(expected);
    std::vector<std::uint32_t> samples;
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        bool isExplained = false;
        for (int channel = 0; channel < 3; ++channel) {
            const double change = sums[channel];
            const double right = values[i][channel];
            const double wrong = right + change;
            // Compensated sums round each number to float32, with what was left out before (shaders/math/sums.glsl).
            const double tolerance = 2e-6 * (right * right + wrong * wrong) + 1e-30;
            if (std::abs(change * (right + wrong) - squares[channel]) > tolerance) {
                isExplained = false;
                break;
            }
            isExplained = isExplained || std::abs(squares[channel]) > tolerance;
        }
        if (isExplained)
            samples.push_back(i);
    }
    return samples;
}

void WrongPatterns::addBits(std::uint32_t found, std::uint32_t expected) {
    for (std::uint32_t wrong = found ^ expected; wrong != 0; wrong &= wrong - 1)
        ++bits[static_cast<std::size_t>(std::countr_zero(wrong))];
}

void WrongPatterns::add(const WrongFilmWord &word) {
    addBits(word.found, word.expected);
    const auto known = std::ranges::find(words, word.name, [](const auto &entry) { return entry.first; });
    if (known != words.end())
        ++known->second;
    else
        words.emplace_back(word.name, 1);
}

void WrongPatterns::addLane(std::uint32_t lane) {
    if (lane >= lanes.size())
        lanes.resize(lane + 1);
    ++lanes[lane];
}

} // namespace hyalite::core
