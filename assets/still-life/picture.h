// A picture in the making, and the PNG that it becomes.
#pragma once

#include "assets/still-life/vec.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace still_life {

/// What a pixel shows, as a screen takes it: channels in [0, 1].
struct Pixel {
    Vec colour{};
    double alpha = 1.0;
};

/// Rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels{};
};

/// Asks `at` for each pixel: u from the left and v from the bottom, in (0, 1), as texture coordinates go.
Picture draw(int width, int height, const std::function<Pixel(double u, double v)> &at);

/// A normal map, red along u and green along v, of a surface whose height, in widths of the picture, `at` gives. Heights
/// repeat.
Picture drawNormals(int width, int height, const std::function<double(double u, double v)> &at);

/// A PNG of 8 bits a channel, with alpha where `hasAlpha`.
std::string encodePng(const Picture &picture, bool hasAlpha);

/// Writes such a file. Whether it could.
bool writePng(const std::filesystem::path &file, const Picture &picture, bool hasAlpha);

} // namespace still_life
