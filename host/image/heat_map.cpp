#include "host/image/heat_map.h"

#include <algorithm>
#include <cmath>

namespace hyalite::core {

namespace {

/// Entries 0, 15, 30, ..., 255 of the original table, as 8-bit levels.
constexpr std::array<std::array<int, 3>, 18> magmaColours = {{
    {0, 0, 4},
    {9, 7, 32},
    {26, 16, 66},
    {49, 17, 101},
    {74, 16, 121},
    {98, 25, 128},
    {121, 34, 130},
    {145, 43, 129},
    {170, 51, 125},
    {194, 59, 117},
    {217, 70, 107},
    {236, 88, 96},
    {247, 114, 92},
    {252, 142, 100},
    {254, 170, 116},
    {254, 198, 138},
    {253, 226, 163},
    {252, 253, 191},
}};

} // namespace

std::array<std::uint8_t, 3> magma(float error) {
    const float clamped = std::isnan(error) ? 1.0f : std::clamp(error, 0.0f, 1.0f);
    const float position = clamped * static_cast<float>(magmaColours.size() - 1);
    const std::size_t index = std::min(static_cast<std::size_t>(position), magmaColours.size() - 2);
    const float fraction = position - static_cast<float>(index);
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto low = static_cast<float>(magmaColours[index][channel]);
        const auto high = static_cast<float>(magmaColours[index + 1][channel]);
        colour[channel] = static_cast<std::uint8_t>(low + (high - low) * fraction + 0.5f);
    }
    return colour;
}

std::vector<std::uint8_t> heatMap(const ErrorMap &map) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(map.errors.size() * 3);
    for (const float error : map.errors) {
        const std::array<std::uint8_t, 3> colour = magma(error);
        bytes.insert(bytes.end(), colour.begin(), colour.end());
    }
    return bytes;
}

} // namespace hyalite::core
