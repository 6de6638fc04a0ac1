// Layers: views of primary hits, beside the colours of an EXR.
#pragma once

#include "host/engine/backend.h"
#include "host/film/view_film.h"
#include "host/image/picture.h"

#include <array>
#include <vector>

namespace hyalite {

/// The views that a picture can have as layers.
inline constexpr std::array<Integrator, 4> layerViews{Integrator::Albedo, Integrator::Normal,
                                                      Integrator::Depth, Integrator::Id};

/// Renders the views of `scene`, and restores its settings. Depths become planar, along the view direction, and 1e10 where
/// nothing is met, as compositors have them; in a panorama they stay distances. Pixels outside of the squares stay black; empty: there are
/// none. `begun` are films of the first views that have some samples, as of a render that was stopped. Once the observer
/// wants a stop, or the limit is reached, the rest gets no samples.
[[nodiscard]] std::vector<ViewFilm> renderViews(Backend &backend, PreparedScene &scene,
                                                const std::vector<Integrator> &views,
                                                std::span<const Crop> squares, std::span<const Film> begun,
                                                Observer &observer, const TimeLimit &limit);

/// "albedo" RGB, "normal" XYZ of unit length, "depth" and "id" RGB, for the films that exist; all but depths
/// are 0 where a ray leaves the scene. `films` must outlive the layers.
[[nodiscard]] std::vector<Layer> viewLayers(const std::vector<ViewFilm> &films);

} // namespace hyalite
