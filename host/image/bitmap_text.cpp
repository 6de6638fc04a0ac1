#include "host/image/bitmap_text.h"

#include <algorithm>
#include <array>
#include <cstring>

// stb does not compile cleanly under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace hyalite::core {

Drawing::Drawing(int drawingWidth, int drawingHeight, const std::array<std::uint8_t, 3> &colour)
    : width(drawingWidth), height(drawingHeight),
      rgb(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    fill(0, 0, width, height, colour);
}

void Drawing::fill(int x0, int y0, int x1, int y1, const std::array<std::uint8_t, 3> &colour) {
    for (int y = std::max(y0, 0); y < std::min(y1, height); ++y)
        for (int x = std::max(x0, 0); x < std::min(x1, width); ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            std::copy(colour.begin(), colour.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
        }
}

int textWidth(const std::string &text, int scale) {
    std::string copy = text; // stb wants a char * that is not const
    return scale * stb_easy_font_width(copy.data());
}

void drawText(Drawing &drawing, int x, int y, int scale, const std::string &text,
              const std::array<std::uint8_t, 3> &colour) {
    struct Vertex {
        float x, y, z;
        std::array<unsigned char, 4> colour;
    };
    std::string copy = text;
    std::vector<Vertex> vertices(4 * 32 * text.size()); // each letter has fewer than 32 strokes
    const int quadCount = stb_easy_font_print(0.0f, 0.0f, copy.data(), nullptr, vertices.data(),
                                              static_cast<int>(vertices.size() * sizeof(Vertex)));
    for (int quad = 0; quad < quadCount; ++quad) {
        const Vertex &topLeft = vertices[static_cast<std::size_t>(4 * quad)];
        const Vertex &bottomRight = vertices[static_cast<std::size_t>(4 * quad + 2)];
        drawing.fill(x + scale * static_cast<int>(topLeft.x), y + scale * static_cast<int>(topLeft.y),
                     x + scale * static_cast<int>(bottomRight.x), y + scale * static_cast<int>(bottomRight.y),
                     colour);
    }
}

} // namespace hyalite::core
