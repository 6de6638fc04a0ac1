#include "host/film/noisy_picture.h"

#include "host/image/crop.h"

#include <algorithm>
#include <cmath>

namespace hyalite::core {

namespace {

constexpr float largestColour = 1e9f;    // its square, summed over a picture, is far from the range of floats
constexpr float smallestColour = 1e-12f; // no product of it with weights and features is subnormal
constexpr float largestDepth = 1e10f;

/// Within the range; NaN and what is tiny are 0.
float inRange(float x, float least, float most) {
    return std::abs(x) >= smallestColour ? std::clamp(x, least, most) : 0.0f;
}

glm::vec3 inRange(const glm::vec3 &v, float least, float most) {
    return {inRange(v.x, least, most), inRange(v.y, least, most), inRange(v.z, least, most)};
}

bool isPlain(const glm::vec3 &colour, float scale) {
    const auto isPlainNumber = [scale](float x) { return x >= 0.0f && x * scale <= largestColour; };
    return isPlainNumber(colour.x) && isPlainNumber(colour.y) && isPlainNumber(colour.z);
}

/// A power of two, which changes no bit of a colour but its exponent: exposure does not matter to the denoiser.
float scaleOf(const NoisyPicture &picture) {
    double sum = 0.0;
    double count = 0.0;
    for (const layout::NoisyPixel &pixel : picture.pixels) {
        const double luminance = 0.2126 * double{pixel.colour.x} + 0.7152 * double{pixel.colour.y} +
                                 0.0722 * double{pixel.colour.z};
        if (luminance >= 0.0 && luminance <= 1e30) {
            sum += luminance;
            count += 1.0;
        }
    }
    int exponent = 0;
    if (count > 0.0 && sum > 0.0)
        std::frexp(sum / count, &exponent);
    return std::ldexp(1.0f, std::clamp(-exponent, -60, 60));
}

layout::NoisyPixel scaled(const layout::NoisyPixel &pixel, float scale) {
    layout::NoisyPixel result = pixel;
    if (!isPlain(pixel.colour, scale)) // it stays as it is, and its neighbours see black
        result.colour = result.first = result.variance = glm::vec3(0.0f);
    result.colour = inRange(result.colour * scale, 0.0f, largestColour);
    result.first = inRange(result.first * scale, 0.0f, largestColour);
    result.variance = inRange(result.variance * (scale * scale), 0.0f, largestColour * largestColour);
    result.firstShare = std::clamp(inRange(pixel.firstShare, 0.0f, 1.0f), 0.001f, 0.999f);
    result.albedo = inRange(pixel.albedo, -1000.0f, 1000.0f);
    result.normal = inRange(pixel.normal, -1000.0f, 1000.0f);
    result.depth = inRange(pixel.depth, 0.0f, largestDepth);
    return result;
}

} // namespace

Image denoisedByTiles(const NoisyPicture &picture, int side,
                      const std::function<std::vector<glm::vec3>(const NoisyPicture &tile)> &denoiseTile) {
    constexpr int margin = layout::denoiserMargin;
    side = std::max(side / layout::tileAlignment, 1) * layout::tileAlignment;
    const float scale = scaleOf(picture);
    Image image(picture.width, picture.height);
    for (int top = 0; top < picture.height; top += side)
        for (int left = 0; left < picture.width; left += side) {
            const Crop own{left, std::min(left + side, picture.width), top,
                           std::min(top + side, picture.height)};
            const Crop around{std::max(own.x0 - margin, 0), std::min(own.x1 + margin, picture.width),
                              std::max(own.y0 - margin, 0), std::min(own.y1 + margin, picture.height)};
            const auto indexOf = [&](int x, int y) {
                return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(x);
            };
            NoisyPicture tile{around.width(), around.height()};
            tile.pixels.reserve(around.pixelCount());
            for (int y = around.y0; y < around.y1; ++y)
                for (int x = around.x0; x < around.x1; ++x)
                    tile.pixels.push_back(scaled(picture.pixels[indexOf(x, y)], scale));
            const std::vector<glm::vec3> colours = denoiseTile(tile);
            for (int y = own.y0; y < own.y1; ++y)
                for (int x = own.x0; x < own.x1; ++x) {
                    const glm::vec3 &noisy = picture.pixels[indexOf(x, y)].colour;
                    image.at(x, y) = isPlain(noisy, scale) ? colours[around.indexOf(x, y)] / scale : noisy;
                }
        }
    return image;
}

} // namespace hyalite::core
