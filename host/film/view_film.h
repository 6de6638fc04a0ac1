// View films: what primary rays meet, beside the colours of a picture.
#pragma once

#include "host/film/film.h"
#include "host/scene/integrators.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace hyalite::core {

struct ViewFilm {
    Integrator view;
    Film film;
    std::vector<std::string> names{}; ///< of a view of numbers: that of number n is at n - 1
    /// Data of the denoiser, beside the layers of the picture: it looks through mirrors and glass.
    bool isOfDenoiser = false;
};

/// The views that the denoiser needs.
inline constexpr std::array denoiserViews{Integrator::Albedo, Integrator::Normal, Integrator::Depth};

/// Whether a layer of an image has one sample for each pixel, at its centre. A layer that looks through has those of the
/// image: it goes with the colours there, which are means over lens, filter and choices at glass.
[[nodiscard]] constexpr bool isOfCentres(Integrator view, bool areLayersThrough) {
    return rowOf(view).isOfCentres && !(areLayersThrough && rowOf(view).canLookThrough);
}

/// Whether the denoiser's views are among them.
[[nodiscard]] inline bool haveDenoiserViews(const std::vector<ViewFilm> &views) {
    return std::ranges::any_of(views, &ViewFilm::isOfDenoiser);
}

/// The samples of an image for its views: of an adaptive one, as many as most pixels need for them.
[[nodiscard]] constexpr int samplesForViews(int samplesPerPixel, double noise) {
    constexpr int samplesBesideNoise = 64;
    return noise > 0.0 ? std::min(samplesPerPixel, samplesBesideNoise) : samplesPerPixel;
}

/// The samples of a view for each pixel: those of the image, or the pixel's centre. Half as many, and a few, are
/// enough for the denoiser.
[[nodiscard]] constexpr int samplesOfView(Integrator view, int samplesPerPixel, bool areLayersThrough,
                                          bool isOfDenoiser = false) {
    constexpr int maxForDenoiser = 8;
    if (isOfDenoiser)
        return std::clamp(samplesPerPixel / 2, 1, maxForDenoiser);
    return isOfCentres(view, areLayersThrough) ? 1 : samplesPerPixel;
}

} // namespace hyalite::core
