#include "host/packing/environment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace hyalite::core {

namespace {

constexpr double numberCount = 4294967296.0; // number of 32-bit values

/// Weights of the pixels of a row: the integral of the interpolated image over the pixel's area of the sphere, up to a
/// factor. The image is bilinear between pixel centres, so the mean over a pixel takes 3/4 of itself and 1/8 of each
/// neighbour along each axis.
void weighRow(const Image &image, int y, std::vector<double> &weights) {
    const int width = image.width();
    const int height = image.height();
    const auto at = [&](int x, int row) {
        const glm::dvec3 colour(image.at((x + width) % width, std::clamp(row, 0, height - 1)));
        return colour.x + colour.y + colour.z;
    };
    const auto acrossRow = [&](int x, int row) {
        return 0.125 * at(x - 1, row) + 0.75 * at(x, row) + 0.125 * at(x + 1, row);
    };
    const double sine = std::sin(std::numbers::pi * (y + 0.5) / height);
    weights.resize(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
        weights[static_cast<std::size_t>(x)] =
            sine * (0.125 * acrossRow(x, y - 1) + 0.75 * acrossRow(x, y) + 0.125 * acrossRow(x, y + 1));
}

/// The number of 32-bit values below the given fraction of their range.
std::uint32_t numbersBelow(double share) {
    return static_cast<std::uint32_t>(std::min(std::floor(share * numberCount), numberCount - 1.0));
}

} // namespace

bool packEnvironment(const Scene &scene, PackedScene &packed) {
    const Image &image = scene.environment.radiance;
    const std::size_t width = static_cast<std::size_t>(image.width());
    const std::size_t height = static_cast<std::size_t>(image.height());
    packed.lighting |= layout::lightsByEnvironment;
    packed.frame.environmentTexels = static_cast<std::uint32_t>(packed.lookups.size());
    packed.frame.environmentWidth = static_cast<std::uint32_t>(width);
    packed.frame.environmentHeight = static_cast<std::uint32_t>(height);
    const double turns = scene.environment.rotateDegrees / 360.0;
    packed.frame.environmentTurns = std::min(static_cast<float>(turns - std::floor(turns)), 0x1.fffffep-1f);

    std::vector<double> rowTotals(height, 0.0);
    const std::size_t first = packed.lookups.size();
    packed.lookups.resize(first + width * height);
    packed.lookups.reserve(first + width * height + height);
#pragma omp parallel
    {
        std::vector<double> weights;
#pragma omp for schedule(static)
        for (std::int64_t row = 0; row < static_cast<std::int64_t>(height); ++row) {
            const auto y = static_cast<std::size_t>(row);
            weighRow(image, static_cast<int>(row), weights);
            for (const double weight : weights)
                rowTotals[y] += weight;
            double before = 0.0;
            for (std::size_t x = 0; x < width; ++x) {
                before += weights[x];
                const double share = rowTotals[y] > 0.0 ? before / rowTotals[y] : 0.0;
                packed.lookups[first + y * width + x] = {
                    image.pixels()[y * width + x] * scene.environment.scale,
                    x + 1 == width ? numbersBelow(1.0) : numbersBelow(share)};
            }
        }
    }
    double total = 0.0;
    for (const double rowTotal : rowTotals)
        total += rowTotal;
    double before = 0.0;
    std::uint32_t numbersBefore = 0;
    for (std::size_t y = 0; y < height; ++y) {
        before += rowTotals[y];
        const std::uint32_t numbers =
            y + 1 == height ? numbersBelow(1.0) : numbersBelow(total > 0.0 ? before / total : 0.0);
        const double chance = static_cast<double>(numbers - numbersBefore) / numberCount;
        packed.lookups.push_back({glm::vec3(static_cast<float>(chance), 0.0f, 0.0f), numbers});
        numbersBefore = numbers;
    }
    return total > 0.0 && scene.environment.scale > 0.0f;
}

} // namespace hyalite::core
