// Films as picture files: what the numbers of each integrator look like.
#pragma once

#include "host/film/film.h"
#include "host/image/bitmap_text.h"
#include "host/image/image_file.h"
#include "host/scene/scene.h"

#include <vector>

namespace hyalite {

/// Boxes and triangles that a sample of each pixel tests, on average, from a film of the cost.
[[nodiscard]] std::vector<float> testsPerSample(const Film &cost);

/// The same in false colours, with a legend.
[[nodiscard]] Drawing drawCost(const Film &cost);

/// What a PNG shows: the means, tone-mapped; but of the cost, drawCost().
[[nodiscard]] Drawing drawFilm(const Film &film, const RenderSettings &settings);

/// writeImage() of the film's `picture`; but a PNG of the cost is drawCost(). Throws likewise.
void writeFilm(AtomicFile &file, ImageFormat format, const Film &film, const Picture &picture,
               const RenderSettings &settings, ToneCurve tone = ToneCurve::Gamma);

} // namespace hyalite
