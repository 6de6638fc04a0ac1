#include "host/render/layers.h"

#include "host/film/partition.h"
#include "host/report/render_report.h"

#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite {

namespace {

/// The normal of a colour in the normal view.
glm::vec3 normalOf(const glm::vec3 &colour) {
    return colour == glm::vec3(0.0f) ? colour : 2.0f * colour - 1.0f;
}

Layer layerOf(const ViewFilm &of) {
    const Film &film = of.film;
    const bool isNormal = of.view == Integrator::Normal;
    const int channelCount = of.view == Integrator::Depth ? 1 : 3;
    const auto fillRow = [&film, isNormal, channelCount](int y, std::span<float> row) {
        float *next = row.data();
        for (const layout::FilmPixel &pixel : rowOf(film, y)) {
            const glm::vec3 mean = meanOf(pixel);
            const glm::vec3 value = isNormal ? normalOf(mean) : mean;
            for (int channel = 0; channel < channelCount; ++channel)
                *next++ = value[channel];
        }
    };
    // Compositors know the depth by the channel Z.
    const std::string name(of.view == Integrator::Depth ? "Z" : nameOf(of.view));
    return {name, channelCount == 1 ? "" : isNormal ? "XYZ" : "RGB", fillRow};
}

} // namespace

int samplesOfView(Integrator view, int samplesPerPixel) {
    return view == Integrator::Albedo ? samplesPerPixel : 1;
}

std::vector<ViewFilm> renderViews(Backend &backend, PreparedScene &scene,
                                  const std::vector<Integrator> &views, std::span<const Crop> squares,
                                  std::span<const Film> begun, bool isQuiet,
                                  const std::function<bool()> &shouldStop) {
    RenderSettings &settings = scene.loaded.scene.settings;
    const RenderSettings ofImage = settings;
    std::vector<ViewFilm> films;
    for (const Integrator view : views) {
        settings.integrator = view;
        settings.samplesPerPixel = samplesOfView(view, ofImage.samplesPerPixel);
        if (view != Integrator::Albedo)
            settings.sampler = SamplerKind::Centre;
        Continuation continuation;
        if (!squares.empty()) {
            continuation.film =
                filmOfSquares(scene.crop, squares, static_cast<std::uint32_t>(settings.samplesPerPixel));
            if (films.size() < begun.size())
                setPixelsIn(*continuation.film, squares, pixelsIn(begun[films.size()], squares));
            continuation.shareOfOthers = shareOutside(scene.crop, squares);
        }
        const bool isFinished =
            continuation.film &&
            finishedWork(*continuation.film, squares, settings.samplesPerPixel).isComplete;
        Film film(scene.crop);
        if (isFinished || shouldStop()) {
            if (continuation.film)
                film = std::move(*continuation.film);
        } else {
            BackendResult result = renderWithProgress(backend, scene, std::string(nameOf(view)), isQuiet,
                                                      nullptr, shouldStop, std::move(continuation));
            if (result.failure)
                throw Error(*result.failure);
            film = std::move(result.film);
        }
        films.push_back({view, std::move(film)});
        settings = ofImage;
    }
    return films;
}

std::vector<Layer> viewLayers(const std::vector<ViewFilm> &films) {
    std::vector<Layer> layers;
    layers.reserve(films.size());
    for (const ViewFilm &film : films)
        layers.push_back(layerOf(film));
    return layers;
}

} // namespace hyalite
