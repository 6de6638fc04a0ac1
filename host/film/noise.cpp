#include "host/film/noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hyalite::core {

namespace {

constexpr std::uint32_t samplesOfFirstRound = 16;
constexpr double growthOfRound = 1.25;
constexpr int neighbourRadius = 3;
constexpr double fastestDecay = 0.2871745887492587; // 2^-1.8, of the variance when samples are doubled
constexpr double slowestDecay = 0.5;                // as of independent samples
constexpr int bisections = 48;

/// A value for each pixel of a block.
using Values = std::vector<double>;

/// The mean of a pixel's neighbours in the block, up to `neighbourRadius` away, without its own value; its own if it has
/// none.
Values meansOfNeighbours(const Values &values, const NoiseBlock &block) {
    const auto width = static_cast<int>(block.width);
    const auto height = static_cast<int>(block.height);
    const auto at = [width](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    Values rows(values.size());   // sums over each row's window
    Values others(values.size()); // the same without the value in the middle
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int other = std::max(x - neighbourRadius, 0);
                 other <= std::min(x + neighbourRadius, width - 1); ++other)
                sum += other == x ? 0.0 : values[at(other, y)];
            others[at(x, y)] = sum;
            rows[at(x, y)] = sum + values[at(x, y)];
        }
    Values means(values.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int top = std::max(y - neighbourRadius, 0);
            const int bottom = std::min(y + neighbourRadius, height - 1);
            double sum = others[at(x, y)];
            for (int other = top; other <= bottom; ++other)
                sum += other == y ? 0.0 : rows[at(x, other)];
            const int columns =
                std::min(x + neighbourRadius, width - 1) - std::max(x - neighbourRadius, 0) + 1;
            const int count = columns * (bottom - top + 1) - 1;
            means[at(x, y)] = count > 0 ? sum / count : values[at(x, y)];
        }
    return means;
}

/// The variance of the mean of n samples in that of one sample, if doubling the samples multiplies it by `decay`.
double shareOfVariance(std::uint32_t n, double decay) {
    double share = 1.0;
    for (int doublings = std::bit_width(n) - 1; doublings > 0; --doublings)
        share *= decay;
    const double beyond = static_cast<double>(n) / std::bit_floor(n); // in [1, 2)
    return share * (2.0 - beyond + (beyond - 1.0) * 2.0 * decay) / beyond;
}

/// Pixels that have as many samples, and as many first ones.
struct CountGroup {
    std::uint32_t first;
    std::uint32_t all;
    double variance; ///< of single samples, summed
};

/// What is known of a block's noise. Variances are relative, and means over channels.
struct BlockStatistics {
    Values sampleVariance; ///< of a pixel's single samples
    std::vector<CountGroup> groups;
    double squaredDifference = 0.0; ///< of first samples and all, summed

    BlockStatistics(const FilmRecords &film, const NoiseBlock &block, double darkness)
        : sampleVariance(block.pixelCount()) {
        Values squaredDifferences(block.pixelCount());
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            Values mean(block.pixelCount());
            for (std::size_t i = 0; i < mean.size(); ++i) {
                const layout::FilmPixel &pixel = film.pixels[block.indexOf(i)];
                const double value = sumOf(pixel)[channel] / pixel.sampleCount;
                mean[i] = std::isfinite(value) ? value : 0.0;
            }
            const Values around = meansOfNeighbours(mean, block);
            for (std::size_t i = 0; i < mean.size(); ++i) {
                const layout::FilmPixel &pixel = film.pixels[block.indexOf(i)];
                const double brightness = std::abs(mean[i]);
                const double variance = varianceOfMean(pixel)[channel];
                const double seen =
                    std::max(std::min(brightness, std::abs(around[i])), brightness - std::sqrt(variance));
                const double weight = 1.0 / (3.0 * (seen * seen + darkness * darkness));
                const double difference =
                    film.first.empty()
                        ? 0.0
                        : static_cast<double>(film.first[block.indexOf(i)].mean[channel]) - mean[i];
                sampleVariance[i] += weight * variance * pixel.sampleCount;
                squaredDifferences[i] += weight * difference * difference;
            }
        }
        for (std::size_t i = 0; i < sampleVariance.size(); ++i) {
            if (!std::isfinite(sampleVariance[i]) || !std::isfinite(squaredDifferences[i]))
                sampleVariance[i] = squaredDifferences[i] = 0.0;
            squaredDifference += squaredDifferences[i];
            addToGroup(film.first.empty() ? 0 : film.first[block.indexOf(i)].sampleCount,
                       film.pixels[block.indexOf(i)].sampleCount, sampleVariance[i]);
        }
    }

    void addToGroup(std::uint32_t first, std::uint32_t all, double variance) {
        const auto group = std::ranges::find_if(
            groups, [=](const CountGroup &each) { return each.first == first && each.all == all; });
        if (group != groups.end())
            group->variance += variance;
        else
            groups.push_back({first, all, variance});
    }

    /// The squared difference that is expected.
    [[nodiscard]] double differenceBy(double decay) const {
        double sum = 0.0;
        for (const CountGroup &group : groups)
            sum += group.variance * (shareOfVariance(group.first, decay) - shareOfVariance(group.all, decay));
        return sum;
    }

    /// Of the variance when samples are doubled. A few pixels say little of it: as if there were some more, of independent
    /// samples.
    [[nodiscard]] double decay() const {
        constexpr double independentPixels = 16.0;
        const double prior = independentPixels / static_cast<double>(sampleVariance.size());
        const double found = squaredDifference + prior * differenceBy(slowestDecay);
        double low = fastestDecay;
        double high = slowestDecay;
        for (int i = 0; i < bisections; ++i) {
            const double middle = 0.5 * (low + high);
            ((1.0 + prior) * differenceBy(middle) < found ? low : high) = middle;
        }
        return high;
    }

    [[nodiscard]] double noise() const {
        const double decayOfBlock = decay();
        double sum = 0.0;
        for (const CountGroup &group : groups)
            sum += group.variance * shareOfVariance(group.all, decayOfBlock);
        return std::sqrt(sum / static_cast<double>(sampleVariance.size()));
    }
};

