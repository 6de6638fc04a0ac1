#include "host/jobs/film_picture.h"

#include "host/film/film_file.h"
#include "host/image/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace hyalite::core {

namespace {

/// By the letters of Blender's pass.
Layer motionLayer(std::span<const glm::vec4> motion, int width) {
    return {"vector", "XYZW", [motion, width = static_cast<std::size_t>(width)](int y, std::span<float> row) {
                const std::size_t first = static_cast<std::size_t>(y) * width;
                for (std::size_t i = 0; i < row.size(); ++i)
                    row[i] = motion[first + i / 4][static_cast<int>(i % 4)];
            }};
}

} // namespace

Layer noisyLayer(const Image &noisy) {
    return {std::string(noisyLayerName), "RGB", [&noisy](int y, std::span<float> row) {
                for (int x = 0; x < noisy.width(); ++x)
                    for (int channel = 0; channel < 3; ++channel)
                        row[static_cast<std::size_t>(3 * x + channel)] = noisy.at(x, y)[channel];
            }};
}

Drawing drawFilmPicture(const FilmPicture &picture) {
    const Image noisy = picture.film.toImage();
    Picture all(picture.clean != nullptr ? *picture.clean : noisy);
    const std::vector<float> alpha = alphasOf(picture.film, picture.views, picture.settings);
    all.alpha = alpha;
    return drawPicture(picture.film, all, picture.settings, picture.options.tone);
}

std::vector<std::string> lossesOf(const FilmPicture &picture, ImageFormat format, const std::string &name) {
    std::vector<std::string> losses;
    if (format != ImageFormat::Exr && !picture.film.lightPlanes.empty())
        losses.push_back(fmt::format("'{}' has none of the layers of light: an .exr keeps them", name));
    if (format != ImageFormat::Exr && picture.settings.hasDenoisingData &&
        keepsDenoisingData(picture.settings))
        losses.push_back(fmt::format("'{}' has none of the denoiser's data: an .exr keeps it", name));
    return losses;
}

std::vector<std::string> writeFilmPicture(AtomicFile &file, ImageFormat format, const FilmPicture &picture) {
    const Image noisy = picture.film.toImage();
    Picture all(picture.clean != nullptr ? *picture.clean : noisy);
    const std::vector<float> alpha = alphasOf(picture.film, picture.views, picture.settings);
    all.alpha = alpha;
    all.wholeWidth = picture.wholeWidth;
    all.wholeHeight = picture.wholeHeight;
    all.crop = picture.film.crop;
    all.layers = filmLayers(picture.film);
    const bool hasDenoisingData = haveDenoiserViews(picture.views);
    if (hasDenoisingData)
        std::ranges::move(firstSampleLayers(picture.film), std::back_inserter(all.layers));
    std::ranges::move(viewLayers(picture.views), std::back_inserter(all.layers));
    // Where the colours are others or rounded, the denoiser needs those of the film.
    const bool isRounded = picture.options.exr.isHalf || isLossy(picture.options.exr.compression);
    if (picture.clean != nullptr || (hasDenoisingData && isRounded))
        all.layers.push_back(noisyLayer(noisy));
    if (!picture.motion.empty())
        all.layers.push_back(motionLayer(picture.motion, picture.film.crop.width()));
    all.attributes = picture.attributes;
    if (format == ImageFormat::Exr)
        std::ranges::move(viewAttributes(picture.views), std::back_inserter(all.attributes));
    all.projection = picture.projection;
    std::vector<std::string> warnings =
        writeFilm(file, format, picture.film, all, picture.settings, picture.options);
    std::ranges::move(lossesOf(picture, format, file.path().string()), std::back_inserter(warnings));
    return warnings;
}

} // namespace hyalite::core
