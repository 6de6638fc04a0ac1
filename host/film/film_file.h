// Films as picture files, for each integrator.
#pragma once

#include "host/film/film.h"
#include "host/image/bitmap_text.h"
#include "host/image/image_file.h"
#include "host/scene/settings.h"

#include <string>
#include <vector>

namespace hyalite::core {

/// The attribute of a picture that is pixelHash() of the file's colours.
inline constexpr const char *pixelsAttribute = "pixels";

/// Average number of boxes and triangles that a sample of each pixel tests, from a film of the cost.
[[nodiscard]] std::vector<float> testsPerSample(const Film &cost);

/// The same in false colours, with a legend.
[[nodiscard]] Drawing drawCost(const Film &cost);

/// The picture without alpha, which is its composite over black: the tone-mapped means, or drawCost() for the cost.
[[nodiscard]] Drawing drawFilm(const Film &film, const RenderSettings &settings,
                               ToneCurve tone = ToneCurve::Gamma);
/// The same with these colours instead of the means.
[[nodiscard]] Drawing drawFilm(const Film &film, const Image &colours, const RenderSettings &settings,
                               ToneCurve tone);

/// The levels of its PNG, three of each pixel or, with alpha, four: pngLevels() of the film's `picture`, or drawCost().
[[nodiscard]] Drawing drawPicture(const Film &film, const Picture &picture, const RenderSettings &settings,
                                  ToneCurve tone);

/// writeImage() of the film's `picture`, or drawPicture() for a PNG, with the attribute "pixels", which is
/// pixelHash() of the file's colours. Returns and throws likewise.
std::vector<std::string> writeFilm(AtomicFile &file, ImageFormat format, const Film &film, Picture picture,
                                   const RenderSettings &settings, const FileOptions &options = {});

} // namespace hyalite::core
