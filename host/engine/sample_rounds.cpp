#include "host/engine/sample_rounds.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hyalite::core {

namespace {

constexpr int samplesBeforeFirstNoise = 64; // a guess

/// At the end of the render; noise falls as by independent samples.
double expectedSamplesOf(const Film &film, const NoiseBlock &block, const BlockNoise &noise,
                         const NoiseTarget &target) {
    double count = 0.0;
    for (std::size_t i = 0; i < block.pixelCount(); ++i)
        count += film.pixels[block.indexOf(i)].sampleCount;
    if (noise.state != BlockState::Unfinished)
        return count;
    const auto pixels = static_cast<double>(block.pixelCount());
    const double excess = noise.noise / target.noise;
    const double wanted =
        std::isfinite(excess) ? count * std::max(excess * excess, 1.0) : pixels * samplesBeforeFirstNoise;
    return std::min(wanted, pixels * target.maxSamples);
}

} // namespace

SampleRounds::SampleRounds(Film &film, const RenderSettings &settings)
    : settings_(settings),
      expectedSamples_(static_cast<double>(film.pixels.size()) * settings.samplesPerPixel) {
    film.wanted.resize(isAdaptive(settings) ? film.pixels.size() : 0);
    if (!isAdaptive(settings))
        return;
    const auto maxSamples = static_cast<std::uint32_t>(settings.samplesPerPixel);
    double own = 0.0;
    for (const NoiseBlock &block : blocksInFilm(film.crop, std::span(&film.crop, 1)))
        if (film.wanted[block.first] > 0 || film.pixels[block.first].sampleCount < maxSamples) {
            blocks_.push_back(block);
            own += static_cast<double>(block.pixelCount());
        }
    shareOfOthers_ = 1.0 - own / static_cast<double>(film.pixels.size());
    expectedSamples_ = own * std::min(settings.samplesPerPixel, samplesBeforeFirstNoise);
}

bool SampleRounds::begin(Film &film, const std::function<void(double)> &onNoise) {
    if (blocks_.empty())
        return false;
    const NoiseTarget target = noiseTargetOf(settings_);
    const std::vector<BlockNoise> noises = beginRounds(film, blocks_, target);
    double highest = 0.0;
    bool isMore = false;
    expectedSamples_ = 0.0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        expectedSamples_ += expectedSamplesOf(film, blocks_[i], noises[i], target);
        highest = std::max(highest, noises[i].noise);
        isMore = isMore || noises[i].state == BlockState::Unfinished;
    }
    if (onNoise && std::isfinite(highest))
        onNoise(highest);
    return isMore;
}

std::uint64_t SampleRounds::samplesIn(const Film &film) const {
    std::uint64_t count = 0;
    if (!isAdaptive(settings_)) {
        for (const layout::FilmPixel &pixel : film.pixels)
            count += std::min(pixel.sampleCount, static_cast<std::uint32_t>(settings_.samplesPerPixel));
        return count;
    }
    for (const NoiseBlock &block : blocks_)
        for (std::size_t i = 0; i < block.pixelCount(); ++i)
            count += film.pixels[block.indexOf(i)].sampleCount;
    return count;
}

double SampleRounds::share(double samples) {
    const double own = std::clamp(samples / expectedSamples_, 0.0, 1.0);
    share_ = std::max(share_, shareOfOthers_ + (1.0 - shareOfOthers_) * own);
    return share_;
}

} // namespace hyalite::core
