#include "host/jobs/film_picture.h"

#include "host/film/film_file.h"

#include <algorithm>
#include <iterator>

namespace hyalite::core {

void writeFilmPicture(AtomicFile &file, ImageFormat format, const FilmPicture &picture) {
    const Image image = picture.film.toImage();
    Picture all(image);
    all.wholeWidth = picture.wholeWidth;
    all.wholeHeight = picture.wholeHeight;
    all.crop = picture.film.crop;
    all.layers = filmLayers(picture.film);
    std::ranges::move(viewLayers(picture.views), std::back_inserter(all.layers));
    all.attributes = picture.attributes;
    writeFilm(file, format, picture.film, all, picture.settings, picture.tone);
}

} // namespace hyalite::core
