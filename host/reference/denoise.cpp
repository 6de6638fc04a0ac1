#include "host/reference/denoise.h"

#include "host/leaves/leaves.h"

#include <glm/vec2.hpp>
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

using Model = std::array<vec3, features>; ///< a coefficient for each feature

/// The sums of a regression over the neighbours of an anchor.
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

    /// The coefficients: Gaussian elimination from the last feature to the constant, and back.
    [[nodiscard]] Model solved() {
        const auto product = [this](std::size_t m, std::size_t l) -> float & {
            return products[m * (m + 1) / 2 + l];
        };
        const float ridge = products[0] * 1e-5f;
        std::array<float, features> inverses{};
        for (std::size_t m = features - 1; m > 0; --m) {
            inverses[m] = leaves::divide(1.0f, leaves::greater(product(m, m) + ridge, 1e-7f));
            for (std::size_t l = 0; l < m; ++l) {
                const float factor = product(m, l) * inverses[m];
                for (std::size_t k = 0; k <= l; ++k)
                    product(l, k) -= factor * product(m, k);
                sums[l] -= factor * sums[m];
            }
        }
        inverses[0] = leaves::divide(1.0f, leaves::greater(products[0], 1e-7f));
        for (std::size_t m = 0; m < features; ++m) {
            for (std::size_t l = 0; l < m; ++l)
                sums[m] -= product(m, l) * sums[l];
            sums[m] *= inverses[m];
        }
        return sums;
    }
};

/// A pixel of a level, or of the mean of a block.
struct LevelPixel {
    float firstShare;
    vec3 first;
    vec3 second;
    vec3 variance;
    vec3 firstGuide;
    vec3 secondGuide;
    vec3 guideVariance;
    vec3 albedo;
    vec3 normal;
    float depth;

    /// By the first half of the samples, and by the second. The variance of a half's mean is that of all samples' over
    /// its share: `factors`, of both halves.
    [[nodiscard]] glm::vec2 distancesTo(const LevelPixel &other, const glm::vec2 &factors) const {
        const auto distance = [&](vec3 LevelPixel::*guide, vec3 LevelPixel::*half, float factor) {
            return leaves::jointDistance(
                leaves::colourDistance(this->*guide, other.*guide, guideVariance * factor,
                                       other.guideVariance * factor),
                leaves::colourDistance(this->*half, other.*half, variance * factor, other.variance * factor));
        };
        return {distance(&LevelPixel::firstGuide, &LevelPixel::first, factors.x),
                distance(&LevelPixel::secondGuide, &LevelPixel::second, factors.y)};
    }

    [[nodiscard]] glm::vec2 factors() const {
        return {leaves::divide(1.0f, firstShare), leaves::divide(1.0f, 1.0f - firstShare)};
    }

    /// By an anchor: a constant, and differences.
    [[nodiscard]] std::array<float, features> featuresBy(const LevelPixel &anchor) const {
        return {1.0f,
                leaves::featureDifference(albedo.x, anchor.albedo.x),
                leaves::featureDifference(albedo.y, anchor.albedo.y),
                leaves::featureDifference(albedo.z, anchor.albedo.z),
                leaves::featureDifference(normal.x, anchor.normal.x),
                leaves::featureDifference(normal.y, anchor.normal.y),
                leaves::featureDifference(normal.z, anchor.normal.z),
                leaves::depthDifference(depth, anchor.depth)};
    }
};

/// A model's colour for the features. Radiance is not negative.
vec3 colourBy(const Model &model, const std::array<float, features> &values) {
    vec3 colour = model[0];
    for (std::size_t m = 1; m < features; ++m)
        colour += values[m] * model[m];
    return leaves::greater(colour, vec3(0.0f));
}

/// The models of a fit at the anchors of its level.
struct Fit {
    int width;
    int height;
    std::array<std::vector<Model>, 2> models; ///< of the halves
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
        fine_.resize(noisy_.size());
        forEach([this](int x, int y) { makeFine(x, y); });
        makeCoarse();
        for (int kind = 0; kind < layout::fitCount; ++kind)
            fits_[static_cast<std::size_t>(kind)] = fitted(kind);
        estimates_.resize(noisy_.size());
        errors_.resize(noisy_.size());
        forEach([this](int x, int y) { estimate(x, y); });
        choices_.resize(noisy_.size());
        forEach([this](int x, int y) { choose(x, y); });
        counts_.resize(noisy_.size());
        forEach([this](int x, int y) { count(x, y); });
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

    template <class Pass> void forEach(const Pass &pass) const { forEach(width_, height_, pass); }

