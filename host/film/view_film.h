// View films: what primary rays meet, beside the colours of a picture.
#pragma once

#include "host/film/film.h"
#include "host/scene/integrators.h"

namespace hyalite::core {

struct ViewFilm {
    Integrator view;
    Film film;
};

/// The samples of a view for each pixel: those of the image, or the pixel's centre.
[[nodiscard]] constexpr int samplesOfView(Integrator view, int samplesPerPixel) {
    return rowOf(view).isOfCentres ? 1 : samplesPerPixel;
}

} // namespace hyalite::core
