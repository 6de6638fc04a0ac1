// Layers: views of primary hits, beside the colours of an EXR.
#pragma once

#include "host/engine/backend.h"
#include "host/film/view_film.h"
#include "host/image/picture.h"

#include <vector>

namespace hyalite::core {

/// A view to render beside a picture.
struct PictureView {
    Integrator view;
    bool isOfDenoiser = false;

    bool operator==(const PictureView &) const = default;
};

/// Those of a picture of `scene`: its layers, then those that the denoiser needs, if its settings keep them.
[[nodiscard]] std::vector<PictureView> viewsOf(const PreparedScene &scene);

/// The layers alone.
[[nodiscard]] std::vector<PictureView> layerViewsOf(const PreparedScene &scene);

/// The samples of a view for each pixel, of an image with these settings.
[[nodiscard]] int samplesOfView(const PictureView &view, const RenderSettings &ofImage);
[[nodiscard]] int samplesOfView(const ViewFilm &view, const RenderSettings &ofImage);

/// Renders the views, whose rows have layer channels, of `scene`. Depths become planar, along the view direction, and
/// 1e10 where nothing is met, as compositors have them; in a panorama they stay distances, and lengths of paths where
/// they look through. Pixels outside of the
/// squares stay black; empty: there are none. `begun` are films of the first views that have some samples, as of a
/// render that was stopped. Once the observer wants a stop, or the limit is reached, the rest gets no samples.
[[nodiscard]] std::vector<ViewFilm> renderViews(Backend &backend, const PreparedScene &scene,
                                                std::span<const PictureView> views,
                                                std::span<const Crop> squares, std::span<const Film> begun,
                                                Observer &observer, const TimeLimit &limit);

/// The alpha of each pixel of a film that was rendered with these settings, from 0 to 1: with the shadows on catchers,
/// if the view of those is among the `views`. A shadow is black: it adds no colour. Empty: all are opaque.
[[nodiscard]] std::vector<float> alphasOf(const Film &film, const std::vector<ViewFilm> &views,
                                          const RenderSettings &settings);

/// The value of a pixel in the layer of a view.
[[nodiscard]] glm::vec3 valueInLayer(Integrator view, const layout::FilmPixel &pixel);

/// The layer by the name of the view, with the channels of its row, except for depths: the channel Z, as compositors
/// know it; or those of a Cryptomatte. Normals are of unit length, but for means of those that look through; shadows are the share of a pixel that they hide.
/// Where a ray leaves the scene, values are 0, except for depths and occlusion. Those of the denoiser begin with
/// "denoising_". `film` must outlive the layers.
[[nodiscard]] std::vector<Layer> layersOf(const ViewFilm &film);
/// Those of all `films`.
[[nodiscard]] std::vector<Layer> viewLayers(const std::vector<ViewFilm> &films);

/// What a file says beside the layers: the attributes of Cryptomattes; of other views of numbers VIEW.names, a JSON
/// object of names by numbers.
[[nodiscard]] std::vector<Attribute> viewAttributes(const std::vector<ViewFilm> &films);

} // namespace hyalite::core