    template <class Pass> void forEach(int width, int height, const Pass &pass) const {
#pragma omp parallel for schedule(dynamic, 4) num_threads(threadCount_)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
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

    /// With means of the halves over 3 x 3 pixels, and the variance of the mean of all samples there.
    void makeFine(int x, int y) {
        const std::size_t own = at(x, y);
        const NoisyPixel &pixel = noisy_[own];
        LevelPixel fine{pixel.firstShare, split_[own].first, split_[own].second, variance_[own], vec3(0.0f),
                        vec3(0.0f),       vec3(0.0f),        pixel.albedo,       pixel.normal,   pixel.depth};
        around(x, y, layout::guideRadius, [&](std::size_t other, int, int) {
            fine.firstGuide += split_[other].first;
            fine.secondGuide += split_[other].second;
            fine.guideVariance += variance_[other];
        });
        fine.firstGuide *= 1.0f / 9.0f;
        fine.secondGuide *= 1.0f / 9.0f;
        fine.guideVariance *= 1.0f / 81.0f;
        fine_[own] = fine;
    }

    /// The means of blocks.
    void makeCoarse() {
        const int width = layout::levelSize(width_, layout::fitCoarse);
        const int height = layout::levelSize(height_, layout::fitCoarse);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int middleX = layout::blockSide * x + layout::blockSide / 2;
                const int middleY = layout::blockSide * y + layout::blockSide / 2;
                const LevelPixel &middle = fine_[near(middleX, middleY)];
                LevelPixel mean{0.0f,
                                middle.firstGuide,
                                middle.secondGuide,
                                middle.guideVariance,
                                middle.firstGuide,
                                middle.secondGuide,
                                middle.guideVariance,
                                vec3(0.0f),
                                vec3(0.0f),
                                0.0f};
                around(middleX, middleY, 1, [&](std::size_t other, int, int) {
                    mean.firstShare += fine_[other].firstShare;
                    mean.depth += fine_[other].depth;
                    mean.albedo += fine_[other].albedo;
                    mean.normal += fine_[other].normal;
                });
                mean.firstShare *= 1.0f / 9.0f;
                mean.depth *= 1.0f / 9.0f;
                mean.albedo *= 1.0f / 9.0f;
                mean.normal *= 1.0f / 9.0f;
                coarse_.push_back(mean);
            }
    }

    [[nodiscard]] const std::vector<LevelPixel> &levelOf(int kind) const {
        return kind == layout::fitCoarse ? coarse_ : fine_;
    }

    /// Of an anchor, in its level.
    [[nodiscard]] std::size_t placeOfAnchor(int x, int y, int kind) const {
        const int width = layout::levelSize(width_, kind);
        const int height = layout::levelSize(height_, kind);
        return static_cast<std::size_t>(std::min(layout::placeOfAnchor(y), height - 1) * width +
                                        std::min(layout::placeOfAnchor(x), width - 1));
    }

    [[nodiscard]] Fit fitted(int kind) const {
        const int width = layout::levelSize(width_, kind);
        const int height = layout::levelSize(height_, kind);
        Fit fit{layout::anchorCount(width), layout::anchorCount(height), {}};
        for (std::vector<Model> &models : fit.models)
            models.resize(static_cast<std::size_t>(fit.width * fit.height));
        const std::vector<LevelPixel> &level = levelOf(kind);
        const int radius = layout::fitRadius(kind);
        forEach(fit.width, fit.height, [&](int anchorX, int anchorY) {
            const std::size_t place = placeOfAnchor(anchorX, anchorY, kind);
            const int x = static_cast<int>(place) % width;
            const int y = static_cast<int>(place) / width;
            const LevelPixel &anchor = level[place];
            const glm::vec2 factors = anchor.factors();
            std::array<Moments, 2> halves;
            for (int otherY = std::max(y - radius, 0); otherY <= std::min(y + radius, height - 1); ++otherY)
                for (int otherX = std::max(x - radius, 0); otherX <= std::min(x + radius, width - 1);
                     ++otherX) {
                    const LevelPixel &other = level[static_cast<std::size_t>(otherY * width + otherX)];
                    const std::array<float, features> values = other.featuresBy(anchor);
                    const glm::vec2 distances =
                        layout::sharpnessOf(kind) * other.distancesTo(anchor, factors);
                    halves[0].add(leaves::weightOf(distances.y), values, other.first);
                    halves[1].add(leaves::weightOf(distances.x), values, other.second);
                }
            for (std::size_t half = 0; half < 2; ++half)
                fit.models[half][static_cast<std::size_t>(anchorY * fit.width + anchorX)] =
                    halves[half].solved();
        });
        return fit;
    }

