#include "host/jobs/layers.h"

#include "host/film/partition.h"
#include "host/jobs/cryptomatte.h"
#include "host/reference/closest_hit.h"
#include "host/report/render_report.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>

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

/// The share of a pixel that a shadow hides: that of the catcher, times the share of its light that is blocked.
float shadowOf(const layout::FilmPixel &pixel) {
    const glm::dvec3 sum = sumOf(pixel);
    return sum.z > 0.0 ? static_cast<float>(sum.x / pixel.sampleCount * (sum.z / sum.y)) : 0.0f;
}

Layer layerOf(const ViewFilm &of) {
    const Film &film = of.film;
    const IntegratorRow &row = rowOf(of.view);
    const int channelCount = static_cast<int>(row.layerChannels.size());
    const auto fillRow = [&film, view = of.view, channelCount](int y, std::span<float> values) {
        float *next = values.data();
        for (const layout::FilmPixel &pixel : rowOf(film, y)) {
            const glm::vec3 value = valueInLayer(view, pixel);
            for (int channel = 0; channel < channelCount; ++channel)
                *next++ = value[channel];
        }
    };
    if (of.isOfDenoiser)
        return {fmt::format("denoising_{}", row.name),
                of.view == Integrator::Depth ? "Y" : std::string(row.layerChannels), fillRow};
    if (of.view == Integrator::Depth)
        return {std::string(row.layerChannels), "", fillRow};
    Layer layer{std::string(row.name), std::string(row.layerChannels), fillRow};
    layer.isLight = of.view == Integrator::Albedo || of.view == Integrator::AmbientOcclusion ||
                    of.view == Integrator::Shadow;
    if (row.isOfNumbers())
        layer.fillWholeRow = [&film](int y, std::span<std::uint32_t> values) {
            std::ranges::transform(rowOf(film, y), values.begin(), [](const layout::FilmPixel &pixel) {
                return static_cast<std::uint32_t>(meanOf(pixel).x);
            });
        };
    return layer;
}

/// The settings of a view of an image.
RenderSettings settingsOf(const PictureView &view, const RenderSettings &ofImage) {
    RenderSettings settings = ofImage;
    settings.integrator = view.view;
    settings.areLayersThrough = ofImage.areLayersThrough || view.isOfDenoiser;
    settings.samplesPerPixel =
        samplesOfView(view.view, samplesForViews(ofImage.samplesPerPixel, wantedNoise(ofImage)),
                      settings.areLayersThrough, view.isOfDenoiser);
    settings.noise = 0.0;
    if (view.isOfDenoiser) // were noise of colours and features one, the denoiser would take it for detail
        settings.seed ^= 0x9E3779B9u;
    if (isOfCentres(view.view, settings.areLayersThrough))
        settings.sampler = SamplerKind::Centre;
    return settings;
}

/// How many of the views one render finds: the denoiser's, if they come first, or the first one.
std::size_t viewsOfOneRender(std::span<const PictureView> views) {
    const bool areOfDenoiser = views.size() >= denoiserViews.size() &&
                               std::ranges::equal(denoiserViews, views.first(denoiserViews.size()),
                                                  [](Integrator view, const PictureView &of) {
                                                      return of == PictureView{view, true};
                                                  });
    return areOfDenoiser ? denoiserViews.size() : 1;
}

/// The films of albedo, normal and depth, of one render, as that has them: see layout::viewFeatures.
Film joined(std::span<const Film> films) {
    Film film = films[0];
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        layout::FilmPixel &pixel = film.pixels[i];
        pixel.sumOfSquares = films[1].pixels[i].sum;
        pixel.squaresRest = films[1].pixels[i].sumRest;
        pixel.transparency = films[2].pixels[i].sum.x;
        pixel.transparencyRest = films[2].pixels[i].sumRest.x;
    }
    return film;
}

/// The inverse of `joined`. Their squares are not known.
std::vector<Film> parted(const Film &film) {
    std::vector<Film> films(denoiserViews.size(), Film(film.crop));
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const layout::FilmPixel &pixel = film.pixels[i];
        const auto set = [&](std::size_t of, const glm::vec3 &sum, const glm::vec3 &rest) {
            layout::FilmPixel &to = films[of].pixels[i];
            to.sum = sum;
            to.sumRest = rest;
            to.sampleCount = pixel.sampleCount;
        };
        set(0, pixel.sum, pixel.sumRest);
        set(1, pixel.sumOfSquares, pixel.squaresRest);
        set(2, glm::vec3(pixel.transparency), glm::vec3(pixel.transparencyRest));
    }
    return films;
}

} // namespace

std::vector<PictureView> layerViewsOf(const PreparedScene &scene) {
    std::vector<PictureView> views;
    for (const Integrator view : scene.views)
        views.push_back({view});
    return views;
}

