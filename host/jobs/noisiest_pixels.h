// The noisiest pixels of a picture by paths, and the path that made each of them so.
#pragma once

#include "host/engine/prepare.h"
#include "host/film/film.h"
#include "host/report/render_report.h"

#include <span>
#include <vector>

namespace hyalite::core {

/// The pixels with the largest relative variance of their mean, the noisiest first; of each the brightest sample, which is
/// traced once more by the CPU twin. Few of the pixels near another one, so that they tell of several places; none where
/// there is no noise, or with another integrator than Path. `squares` have samples.
[[nodiscard]] std::vector<NoisyPixelReport> noisiestPixels(const PreparedScene &scene, const Film &film,
                                                           std::span<const Crop> squares);

} // namespace hyalite::core
