#include "host/reference/denoise.h"

#include "host/leaves/leaves.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <vector>

namespace hyalite::core::reference {

namespace {

using glm::vec3;
using layout::NoisyPixel;

constexpr std::size_t features = layout::featureCount;
constexpr std::size_t estimateKinds = layout::estimateCount;

/// The sums of a regression over the neighbours of a pixel.
struct Moments {
    std::array<float, layout::productCount> products{};
    std::array<vec3, features> sums{};

    void add(float weight, const std::array<float, features> &values, const vec3 &colour) {
        std::size_t next = 0;
        for (std::size_t m = 0; m < features; ++m) {
            const float weighted = weight * values[m];
            for (std::size_t l = 0; l <= m; ++l)
                products[next++] += weighted * values[l];
            sums[m] += weighted * colour;
        }
    }

    /// The value where all differences of features are 0: Gaussian elimination from the last feature to the constant.
    [[nodiscard]] vec3 solved() {
        const auto product = [this](std::size_t m, std::size_t l) -> float & {
            return products[m * (m + 1) / 2 + l];
        };
        const float ridge = products[0] * 1e-5f;
        for (std::size_t m = features - 1; m > 0; --m) {
            const float inverse = leaves::divide(1.0f, leaves::greater(product(m, m) + ridge, 1e-7f));
            for (std::size_t l = 0; l < m; ++l) {
                const float factor = product(m, l) * inverse;
                for (std::size_t k = 0; k <= l; ++k)
                    product(l, k) -= factor * product(m, k);
                sums[l] -= factor * sums[m];
            }
        }
        return sums[0] * leaves::divide(1.0f, leaves::greater(products[0], 1e-7f));
    }
};

/// The passes over a tile, one after the other. What they hand on is kept for all pixels.
class TileDenoiser {
  public:
    TileDenoiser(const NoisyPicture &tile, int threadCount)
        : noisy_(tile.pixels), width_(tile.width), height_(tile.height),
          threadCount_(threadCount > 0 ? threadCount : omp_get_max_threads()) {}

    [[nodiscard]] std::vector<vec3> denoised() {
        split_.resize(noisy_.size());
        forEach([this](int x, int y) { split(x, y); });
        variance_.resize(noisy_.size());
        forEach([this](int x, int y) { smoothVariance(x, y); });
        guides_.resize(noisy_.size());
        forEach([this](int x, int y) { makeGuides(x, y); });
        estimates_.resize(noisy_.size());
        errors_.resize(noisy_.size());
        forEach([this](int x, int y) { regress(x, y); });
        choices_.resize(noisy_.size());
        forEach([this](int x, int y) { choose(x, y); });
        std::vector<vec3> colours(noisy_.size());
        forEach([&](int x, int y) { colours[at(x, y)] = blended(x, y); });
        return colours;
    }

  private:
    /// The means of the two halves, without fireflies.
    struct Split {
        vec3 first;
        vec3 second;
        vec3 variance; ///< of the mean of all samples, if they were independent
        vec3 squares;  ///< the same, by the difference of the halves
    };

    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    /// The nearest pixel of the tile.
    [[nodiscard]] std::size_t near(int x, int y) const {
        return at(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1));
    }

    template <class Pass> void forEach(const Pass &pass) const {
#pragma omp parallel for schedule(dynamic, 4) num_threads(threadCount_)
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                pass(x, y);
    }

    /// Calls `take` with each pixel of the square, row by row.
    template <class Take> void around(int x, int y, int radius, const Take &take) const {
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx)
                take(near(x + dx, y + dy), dx, dy);
    }

    void split(int x, int y) {
        const NoisyPixel &pixel = noisy_[at(x, y)];
        float sum = 0.0f;
        vec3 largest(0.0f);
        around(x, y, layout::fireflyRadius, [&](std::size_t other, int dx, int dy) {
            if (dx == 0 && dy == 0)
                return;
            const float luminance = leaves::luminance(noisy_[other].colour);
            sum += luminance;
            largest = leaves::withLargest(largest, luminance);
        });
        const float secondShare = 1.0f - pixel.firstShare;
        const vec3 second =
            (pixel.colour - pixel.firstShare * pixel.first) * leaves::divide(1.0f, secondShare);
        const float apart = leaves::luminance(pixel.first - second);
        const float factor = leaves::fireflyFactor(
            leaves::luminance(pixel.colour), apart * apart * (pixel.firstShare * secondShare), sum, largest);
        Split &result = split_[at(x, y)];
        result.first = pixel.first * factor;
        result.second = second * factor;
        result.variance = pixel.variance * (factor * factor);
        const vec3 difference = result.first - result.second;
        result.squares = difference * difference * (pixel.firstShare * secondShare);
    }

    void smoothVariance(int x, int y) {
        vec3 squares(0.0f);
        vec3 variance(0.0f);
        around(x, y, layout::varianceRadius, [&](std::size_t other, int, int) {
            squares += split_[other].squares;
            variance += split_[other].variance;
        });
        const vec3 ratio(leaves::varianceRatio(squares.x, variance.x),
                         leaves::varianceRatio(squares.y, variance.y),
                         leaves::varianceRatio(squares.z, variance.z));
        variance_[at(x, y)] = split_[at(x, y)].variance * ratio + 1e-10f;
    }

    /// Means over 3 x 3 pixels, and the variance of the mean of all samples there.
    void makeGuides(int x, int y) {
        Split guide{};
        around(x, y, layout::guideRadius, [&](std::size_t other, int, int) {
            guide.first += split_[other].first;
            guide.second += split_[other].second;
            guide.variance += variance_[other];
        });
        guide.first *= 1.0f / 9.0f;
        guide.second *= 1.0f / 9.0f;
        guide.variance *= 1.0f / 81.0f;
        guides_[at(x, y)] = guide;
    }

