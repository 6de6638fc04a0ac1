#include "host/jobs/layers.h"

#include "host/film/partition.h"
#include "host/reference/closest_hit.h"
#include "host/report/render_report.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace hyalite::core {

namespace {

/// The normal of a colour in the normal view.
glm::vec3 normalOf(const glm::vec3 &colour) {
    return colour == glm::vec3(0.0f) ? colour : 2.0f * colour - 1.0f;
}

/// Makes planar depths of distances along rays, but in a panorama, which has no plane. `begun` has pixels whose depths
/// are planar already, or is null.
void flattenDepths(const PreparedScene &scene, const Film *begun, Film &film) {
    constexpr float ofNothing = 1e10f; // as Blender writes
    const reference::SceneView<float> view(scene.packed, layout::samplerCentre);
    const bool isFlat = scene.loaded.scene.camera.kind != CameraKind::Panorama;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(scene.packed.frame.imagePlane));
    const auto width = static_cast<std::size_t>(film.crop.width());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        layout::FilmPixel &pixel = film.pixels[i];
        if (pixel.sampleCount == 0 || (begun != nullptr && begun->pixels[i].sampleCount > 0))
            continue;
        const glm::uvec2 place(static_cast<std::size_t>(film.crop.x0) + i % width,
                               static_cast<std::size_t>(film.crop.y0) + i / width);
        const double along =
            isFlat ? glm::dot(glm::dvec3(reference::primaryRay(view, place, 0).direction), forward) : 1.0;
        const float distance = pixel.sum.x; // of the only sample
        const float depth = distance == 0.0f ? ofNothing : static_cast<float>(double{distance} * along);
        pixel.sum = glm::vec3(depth);
        pixel.sumOfSquares = glm::vec3(depth * depth);
        pixel.sumRest = pixel.squaresRest = glm::vec3(0.0f);
    }
}

Layer layerOf(const ViewFilm &of) {
    const Film &film = of.film;
    const IntegratorRow &view = rowOf(of.view);
    const bool isNormal = of.view == Integrator::Normal;
    const int channelCount = static_cast<int>(view.layerChannels.size());
    const auto fillRow = [&film, isNormal, channelCount](int y, std::span<float> row) {
        float *next = row.data();
        for (const layout::FilmPixel &pixel : rowOf(film, y)) {
            const glm::vec3 mean = meanOf(pixel);
            const glm::vec3 value = isNormal ? normalOf(mean) : mean;
            for (int channel = 0; channel < channelCount; ++channel)
                *next++ = value[channel];
        }
    };
    if (of.view == Integrator::Depth)
        return {std::string(view.layerChannels), "", fillRow};
    return {std::string(view.name), std::string(view.layerChannels), fillRow};
}

} // namespace

std::vector<ViewFilm> renderViews(Backend &backend, const PreparedScene &scene,
                                  const std::vector<Integrator> &views, std::span<const Crop> squares,
                                  std::span<const Film> begun, Observer &observer, const TimeLimit &limit) {
    const RenderSettings &ofImage = scene.loaded.settings;
    std::vector<ViewFilm> films;
    for (const Integrator view : views) {
        RenderSettings settings = ofImage;
        settings.integrator = view;
        settings.samplesPerPixel = samplesOfView(view, ofImage.samplesPerPixel);
        if (rowOf(view).isOfCentres)
            settings.sampler = SamplerKind::Centre;
        Film film(scene.crop);
        RenderTask task{.name = std::string(nameOf(view)), .limit = limit};
        bool isFinished = false;
        if (!squares.empty()) {
            film = filmOfSquares(scene.crop, squares, static_cast<std::uint32_t>(settings.samplesPerPixel));
            if (films.size() < begun.size())
                setPixelsIn(film, squares, pixelsIn(begun[films.size()], squares));
            task.shareOfOthers = shareOutside(scene.crop, squares);
            isFinished = finishedWork(film, squares, settings.samplesPerPixel).isComplete;
        }
        if (!isFinished && !observer.wantsStop() && !limit.isReached()) {
            film =
                unlessFailed(render(backend, scene.packed, settings, std::move(film), observer, task)).film;
            if (view == Integrator::Depth)
                flattenDepths(scene, films.size() < begun.size() ? &begun[films.size()] : nullptr, film);
        }
        films.push_back({view, std::move(film)});
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

} // namespace hyalite::core
