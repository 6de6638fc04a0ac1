#include "assets/still-life/picture.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <zlib.h>

namespace still_life {

namespace {

void appendBigEndian(std::string &bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(value >> shift & 255u);
}

const Bytef *bytesOf(std::string_view text) { return reinterpret_cast<const Bytef *>(text.data()); }

void appendChunk(std::string &file, std::string_view type, std::string_view data) {
    appendBigEndian(file, static_cast<std::uint32_t>(data.size()));
    const std::string body = std::string(type) + std::string(data);
    file += body;
    appendBigEndian(file,
                    static_cast<std::uint32_t>(::crc32(0, bytesOf(body), static_cast<uInt>(body.size()))));
}

/// A zlib stream.
std::string pack(std::string_view data) {
    uLongf size = compressBound(static_cast<uLong>(data.size()));
    std::string stream(size, '\0');
    if (compress2(reinterpret_cast<Bytef *>(stream.data()), &size, bytesOf(data),
                  static_cast<uLong>(data.size()), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("zlib cannot pack a picture");
    stream.resize(size);
    return stream;
}

char levelOf(double value) {
    return static_cast<char>(static_cast<unsigned>(std::lround(clamp01(value) * 255.0)));
}

} // namespace

Picture draw(int width, int height, const std::function<Pixel(double u, double v)> &at) {
    Picture picture{width, height};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.pixels.push_back(at((x + 0.5) / width, 1.0 - (y + 0.5) / height));
    return picture;
}

Picture drawNormals(int width, int height, const std::function<double(double u, double v)> &at) {
    const double du = 1.0 / width;
    const double dv = 1.0 / height;
    const auto repeat = [](double x) { return x - std::floor(x); };
    return draw(width, height, [&](double u, double v) {
        const double slopeU = (at(repeat(u + du), v) - at(repeat(u - du), v)) / (2.0 * du);
        const double slopeV = (at(u, repeat(v + dv)) - at(u, repeat(v - dv))) / (2.0 * dv);
        const Vec normal = normalise({-slopeU, -slopeV, 1.0});
        return Pixel{{0.5 + 0.5 * normal[0], 0.5 + 0.5 * normal[1], 0.5 + 0.5 * normal[2]}};
    });
}

std::string encodePng(const Picture &picture, bool hasAlpha) {
    std::string rows;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (i % static_cast<std::size_t>(picture.width) == 0)
            rows += '\0'; // unfiltered
        for (const double value : picture.pixels[i].colour)
            rows += levelOf(value);
        if (hasAlpha)
            rows += levelOf(picture.pixels[i].alpha);
    }
    std::string header;
    appendBigEndian(header, static_cast<std::uint32_t>(picture.width));
    appendBigEndian(header, static_cast<std::uint32_t>(picture.height));
    header += std::string{8, hasAlpha ? '\6' : '\2', 0, 0, 0};
    std::string png = "\x89PNG\r\n\x1a\n";
    appendChunk(png, "IHDR", header);
    appendChunk(png, "IDAT", pack(rows));
    appendChunk(png, "IEND", {});
    return png;
}

bool writePng(const std::filesystem::path &file, const Picture &picture, bool hasAlpha) {
    std::ofstream stream(file, std::ios::binary);
    stream << encodePng(picture, hasAlpha);
    stream.close();
    return stream.good();
}

} // namespace still_life
