// View films: what primary rays meet, beside the colours of a picture.
#pragma once

#include "host/film/film.h"
#include "host/scene/integrators.h"

namespace hyalite {

struct ViewFilm {
    Integrator view;
    Film film;
};

/// The samples of a view for each pixel: those of the image for albedo, and pixel centres for the others, because a mean of
/// depths or normals belongs to no surface.
[[nodiscard]] constexpr int samplesOfView(Integrator view, int samplesPerPixel) {
    return view == Integrator::Albedo ? samplesPerPixel : 1;
}

} // namespace hyalite
