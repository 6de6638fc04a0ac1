#include "host/jobs/denoising.h"

#include "host/base/error.h"
#include "host/film/first_samples.h"
#include "host/jobs/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace hyalite::core {

namespace {

/// Null: it is not among them.
const Film *denoiserView(const std::vector<ViewFilm> &views, Integrator view) {
    const auto film = std::ranges::find_if(
        views, [view](const ViewFilm &each) { return each.isOfDenoiser && each.view == view; });
    return film != views.end() ? &film->film : nullptr;
}

bool hasSamples(const Film &film) {
    return std::ranges::all_of(film.pixels, [](const auto &pixel) { return pixel.sampleCount > 0; });
}

[[noreturn]] void refuseWithout(const std::string &channel, std::string_view numbers,
                                const std::filesystem::path &path) {
    throw Error(
        ErrorKind::BadInput,
        fmt::format("cannot denoise '{}': it has no channel {} of {}", path.string(), channel, numbers),
        Remedy::DenoisingData);
}

const std::vector<std::uint32_t> &wholeValues(const ExrPicture &picture, const std::string &channel,
                                              const std::filesystem::path &path) {
    const ExrChannel *found = picture.find(channel);
    if (found == nullptr || found->wholeValues.empty())
        refuseWithout(channel, "whole numbers", path);
    return found->wholeValues;
}

/// The values of three channels, or of one, in a pixel.
class LayerValues {
  public:
    LayerValues(const ExrPicture &picture, const std::string &name, std::string_view channels,
                const std::filesystem::path &path) {
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const std::string channel = fmt::format("{}{}{}", name, name.empty() ? "" : ".", channels[i]);
            values_[i] = picture.find(channel);
            if (values_[i] == nullptr || values_[i]->values.empty())
                refuseWithout(channel, "floating-point numbers", path);
        }
    }
    [[nodiscard]] float one(std::size_t pixel) const { return values_[0]->values[pixel]; }
    [[nodiscard]] glm::vec3 three(std::size_t pixel) const {
        return {values_[0]->values[pixel], values_[1]->values[pixel], values_[2]->values[pixel]};
    }

  private:
    std::array<const ExrChannel *, 3> values_{};
};

} // namespace

bool isToBeDenoised(const RenderSettings &settings) {
    return settings.isDenoised && keepsDenoisingData(settings);
}

bool isDenoisable(const Film &film, const std::vector<ViewFilm> &views) {
    return hasFirst(film) && std::ranges::all_of(denoiserViews, [&](Integrator view) {
               const Film *of = denoiserView(views, view);
               return of != nullptr && hasSamples(*of);
           });
}

NoisyPicture noisyPictureOf(const Film &film, const std::vector<ViewFilm> &views) {
    const Film &albedo = *denoiserView(views, Integrator::Albedo);
    const Film &normal = *denoiserView(views, Integrator::Normal);
    const Film &depth = *denoiserView(views, Integrator::Depth);
    NoisyPicture picture{film.crop.width(), film.crop.height()};
    picture.pixels.reserve(film.pixels.size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        layout::NoisyPixel pixel{};
        pixel.colour = meanOf(film.pixels[i]);
        const MeanOfFirst &first = film.first[i].ofDenoiser();
        pixel.firstShare =
            static_cast<float>(first.sampleCount) / static_cast<float>(film.pixels[i].sampleCount);
        pixel.first = first.mean;
        pixel.variance = glm::vec3(varianceOfMean(film.pixels[i]));
        pixel.albedo = valueInLayer(Integrator::Albedo, albedo.pixels[i]);
        pixel.normal = valueInLayer(Integrator::Normal, normal.pixels[i]);
        pixel.depth = valueInLayer(Integrator::Depth, depth.pixels[i]).x;
        picture.pixels.push_back(pixel);
    }
    return picture;
}

NoisyPicture noisyPictureOf(const ExrPicture &picture, const std::filesystem::path &path) {
    const LayerValues colour(picture, picture.find("noisy.R") != nullptr ? "noisy" : "", "RGB", path);
    const LayerValues variance(picture, "variance", "RGB", path);
    const std::vector<std::uint32_t> &samples = wholeValues(picture, "samples.Y", path);
    const LayerValues first(picture, "denoising_first", "RGB", path);
    const std::vector<std::uint32_t> &firstSamples = wholeValues(picture, "denoising_first_samples.Y", path);
    const LayerValues albedo(picture, "denoising_albedo", "RGB", path);
    const LayerValues normal(picture, "denoising_normal", "XYZ", path);
    const LayerValues depth(picture, "denoising_depth", "Y", path);
    NoisyPicture noisy{picture.crop.width(), picture.crop.height()};
    noisy.pixels.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::uint32_t count = samples[i];
        const std::uint32_t firstCount = firstSamples[i];
        if (firstCount == 0 || firstCount >= count)
            throw Error(
                ErrorKind::BadInput,
                fmt::format("cannot denoise '{}': {} of the {} samples of its pixel {} are its first ones; "
                            "allowed: some, and not all. Finish its render",
                            path.string(), firstCount, count, i));
        layout::NoisyPixel pixel{};
        pixel.colour = colour.three(i);
        pixel.firstShare = static_cast<float>(firstCount) / static_cast<float>(count);
        pixel.first = first.three(i);
        pixel.variance = variance.three(i);
        pixel.albedo = albedo.three(i);
        pixel.normal = normal.three(i);
        pixel.depth = depth.one(i);
        noisy.pixels.push_back(pixel);
    }
    return noisy;
}

std::optional<Image> denoised(Backend &backend, const Film &film, const std::vector<ViewFilm> &views,
                              Observer &observer) {
    if (!isDenoisable(film, views)) {
        observer.warning("the picture stays noisy: not all pixels have the samples that the denoiser needs");
        return std::nullopt;
    }
    const ObservedTask task(observer, "denoise", backend.hasCompiler());
    return backend.denoise(noisyPictureOf(film, views));
}

std::uint64_t denoiserBytes(const Crop &crop) {
    constexpr std::uint64_t tileSide = denoiserTileSide + 2 * layout::denoiserMargin;
    constexpr std::uint64_t bytesInTile = 556; // of the denoiser, for each pixel
    const std::uint64_t pixels = crop.pixelCount();
    return pixels * (sizeof(layout::NoisyPixel) + sizeof(glm::vec3)) +
           std::min(pixels, tileSide * tileSide) * bytesInTile;
}

std::uint64_t denoisingBytes(const RenderSettings &settings, const Crop &crop, unsigned copies) {
    const std::uint64_t bytesEach = (keepsFirst(settings) ? sizeof(FirstSamples) : 0) +
                                    (isAdaptive(settings) ? sizeof(std::uint32_t) : 0);
    return crop.pixelCount() * bytesEach * copies + (isToBeDenoised(settings) ? denoiserBytes(crop) : 0);
}

} // namespace hyalite::core
