// View films: what primary rays meet, beside the colours of a picture.
#pragma once

#include "host/film/film.h"
#include "host/scene/integrators.h"

#include <string>
#include <vector>

namespace hyalite::core {

struct ViewFilm {
    Integrator view;
    Film film;
    std::vector<std::string> names{}; ///< of a view of numbers: that of number n is at n - 1
};

/// The samples of a view for each pixel: those of the image, or the pixel's centre.
[[nodiscard]] constexpr int samplesOfView(Integrator view, int samplesPerPixel) {
    return rowOf(view).isOfCentres ? 1 : samplesPerPixel;
}

} // namespace hyalite::core
