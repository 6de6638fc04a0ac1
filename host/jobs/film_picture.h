// The picture file of a rendered film.
#pragma once

#include "host/image/image_file.h"
#include "host/jobs/layers.h"

#include <vector>

namespace hyalite::core {

/// A film, and what its file has beside its pixels. All that it refers to must outlive it.
struct FilmPicture {
    const Film &film;
    const std::vector<ViewFilm> &views;
    int wholeWidth = 0; ///< of the image that the film's crop is part of
    int wholeHeight = 0;
    std::vector<Attribute> attributes{};
    RenderSettings settings{};
    ToneCurve tone = ToneCurve::Gamma;
};

/// Writes it with its views and the layers of the film; the caller commits the file. Throws as writeImage() does.
void writeFilmPicture(AtomicFile &file, ImageFormat format, const FilmPicture &picture);

} // namespace hyalite::core
