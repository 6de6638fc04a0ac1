#include "host/image/false_colour.h"

#include "host/image/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hyalite::core {

namespace {

constexpr std::array<std::uint8_t, 3> paper{24, 24, 28};
constexpr std::array<std::uint8_t, 3> ink{235, 235, 235};
constexpr int divisionCount = 5;

/// Layout of the strip below the drawing, in pixels at scale 1.
namespace strip {
constexpr int margin = 8;
constexpr int barTop = 8;
constexpr int barBottom = 20;
constexpr int tickBottom = 23;
constexpr int numbersTop = 26;
constexpr int quantityTop = numbersTop + textHeight + 4;
constexpr int height = quantityTop + textHeight + 5;
} // namespace strip

void drawCentred(Drawing &drawing, int x, int y, int scale, const std::string &text) {
    // The numbers at both ends stay inside the drawing.
    const int width = textWidth(text, scale);
    const int most = std::max(drawing.width - width - scale, scale);
    drawText(drawing, std::clamp(x - width / 2, scale, most), y, scale, text, ink);
}

void drawLegend(Drawing &drawing, int top, int scale, double scaleEnd, const std::string &caption) {
    const int left = scale * 2 * strip::margin;
    const int right = drawing.width - left;
    const int last = right - left - 1;
    for (int i = 0; i <= last; ++i)
        drawing.fill(left + i, top + scale * strip::barTop, left + i + 1, top + scale * strip::barBottom,
                     magma(static_cast<float>(i) / static_cast<float>(last)));
    for (int i = 0; i <= divisionCount; ++i) {
        const int x = left + last * i / divisionCount;
        drawing.fill(x, top + scale * strip::barBottom, x + scale, top + scale * strip::tickBottom, ink);
        drawCentred(drawing, x, top + scale * strip::numbersTop, scale,
                    fmt::format("{:g}", scaleEnd * i / divisionCount));
    }
    drawText(drawing, left, top + scale * strip::quantityTop, scale, caption, ink);
}

} // namespace

double scaleEndFor(std::span<const float> values) {
    if (values.empty())
        return 1.0;
    std::vector<float> sorted(values.begin(), values.end());
    const std::size_t index = (sorted.size() * 99 + 99) / 100 - 1;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(index), sorted.end());
    const double wanted = static_cast<double>(sorted[index]);
    if (!(wanted > 0.0))
        return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    // A fifth of each factor is a short number. The logarithm may be rounded down.
    for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 20.0})
        if (factor * power >= wanted)
            return factor * power;
    return wanted;
}

Drawing falseColours(int width, int height, std::span<const float> values, const std::string &quantity) {
    assert(values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const double scaleEnd = scaleEndFor(values);
    const float largest = values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
    const std::string caption = fmt::format("{}; most: {:.4g}", quantity, largest);
    const auto neededWidth = [&](int scale) { return textWidth(caption, scale) + scale * 4 * strip::margin; };
    const int scale = width >= neededWidth(2) ? 2 : 1;
    Drawing drawing(std::max(width, neededWidth(scale)), height + scale * strip::height, paper);
    const int left = (drawing.width - width) / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            drawing.fill(left + x, y, left + x + 1, y + 1,
                         magma(static_cast<float>(static_cast<double>(values[pixel]) / scaleEnd)));
        }
    drawLegend(drawing, height, scale, scaleEnd, caption);
    return drawing;
}

} // namespace hyalite::core
