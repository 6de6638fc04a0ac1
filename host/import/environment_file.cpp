#include "host/import/environment_file.h"

#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "host/image/texture_file.h"
#include "host/image/tone_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

constexpr float largestHalf = 65504.0f;
constexpr std::size_t exrHeadBytes = 4;

/// The colours of an 8-bit image in sRGB.
Image linearised(const Texture &texture) {
    const std::array<float, 256> &table = srgbDecodedLevels();
    Image image(texture.width, texture.height);
    for (std::size_t i = 0; i < texture.levels.size(); ++i) {
        const std::uint32_t levels = texture.levels[i];
        image.pixels()[i] = {table[levels & 255u], table[levels >> 8u & 255u], table[levels >> 16u & 255u]};
    }
    return image;
}

Image imageOf(Texture &&texture) {
    Image image(texture.width, texture.height);
    image.pixels() = std::move(texture.values);
    return image;
}

/// Pixels with a number that is no radiance.
struct Faults {
    std::size_t negative = 0;
    std::size_t infinite = 0;
    std::size_t notNumbers = 0;
};

/// Makes all numbers finite and >= 0; infinite ones become `most`.
Faults mend(Image &image, float most) {
    Faults faults;
    for (glm::vec3 &pixel : image.pixels()) {
        bool isNegative = false;
        bool isInfinite = false;
        bool isNotNumber = false;
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            float &number = pixel[channel];
            isNotNumber = isNotNumber || std::isnan(number);
            isNegative = isNegative || number < 0.0f;
            isInfinite = isInfinite || number > std::numeric_limits<float>::max();
            number = number > 0.0f ? std::min(number, most) : 0.0f;
        }
        faults.negative += isNegative ? 1u : 0u;
        faults.infinite += isInfinite ? 1u : 0u;
        faults.notNumbers += isNotNumber ? 1u : 0u;
    }
    return faults;
}

float largestFinite(const Image &image) {
    float most = largestHalf;
    for (const glm::vec3 &pixel : image.pixels())
        for (glm::length_t channel = 0; channel < 3; ++channel)
            if (std::isfinite(pixel[channel]))
                most = std::max(most, pixel[channel]);
    return most;
}

} // namespace

EnvironmentImage environmentImageOf(Image radiance, const std::string &name) {
    EnvironmentImage environment{std::move(radiance), {}};
    const float most = largestFinite(environment.radiance);
    const Faults faults = mend(environment.radiance, most);
    const auto warn = [&](std::size_t count, std::string_view what, float value) {
        if (count > 0)
            environment.warnings.push_back(fmt::format("{}: {} of {} pixels {}, which count as {}", name,
                                                       count, environment.radiance.pixels().size(), what,
                                                       value));
    };
    warn(faults.negative, "have negative numbers", 0.0f);
    warn(faults.infinite, "have infinite numbers", most);
    warn(faults.notNumbers, "have numbers that are NaN", 0.0f);
    return environment;
}

EnvironmentImage readEnvironmentImage(const std::filesystem::path &file) {
    Image radiance;
    if (isTextureFile(file)) {
        Texture texture = readTexture(file);
        radiance = texture.isFloat() ? imageOf(std::move(texture)) : linearised(texture);
    } else if (const InputFile input(file); isExr(input.head(exrHeadBytes))) {
        radiance = readExr(input, "", ExrWindow::Display);
    } else {
        radiance = readImage(file).image;
    }
    return environmentImageOf(std::move(radiance), file.string());
}

} // namespace hyalite::core
