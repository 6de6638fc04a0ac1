#include "host/jobs/film_picture.h"

#include "host/film/film_file.h"

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

std::vector<std::string> writeFilmPicture(AtomicFile &file, ImageFormat format, const FilmPicture &picture) {
    const Image image = picture.film.toImage();
    Picture all(image);
    const std::vector<float> alpha = alphasOf(picture.film, picture.views, picture.settings);
    all.alpha = alpha;
    all.wholeWidth = picture.wholeWidth;
    all.wholeHeight = picture.wholeHeight;
    all.crop = picture.film.crop;
    all.layers = filmLayers(picture.film);
    std::ranges::move(viewLayers(picture.views), std::back_inserter(all.layers));
    if (!picture.motion.empty())
        all.layers.push_back(motionLayer(picture.motion, picture.film.crop.width()));
    all.attributes = picture.attributes;
    if (format == ImageFormat::Exr)
        std::ranges::move(viewAttributes(picture.views), std::back_inserter(all.attributes));
    all.projection = picture.projection;
    std::vector<std::string> warnings =
        writeFilm(file, format, picture.film, all, picture.settings, picture.options);
    if (format != ImageFormat::Exr && !picture.film.lightPlanes.empty())
        warnings.push_back(
            fmt::format("'{}' has none of the layers of light: an .exr keeps them", file.path().string()));
    return warnings;
}

} // namespace hyalite::core