/// The counts that pixels may have: 16, 24, 32, 48, 64, 96 ... More than any other count, too, that a file may have.
std::uint32_t nextCount(std::uint32_t count) {
    return std::max(count + 1, std::has_single_bit(count) ? count / 2 * 3 : count / 3 * 4);
}

/// The factor of `needs` by which `counts`, of which none falls, sum up to `total`.
double factorFor(double total, const Values &needs, std::span<const double> counts) {
    double sum = 0.0;
    for (const double need : needs)
        sum += need;
    double low = 0.0;
    double high = total / sum;
    for (int i = 0; i < bisections; ++i) {
        const double middle = 0.5 * (low + high);
        double reached = 0.0;
        for (std::size_t pixel = 0; pixel < needs.size(); ++pixel)
            reached += std::max(counts[pixel], middle * needs[pixel]);
        (reached < total ? low : high) = middle;
    }
    return high;
}

/// The blocks of a square whose pixels are `first` and later ones, row by row of `whole`.
void addBlocks(const Crop &square, const Crop &whole, std::size_t first, std::vector<NoiseBlock> &blocks) {
    for (int y = square.y0; y < square.y1; y += noiseBlockSide)
        for (int x = square.x0; x < square.x1; x += noiseBlockSide)
            blocks.push_back({first + whole.indexOf(x, y), static_cast<std::size_t>(whole.width()),
                              static_cast<std::size_t>(std::min(noiseBlockSide, square.x1 - x)),
                              static_cast<std::size_t>(std::min(noiseBlockSide, square.y1 - y))});
}

bool hasFirstSamples(const FilmRecords &film, const NoiseBlock &block) {
    for (std::size_t i = 0; i < block.pixelCount(); ++i) {
        const std::size_t pixel = block.indexOf(i);
        const std::uint32_t first = film.first.empty() ? 0 : film.first[pixel].sampleCount;
        if (first == 0 || first >= film.pixels[pixel].sampleCount)
            return false;
    }
    return true;
}

/// Whether all pixels have the samples of the present round.
bool isRoundFinished(const FilmRecords &film, const NoiseBlock &block, std::uint32_t maxSamples) {
    if (film.wanted.empty() || film.wanted[block.first] == 0)
        return false;
    for (std::size_t i = 0; i < block.pixelCount(); ++i) {
        const std::size_t pixel = block.indexOf(i);
        if (film.pixels[pixel].sampleCount < targetOf(film, pixel, maxSamples))
            return false;
    }
    return true;
}

BlockState stateAt(double noise, const FilmRecords &film, const NoiseBlock &block,
                   const NoiseTarget &target) {
    if (!isRoundFinished(film, block, target.maxSamples))
        return BlockState::Unfinished;
    if (noise <= target.noise)
        return BlockState::AtTarget;
    for (std::size_t i = 0; i < block.pixelCount(); ++i)
        if (film.wanted[block.indexOf(i)] >= target.maxSamples)
            return BlockState::AtLimit;
    return BlockState::Unfinished;
}