    void regress(int x, int y) {
        const std::size_t own = at(x, y);
        const NoisyPixel &pixel = noisy_[own];
        // The variance of a half's mean is that of all samples' over its share.
        const float firstFactor = leaves::divide(1.0f, pixel.firstShare);
        const float secondFactor = leaves::divide(1.0f, 1.0f - pixel.firstShare);
        std::array<Moments, 2> firsts;  // of the first half, by weights of the second
        std::array<Moments, 2> seconds; // narrow, wide
        for (int dy = -layout::regressionRadius; dy <= layout::regressionRadius; ++dy)
            for (int dx = -layout::regressionRadius; dx <= layout::regressionRadius; ++dx) {
                if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_)
                    continue;
                const std::size_t other = at(x + dx, y + dy);
                const std::array<float, features> values = featuresOf(noisy_[other], pixel);
                const auto distance = [&](vec3 Split::*half, float factor) {
                    return leaves::jointDistance(
                        leaves::colourDistance(guides_[other].*half, guides_[own].*half,
                                               guides_[other].variance * factor,
                                               guides_[own].variance * factor),
                        leaves::colourDistance(split_[other].*half, split_[own].*half,
                                               variance_[other] * factor, variance_[own] * factor));
                };
                const float byFirst = leaves::wideWeight(distance(&Split::first, firstFactor));
                const float bySecond = leaves::wideWeight(distance(&Split::second, secondFactor));
                firsts[0].add(leaves::narrowWeight(bySecond), values, split_[other].first);
                firsts[1].add(bySecond, values, split_[other].first);
                seconds[0].add(leaves::narrowWeight(byFirst), values, split_[other].second);
                seconds[1].add(byFirst, values, split_[other].second);
            }
        const float shares = pixel.firstShare * (1.0f - pixel.firstShare);
        const Split &halves = split_[own];
        for (std::size_t i = 0; i < 2; ++i) {
            const vec3 first = firsts[i].solved();
            const vec3 second = seconds[i].solved();
            estimates_[own][i] = first * pixel.firstShare + second * (1.0f - pixel.firstShare);
            const vec3 difference = first - second;
            errors_[own][i] = leaves::relativeError(estimates_[own][i], halves.first, halves.second,
                                                    difference * difference * shares);
        }
        // Of the noisy colour itself, whose error and variance are one: the first term is minus that.
        estimates_[own][2] = halves.first * pixel.firstShare + halves.second * (1.0f - pixel.firstShare);
        errors_[own][2] = leaves::relativeError(estimates_[own][2], estimates_[own][2], halves.second,
                                                halves.squares * 0.5f);
    }

    static std::array<float, features> featuresOf(const NoisyPixel &neighbour, const NoisyPixel &own) {
        return {1.0f,
                leaves::featureDifference(neighbour.albedo.x, own.albedo.x),
                leaves::featureDifference(neighbour.albedo.y, own.albedo.y),
                leaves::featureDifference(neighbour.albedo.z, own.albedo.z),
                leaves::featureDifference(neighbour.normal.x, own.normal.x),
                leaves::featureDifference(neighbour.normal.y, own.normal.y),
                leaves::featureDifference(neighbour.normal.z, own.normal.z),
                leaves::depthDifference(neighbour.depth, own.depth)};
    }

    /// The estimate with the least error in the neighbourhood, which counts less the further it is.
    void choose(int x, int y) {
        std::array<float, estimateKinds> sums{};
        around(x, y, layout::errorRadius, [&](std::size_t other, int dx, int dy) {
            const auto weight = static_cast<float>((layout::errorRadius + 1 - std::abs(dx)) *
                                                   (layout::errorRadius + 1 - std::abs(dy)));
            for (std::size_t i = 0; i < estimateKinds; ++i)
                sums[i] += weight * errors_[other][i];
        });
        choices_[at(x, y)] = static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin());
    }

    /// The estimates by the shares of the neighbourhood that has chosen them; pixels without noise stay as they are.
    [[nodiscard]] vec3 blended(int x, int y) const {
        std::array<float, estimateKinds> counts{};
        around(x, y, layout::choiceRadius,
               [&](std::size_t other, int, int) { counts[choices_[other]] += 1.0f; });
        const std::array<vec3, estimateKinds> &estimates = estimates_[at(x, y)];
        if (leaves::isCertain(estimates[2], split_[at(x, y)].variance))
            return estimates[2];
        vec3 sum(0.0f);
        for (std::size_t i = 0; i < estimateKinds; ++i)
            sum += estimates[i] * counts[i];
        return leaves::greater(sum * (1.0f / 25.0f), vec3(0.0f));
    }

    const std::vector<NoisyPixel> &noisy_;
    int width_;
    int height_;
    int threadCount_;
    std::vector<Split> split_;
    std::vector<vec3> variance_; ///< of the mean of all samples
    std::vector<Split> guides_;
    std::vector<std::array<vec3, estimateKinds>> estimates_;
    std::vector<std::array<float, estimateKinds>> errors_;
    std::vector<std::size_t> choices_;
};

} // namespace

Image denoise(const NoisyPicture &picture, int threadCount, int tileSide) {
    return denoisedByTiles(picture, tileSide, [threadCount](const NoisyPicture &tile) {
        return TileDenoiser(tile, threadCount).denoised();
    });
}

} // namespace hyalite::core::reference