    /// What the models of the four nearest anchors say of the pixel, for both halves: means by how near and how alike
    /// they are, and a little of its own colour.
    [[nodiscard]] std::array<vec3, 2> halvesBy(int kind, int x, int y) const {
        const LevelPixel &pixel = fine_[at(x, y)];
        const glm::vec2 factors = pixel.factors();
        const Fit &fit = fits_[static_cast<std::size_t>(kind)];
        const int step = layout::anchorStep(kind);
        const int alongX = x - layout::firstAnchor(kind) + step; // from the anchor before the tile
        const int alongY = y - layout::firstAnchor(kind) + step;
        const float inverse = leaves::divide(1.0f, static_cast<float>(step));
        const float beyondX = static_cast<float>(alongX % step) * inverse;
        const float beyondY = static_cast<float>(alongY % step) * inverse;
        glm::vec2 weights(layout::ownWeight);
        std::array<vec3, 2> halves{pixel.first * layout::ownWeight, pixel.second * layout::ownWeight};
        for (int i = 0; i < 4; ++i) {
            const int sideX = i & 1;
            const int sideY = i >> 1;
            const int anchorX = std::clamp(alongX / step - 1 + sideX, 0, fit.width - 1);
            const int anchorY = std::clamp(alongY / step - 1 + sideY, 0, fit.height - 1);
            const LevelPixel &anchor = levelOf(kind)[placeOfAnchor(anchorX, anchorY, kind)];
            const float nearness =
                (sideX == 1 ? beyondX : 1.0f - beyondX) * (sideY == 1 ? beyondY : 1.0f - beyondY);
            const glm::vec2 distances = layout::sharpnessOf(kind) * pixel.distancesTo(anchor, factors);
            const glm::vec2 weight =
                nearness * glm::vec2(leaves::weightOf(distances.y), leaves::weightOf(distances.x));
            const std::array<float, features> values = pixel.featuresBy(anchor);
            const auto model = static_cast<std::size_t>(anchorY * fit.width + anchorX);
            weights += weight;
            halves[0] += weight.x * colourBy(fit.models[0][model], values);
            halves[1] += weight.y * colourBy(fit.models[1][model], values);
        }
        return {halves[0] * leaves::divide(1.0f, weights.x), halves[1] * leaves::divide(1.0f, weights.y)};
    }

    void estimate(int x, int y) {
        const std::size_t own = at(x, y);
        const LevelPixel &pixel = fine_[own];
        const float secondShare = 1.0f - pixel.firstShare;
        const vec3 noisy = pixel.first * pixel.firstShare + pixel.second * secondShare;
        const float limit =
            leaves::errorLimit(leaves::luminance(noisy), leaves::luminance(split_[own].variance));
        std::array<vec3, estimateKinds> &estimates = estimates_[own];
        for (int kind = 0; kind < layout::fitCount; ++kind) {
            const auto [first, second] = halvesBy(kind, x, y);
            const auto i = static_cast<std::size_t>(kind);
            estimates[i] = first * pixel.firstShare + second * secondShare;
            const vec3 difference = first - second;
            errors_[own][i] =
                leaves::relativeError(estimates[i], pixel.first, pixel.second,
                                      difference * difference * (pixel.firstShare * secondShare),
                                      estimates[layout::fitWide], limit);
        }
        // Of the noisy colour itself, whose error and variance are one: the first term is minus that.
        estimates[layout::estimateNoisy] = noisy;
        errors_[own][layout::estimateNoisy] = leaves::relativeError(
            noisy, noisy, pixel.second, split_[own].squares * 0.5f, estimates[layout::fitWide], limit);
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

    /// How many pixels of the neighbourhood have chosen each estimate.
    void count(int x, int y) {
        around(x, y, layout::choiceRadius,
               [&](std::size_t other, int, int) { counts_[at(x, y)][choices_[other]] += 1.0f; });
    }

    /// The estimates by how many of the neighbourhood have chosen them, the noisy colour only where many have; pixels
    /// without noise stay as they are.
    [[nodiscard]] vec3 blended(int x, int y) const {
        const std::array<vec3, estimateKinds> &estimates = estimates_[at(x, y)];
        const vec3 &noisy = estimates[layout::estimateNoisy];
        const LevelPixel &pixel = fine_[at(x, y)];
        const vec3 mean = pixel.firstGuide * pixel.firstShare + pixel.secondGuide * (1.0f - pixel.firstShare);
        if (leaves::isCertain(noisy, split_[at(x, y)].variance, mean))
            return noisy;
        float noisyCount = 0.0f;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                noisyCount += counts_[near(x + layout::spreadRadius * dx, y + layout::spreadRadius * dy)]
                                     [layout::estimateNoisy];
        std::array<float, estimateKinds> weights = counts_[at(x, y)];
        weights[layout::estimateNoisy] *= leaves::noisyFactor(noisyCount);
        vec3 sum(0.0f);
        float total = 0.0f;
        for (std::size_t i = 0; i < estimateKinds; ++i) {
            sum += estimates[i] * weights[i];
            total += weights[i];
        }
        return leaves::greater(sum * leaves::divide(1.0f, total), vec3(0.0f));
    }

    const std::vector<NoisyPixel> &noisy_;
    int width_;
    int height_;
    int threadCount_;
    std::vector<Split> split_;
    std::vector<vec3> variance_; ///< of the mean of all samples
    std::vector<LevelPixel> fine_;
    std::vector<LevelPixel> coarse_;
    std::array<Fit, layout::fitCount> fits_{};
    std::vector<std::array<vec3, estimateKinds>> estimates_;
    std::vector<std::array<float, estimateKinds>> errors_;
    std::vector<std::size_t> choices_;
    std::vector<std::array<float, estimateKinds>> counts_;
};

} // namespace

Image denoise(const NoisyPicture &picture, int threadCount, int tileSide) {
    return denoisedByTiles(picture, tileSide, [threadCount](const NoisyPicture &tile) {
        return TileDenoiser(tile, threadCount).denoised();
    });
}

} // namespace hyalite::core::reference
