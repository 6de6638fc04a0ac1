// Short labels drawn into images with the bitmap font of stb_easy_font.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

/// 8-bit R, G, B, row by row from the top left, as writePng() takes it.
struct Drawing {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    Drawing() = default;
    Drawing(int drawingWidth, int drawingHeight, const std::array<std::uint8_t, 3> &colour);

    /// Pixels outside are ignored.
    void fill(int x0, int y0, int x1, int y1, const std::array<std::uint8_t, 3> &colour);
};

inline constexpr int textHeight = 9; ///< pixels of a line at scale 1, with descenders

/// Pixels. `text` is a line of printable ASCII.
[[nodiscard]] int textWidth(const std::string &text, int scale);

/// The top left corner of the line is at (x, y).
void drawText(Drawing &drawing, int x, int y, int scale, const std::string &text,
              const std::array<std::uint8_t, 3> &colour);

} // namespace hyalite::core
