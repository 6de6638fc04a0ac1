// Layers: what primary rays meet, beside the colours of an EXR.
#pragma once

#include "host/image/picture.h"
#include "host/render/backend.h"

#include <array>
#include <functional>
#include <vector>

namespace hyalite {

struct ViewFilm {
    Integrator view;
    Film film;
};

/// The views that a picture can have as layers.
inline constexpr std::array<Integrator, 4> layerViews{Integrator::Albedo, Integrator::Normal,
                                                      Integrator::Depth, Integrator::Id};

/// Renders the views of `scene`, whose settings are as they were afterwards: albedo by the same samples as the image, the
/// others through the centres of pixels, as means of depths or normals are those of no surface. Once `shouldStop` says so
/// the rest has no samples.
[[nodiscard]] std::vector<ViewFilm> renderViews(Backend &backend, PreparedScene &scene,
                                                const std::vector<Integrator> &views, bool isQuiet,
                                                const std::function<bool()> &shouldStop);

/// "albedo" RGB, "normal" XYZ of unit length, "depth" and "id" RGB, as far as they are there; all 0 where a ray meets
/// nothing. `films` must outlive the layers.
[[nodiscard]] std::vector<Layer> viewLayers(const std::vector<ViewFilm> &films);

} // namespace hyalite
