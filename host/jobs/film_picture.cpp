#include "host/jobs/film_picture.h"

#include "host/film/film_file.h"

#include <algorithm>
#include <iterator>

namespace hyalite::core {

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
    all.attributes = picture.attributes;
    if (format == ImageFormat::Exr)
        std::ranges::move(viewAttributes(picture.views), std::back_inserter(all.attributes));
    all.projection = picture.projection;
    return writeFilm(file, format, picture.film, all, picture.settings, picture.options);
}

} // namespace hyalite::core
