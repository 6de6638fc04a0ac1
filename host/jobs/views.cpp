#include "host/jobs/views.h"

#include "host/base/error.h"
#include "host/film/film_file.h"
#include "host/image/contact_sheet.h"
#include "host/image/image_file.h"
#include "host/image/png.h"
#include "host/jobs/denoising.h"
#include "host/jobs/layers.h"
#include "host/report/render_report.h"
#include "host/scene/scene_nodes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

namespace hyalite::core {

namespace {

constexpr double aroundElevationDegrees = 20.0;

bool hasPlaceholder(const std::string &name) { return name.find(viewPlaceholder) != std::string::npos; }

/// The name for a view.
std::string nameOfView(std::string name, const View &view) {
    for (std::size_t at = 0; (at = name.find(viewPlaceholder, at)) != std::string::npos;
         at += view.name.size())
        name.replace(at, viewPlaceholder.size(), view.name);
    return name;
}

void requireDistinctNames(const std::vector<View> &views) {
    std::set<std::string_view> names;
    for (const View &view : views)
        if (!names.insert(view.name).second)
            throw OverrideError("views", fmt::format("found {} twice; allowed: each view once", view.name));
}

/// With these overrides of the camera, a view would be another one.
void requireOwnCameras(const SceneOptions &options) {
    const auto refuse = [](const std::string &name) {
        throw OverrideError(name, "found beside views, whose cameras are placed around the scene; "
                                  "allowed: for one picture");
    };
    if (!options.cameraPosition.empty())
        refuse("camera-position");
    if (!options.lookAt.empty())
        refuse("look-at");
    if (!options.load.camera.empty())
        refuse("camera");
}

std::vector<Attribute> attributesOfSheet(const ViewSeries &series, const RenderSession &session,
                                         const std::string &commandLine,
                                         std::span<const std::uint8_t> levels) {
    std::vector<Attribute> attributes = attributesOfSeveral(session, commandLine);
    std::string names;
    for (const View &view : series.views())
        names += (names.empty() ? "" : ",") + view.name;
    attributes.emplace_back("views", names);
    attributes.emplace_back("pixels", pixelHash(levels));
    return attributes;
}

/// Of a sheet, which has no layers.
std::vector<PictureView> viewsToDenoise(const PreparedScene &scene) {
    std::vector<PictureView> views;
    if (isToBeDenoised(scene.loaded.settings))
        std::ranges::copy_if(viewsOf(scene), std::back_inserter(views), &PictureView::isOfDenoiser);
    return views;
}

} // namespace

std::vector<View> viewsAround(int count) {
    std::vector<View> views;
    views.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        views.push_back({fmt::format("contact-{}", i + 1), {360.0 * i / count, aroundElevationDegrees}});
    return views;
}

ViewSeries::ViewSeries(RenderRequest request, ViewOptions options)
    : request_(std::move(request)), options_(std::move(options)) {
    requireDistinctNames(options_.views);
    requireOwnCameras(request_.scene);
    const bool areSeveral = options_.views.size() > 1;
    isSheet_ = areSeveral && !hasPlaceholder(request_.output);
    if (isSheet_ && imageFormatOf(request_.output) != ImageFormat::Png)
        throw OverrideError("output",
                            fmt::format("found {} for several views; allowed: a .png, which becomes a "
                                        "sheet of them, or a name with {}, for a file each",
                                        request_.output, viewPlaceholder));
    if (isSheet_ && !request_.report.empty())
        throw OverrideError("report", fmt::format("found a sheet of several views, which has none; allowed: "
                                                  "with {} in the name of the output",
                                                  viewPlaceholder));
    if (areSeveral && !request_.report.empty() && !hasPlaceholder(request_.report))
        throw OverrideError("report", fmt::format("found {} for several views; allowed: a name with {}",
                                                  request_.report, viewPlaceholder));
}

RenderRequest ViewSeries::requestOf(const View &view) const {
    RenderRequest request = request_;
    request.view = view.name;
    request.output = nameOfView(request.output, view);
    request.report = nameOfView(request.report, view);
    return request;
}

void ViewSeries::prepare(RenderSession &session) {
    session.prepare(request_, Source::Kept);
    const LoadedScene &loaded = session.scene().loaded;
    const SceneBounds bounds = sceneBounds(loaded.scene);
    all_ = framed_ = bounds.all;
    if (!options_.object.empty()) {
        try {
            framed_ = boundsNamed(loaded.scene, bounds, options_.object);
        } catch (const Error &error) {
            throw OverrideError("frame", error.what());
        }
    }
    requireFramed(framed_, options_.object.empty() ? loaded.file.string() : options_.object);
    const glm::dvec3 cameraUp = loaded.scene.camera.up;
    up_ = glm::normalize(request_.scene.up.empty() ? loaded.worldUp.value_or(cameraUp) : cameraUp);
}

void ViewSeries::moveTo(const View &view, RenderSession &session) const {
    PreparedScene &prepared = session.scene();
    Scene &scene = prepared.loaded.scene;
    scene.camera = frameCamera(framed_, scene.camera.width, scene.camera.height,
                               request_.scene.fovDegrees.value_or(defaultFovDegrees), up_, view.from);
    packCamera(scene, prepared.packed);
    if (!prepared.loaded.isAutoLit)
        return;
    scene.lights = frameLights(all_, scene.camera);
    packLights(scene, prepared.loaded.settings.lightChoice, prepared.packed);
    prepared.arraysHash = prepared.packed.arraysHash();
}

FinishedSheet renderSheet(const ViewSeries &series, const RenderRequest &request, AtomicFile &file,
                          const std::string &commandLine, RenderSession &session) {
    const PreparedScene &scene = session.scene();
    const RenderSettings &settings = scene.loaded.settings;
    const SheetSize size =
        sheetSize(static_cast<int>(series.views().size()), scene.crop.width(), scene.crop.height());
    requirePngSize(file.path(), size.width, size.height);
    requireFilmMemory(scene.crop, 1 + static_cast<unsigned>(viewsToDenoise(scene).size()), 0,
                      denoisingBytes(settings, scene.crop, 1));
    const TimeLimit limit(request.timeLimitSeconds);
    FinishedSheet finished;
    std::vector<SheetTile> tiles;
    for (const View &view : series.views()) {
        series.moveTo(view, session);
        Film film(scene.crop);
        std::optional<Image> clean;
        if (tiles.empty() || !limit.isReached()) {
            const std::vector<ViewFilm> views = renderViews(session.backend(), scene, viewsToDenoise(scene),
                                                            {}, {}, session.observer(), limit);
            BackendResult result = unlessFailed(
                render(session.backend(), scene.packed, settings, std::move(film), session.observer(),
                       {.name = "view " + view.name, .limit = limit, .keepsFirst = !views.empty()}));
            if (const std::optional<Stop> stop = session.observer().wantsStop())
                throw Error(stop->kind, fmt::format("stopped by {} in view {} of a sheet: nothing is written",
                                                    stop->by, view.name));
            finished.renderSeconds += result.timing.renderSeconds;
            finished.rayCount += result.rays.total();
            film = std::move(result.film);
            if (!views.empty())
                clean = denoised(session.backend(), film, views, session.observer());
        }
        const bool isComplete = finishedWork(film, {&scene.crop, 1}, settings).isComplete;
        finished.viewCount += isComplete ? 1 : 0;
        tiles.push_back(
            {isComplete ? view.name : view.name + " (unfinished)",
             drawFilm(film, clean ? *clean : film.toImage(), settings, request.file.options().tone)});
    }
    const Drawing sheet = drawSheet(tiles);
    finished.width = sheet.width;
    finished.height = sheet.height;
    writePng(file, sheet.width, sheet.height, sheet.rgb,
             attributesOfSheet(series, session, commandLine, sheet.rgb));
    file.commit();
    return finished;
}

} // namespace hyalite::core