/// The next round, by the variances of single samples.
void wantMore(FilmRecords &film, const NoiseBlock &block, const Values &sampleVariance) {
    const std::size_t pixelCount = block.pixelCount();
    Values needs = meansOfNeighbours(sampleVariance, block);
    Values counts(pixelCount);
    double sumOfNeeds = 0.0;
    double sumOfCounts = 0.0;
    for (std::size_t i = 0; i < pixelCount; ++i) {
        needs[i] = std::sqrt(needs[i]);
        counts[i] = film.wanted[block.indexOf(i)];
        sumOfNeeds += needs[i];
        sumOfCounts += counts[i];
    }
    const double leastNeed = 0.25 * sumOfNeeds / static_cast<double>(pixelCount);
    for (double &need : needs)
        need = std::max(need, leastNeed);
    const double factor = factorFor(growthOfRound * sumOfCounts, needs, counts);
    bool isMore = false;
    for (std::size_t i = 0; i < pixelCount; ++i) {
        std::uint32_t &wanted = film.wanted[block.indexOf(i)];
        const double most = std::min(factor * needs[i], 4.0 * counts[i]);
        while (wanted < 0.9 * most) { // the nearest count is near enough
            wanted = nextCount(wanted);
            isMore = true;
        }
    }
    if (!isMore) // all need as little more
        for (std::size_t i = 0; i < pixelCount; ++i)
            film.wanted[block.indexOf(i)] = nextCount(film.wanted[block.indexOf(i)]);
}

/// As beginRounds().
BlockNoise beginRound(FilmRecords &film, const NoiseBlock &block, const NoiseTarget &target) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (film.wanted[block.first] == 0) {
        for (std::size_t i = 0; i < block.pixelCount(); ++i)
            film.wanted[block.indexOf(i)] = samplesOfFirstRound;
        return {unknown, BlockState::Unfinished};
    }
    if (!hasFirstSamples(film, block)) // of one sample each
        return {unknown, stateAt(unknown, film, block, target)};
    const BlockStatistics statistics(film, block, target.darkness);
    const double noise = statistics.noise();
    const BlockState state = stateAt(noise, film, block, target);
    if (state == BlockState::Unfinished)
        wantMore(film, block, statistics.sampleVariance);
    return {noise, state};
}

} // namespace

int stopsOfDarkness(const RenderSettings &settings) {
    return static_cast<int>(std::lround(settings.exposureStops));
}

double darknessOf(const RenderSettings &settings) {
    constexpr double darkness = 0.1; // of a picture whose white is 1
    return std::ldexp(darkness, -stopsOfDarkness(settings));
}

NoiseTarget noiseTargetOf(const RenderSettings &settings) {
    return {settings.noise, darknessOf(settings), static_cast<std::uint32_t>(settings.samplesPerPixel)};
}

std::vector<NoiseBlock> blocksInFilm(const Crop &film, std::span<const Crop> squares) {
    std::vector<NoiseBlock> blocks;
    for (const Crop &square : squares)
        addBlocks(square, film, 0, blocks);
    return blocks;
}

std::vector<NoiseBlock> blocksInRecords(std::span<const Crop> squares) {
    std::vector<NoiseBlock> blocks;
    std::size_t before = 0;
    for (const Crop &square : squares) {
        addBlocks(square, square, before, blocks);
        before += square.pixelCount();
    }
    return blocks;
}

BlockNoise noiseOf(const FilmRecords &film, const NoiseBlock &block, const NoiseTarget &target) {
    const double noise = hasFirstSamples(film, block) ? BlockStatistics(film, block, target.darkness).noise()
                                                      : std::numeric_limits<double>::infinity();
    return {noise, stateAt(noise, film, block, target)};
}

std::vector<double> squaredNoiseOfPixels(const FilmRecords &film, const NoiseBlock &block, double darkness) {
    Values noises = BlockStatistics(film, block, darkness).sampleVariance;
    for (std::size_t i = 0; i < noises.size(); ++i) {
        const std::uint32_t count = film.pixels[block.indexOf(i)].sampleCount;
        noises[i] = count > 1 ? noises[i] / count : 0.0;
    }
    return noises;
}

std::vector<BlockNoise> beginRounds(FilmRecords &film, std::span<const NoiseBlock> blocks,
                                    const NoiseTarget &target) {
    std::vector<BlockNoise> noises(blocks.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < blocks.size(); ++i)
        noises[i] = beginRound(film, blocks[i], target);
    return noises;
}

PictureNoise noiseOf(const FilmRecords &film, std::span<const NoiseBlock> blocks, const NoiseTarget &target) {
    std::vector<BlockNoise> noises(blocks.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < blocks.size(); ++i)
        noises[i] = noiseOf(film, blocks[i], target);
    PictureNoise picture;
    double sum = 0.0;
    double pixelCount = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const auto &[noise, state] = noises[i];
        picture.highest = std::max(picture.highest, noise);
        picture.atTarget += state == BlockState::AtTarget ? 1 : 0;
        picture.atLimit += state == BlockState::AtLimit ? 1 : 0;
        picture.finishedPixels += state != BlockState::Unfinished ? blocks[i].pixelCount() : 0;
        sum += noise * noise * static_cast<double>(blocks[i].pixelCount());
        pixelCount += static_cast<double>(blocks[i].pixelCount());
    }
    picture.blockCount = blocks.size();
    picture.mean = pixelCount > 0.0 ? std::sqrt(sum / pixelCount) : 0.0;
    return picture;
}

} // namespace hyalite::core