std::vector<PictureView> viewsOf(const PreparedScene &scene) {
    std::vector<PictureView> views = layerViewsOf(scene);
    if (keepsDenoisingData(scene.loaded.settings))
        for (const Integrator view : denoiserViews)
            views.push_back({view, true});
    return views;
}

int samplesOfView(const PictureView &view, const RenderSettings &ofImage) {
    return samplesOfView(view.view, samplesForViews(ofImage.samplesPerPixel, wantedNoise(ofImage)),
                         ofImage.areLayersThrough, view.isOfDenoiser);
}

int samplesOfView(const ViewFilm &view, const RenderSettings &ofImage) {
    return samplesOfView(PictureView{view.view, view.isOfDenoiser}, ofImage);
}

glm::vec3 valueInLayer(Integrator view, const layout::FilmPixel &pixel) {
    if (view == Integrator::Normal)
        return normalOf(meanOf(pixel));
    if (view == Integrator::Shadow)
        return glm::vec3(shadowOf(pixel));
    return meanOf(pixel);
}

std::vector<ViewFilm> renderViews(Backend &backend, const PreparedScene &scene,
                                  std::span<const PictureView> views, std::span<const Crop> squares,
                                  std::span<const Film> begun, Observer &observer, const TimeLimit &limit) {
    std::vector<ViewFilm> films;
    while (films.size() < views.size()) {
        const PictureView &view = views[films.size()];
        RenderSettings settings = settingsOf(view, scene.loaded.settings);
        RenderTask task{.name = std::string(nameOf(view.view)), .limit = limit};
        std::vector<Film> found(viewsOfOneRender(views.subspan(films.size())), Film(scene.crop));
        settings.areFeaturesShown = found.size() > 1;
        bool isFinished = false;
        if (!squares.empty()) {
            for (std::size_t i = 0; i < found.size(); ++i) {
                found[i] =
                    filmOfSquares(scene.crop, squares, static_cast<std::uint32_t>(settings.samplesPerPixel));
                if (films.size() + i < begun.size())
                    setRecordsIn(found[i], squares, recordsIn(begun[films.size() + i], squares));
            }
            task.shareOfOthers = shareOutside(scene.crop, squares);
            isFinished = finishedWork(found[0], squares, settings.samplesPerPixel).isComplete;
        }
        if (!isFinished && !observer.wantsStop() && !limit.isReached()) {
            const bool areSeveral = settings.areFeaturesShown;
            BackendResult result = unlessFailed(render(
                backend, scene.packed, settings, areSeveral ? joined(found) : found[0], observer, task));
            if (view.view == Integrator::Depth && isOfCentres(view.view, settings.areLayersThrough))
                flattenDepths(scene, films.size() < begun.size() ? &begun[films.size()] : nullptr,
                              result.film);
            found = areSeveral ? parted(result.film) : std::vector{std::move(result.film)};
        }
        for (Film &film : found) {
            const PictureView &of = views[films.size()];
            films.push_back({of.view, std::move(film), scene.packed.namesOf(of.view), of.isOfDenoiser});
        }
    }
    return films;
}

std::vector<float> alphasOf(const Film &film, const std::vector<ViewFilm> &views,
                            const RenderSettings &settings) {
    if (alphaKindOf(settings) == layout::alphaOfNothing)
        return {};
    std::vector<float> alphas(film.pixels.size());
    std::ranges::transform(film.pixels, alphas.begin(), alphaOf);
    const auto shadows = std::ranges::find(views, Integrator::Shadow, &ViewFilm::view);
    if (shadows != views.end())
        for (std::size_t i = 0; i < alphas.size(); ++i)
            alphas[i] = std::min(alphas[i] + shadowOf(shadows->film.pixels[i]), 1.0f);
    return alphas;
}

std::vector<Layer> layersOf(const ViewFilm &film) {
    return rowOf(film.view).tallies() ? matteLayers(film) : std::vector<Layer>{layerOf(film)};
}

std::vector<Layer> viewLayers(const std::vector<ViewFilm> &films) {
    std::vector<Layer> layers;
    for (const ViewFilm &film : films)
        std::ranges::move(layersOf(film), std::back_inserter(layers));
    return layers;
}

std::vector<Attribute> viewAttributes(const std::vector<ViewFilm> &films) {
    std::vector<Attribute> attributes;
    for (const ViewFilm &film : films) {
        const IntegratorRow &view = rowOf(film.view);
        if (view.tallies())
            std::ranges::move(matteAttributes(film), std::back_inserter(attributes));
        else if (view.isOfNumbers())
            attributes.emplace_back(fmt::format("{}.names", view.name), namesToJson(film.names).dump());
    }
    return attributes;
}

} // namespace hyalite::core
