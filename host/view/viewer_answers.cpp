// What a viewer tells and gives away.
#include "host/jobs/film_picture.h"
#include "host/jobs/projection.h"
#include "host/reference/closest_hit.h"
#include "host/reference/denoise.h"
#include "host/scene/names.h"
#include "host/view/scene_text.h"
#include "host/view/viewer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <shared_mutex>

namespace hyalite::core {

std::string Viewer::sceneText() const {
    const std::shared_lock reading(scene_.mutex());
    return sceneWithCamera(scene_.prepared());
}

nlohmann::ordered_json Viewer::state() const {
    const Lock lock(mutex_);
    nlohmann::ordered_json json = sceneState_;
    json["number"] = news_;
    json["view"] = job_.view;
    json["isChanging"] = wished_ != applied_ || job_.number != jobNumber_; // to another view
    json["show"] = shown_ ? nlohmann::json(nameOf(*shown_)) : nlohmann::json();
    json["clean"] = isClean_.load();
    json["canBeClean"] = keepsDenoisingData([this] {
        RenderSettings settings;
        settings.integrator = job_.integrator;
        settings.hasDenoisingData = true;
        return settings;
    }());
    json["integrators"] = nlohmann::json::array();
    for (const IntegratorRow &row : integratorTable)
        if (isShowable(row))
            json["integrators"].push_back({{"name", row.name}, {"help", row.help}});
    json["fault"] = fault_;
    json["told"] = told_;
    ViewToRender view{changes_, shown_};
    if (const bool isClean = isClean_ && json["canBeClean"]; isClean != isDenoisedByFile_)
        view.isDenoised = isClean;
    json["renderers"] = nlohmann::json::array();
    for (const std::unique_ptr<Slot> &slot : slots_) {
        nlohmann::ordered_json &renderer = json["renderers"].emplace_back();
        renderer["name"] = slot->backend->name();
        renderer["description"] = slot->backend->description();
        renderer["command"] = request_.renderCommand ? request_.renderCommand(view) : "";
        ++view.renderer;
        renderer["failure"] = slot->failure;
        renderer["isFinished"] = job_.share >= 1.0 && slot->finished == job_.number && !hasWork(*slot);
        renderer["raw"] = slot->raw ? slot->raw->number : 0;
        renderer["clean"] = slot->clean ? slot->clean->number : 0;
        renderer["samples"] = slot->samples;
        const ViewFigures &figures = slot->figures;
        renderer["noise"] = figures.noise;
        renderer["megaraysPerSecond"] = figures.megaraysPerSecond;
        renderer["dispatchMillis"] = figures.dispatchMillis;
        renderer["dispatches"] = figures.dispatchCount;
        renderer["seconds"] = figures.seconds;
        renderer["firstMillis"] = figures.firstMillis;
    }
    if (slots_.size() == 2)
        json["difference"] = {{"samples", difference_.samples}, {"pixels", difference_.pixels}};
    return json;
}

std::uint64_t Viewer::waitForNews(std::uint64_t seen, std::chrono::milliseconds patience) const {
    Lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return news_ != seen || isStopping_; });
    return news_;
}

std::shared_ptr<const ViewFrame> Viewer::frame(std::size_t renderer, bool isClean) const {
    const Lock lock(mutex_);
    const Slot &slot = *slots_.at(renderer);
    return isClean && slot.clean && slot.clean->view == job_.view ? slot.clean : slot.raw;
}

std::optional<Pick> Viewer::pick(double x, double y) const {
    const std::shared_lock reading(scene_.mutex());
    const PreparedScene &prepared = scene_.prepared();
    const PackedScene &packed = prepared.packed;
    reference::SceneView<float> view(packed, layout::samplerCentre);
    view.frame.lensScale = 0.0F; // what is out of focus has its place, too
    const Crop &crop = prepared.crop;
    const glm::uvec2 pixel(crop.x0 + std::clamp(static_cast<int>(x * crop.width()), 0, crop.width() - 1),
                           crop.y0 + std::clamp(static_cast<int>(y * crop.height()), 0, crop.height() - 1));
    const auto primary = reference::primaryRay(view, pixel, 0);
    const reference::Ray<float> ray{primary.origin, primary.direction};
    const reference::Hit<float> hit = reference::closestHit(packed, ray);
    if (hit.primitive == layout::noPrimitive)
        return std::nullopt;
    const glm::dvec3 direction(ray.direction);
    const double along = glm::dot(direction, glm::normalize(prepared.loaded.scene.camera.direction));
    std::uint32_t material = 0;
    static_cast<void>(reference::hitSurface(view, hit, ray.origin, ray.direction, material));
    const auto place =
        std::ranges::upper_bound(packed.places, hit.primitive, {}, &layout::PlaceRecord::firstPrimitive);
    const auto nameOf = [](const std::vector<std::string> &names, std::uint32_t number) {
        return number >= 1 && number <= names.size() ? names[number - 1] : std::string();
    };
    return Pick{glm::dvec3(ray.origin) + double{hit.distance} * direction + prepared.loaded.scene.origin,
                hit.distance, hit.distance * along,
                place == packed.places.begin()
                    ? std::string()
                    : nameOf(packed.namesOf(Integrator::ObjectNumber), std::prev(place)->object),
                nameOf(packed.namesOf(Integrator::MaterialNumber), packed.materials[material].number)};
}

std::vector<std::byte> Viewer::pictureFile(std::size_t renderer, const PictureWish &wanted) const {
    constexpr std::chrono::milliseconds patience{20'000};
    Slot &slot = *slots_.at(renderer);
    std::shared_ptr<const Film> film;
    std::shared_ptr<const ViewFrame> clean;
    std::shared_ptr<const std::vector<ViewFilm>> views;
    Provenance origin;
    RendererIdentity identity;
    Integrator integrator{};
    {
        Lock lock(mutex_);
        ++slot.filmWaiters;
        const bool isThere = changed_.wait_for(lock, patience, [&] {
            return isStopping_ || (slot.film && slot.filmView == job_.view && job_.number == jobNumber_);
        });
        --slot.filmWaiters;
        if (!isThere || isStopping_)
            throw Error(ErrorKind::BadInput,
                        "there is no picture yet in full size: wait for its first samples");
        film = slot.film;
        identity = slot.identity;
        integrator = job_.integrator;
        if (wanted.isClean && slot.clean && slot.clean->view == job_.view)
            clean = slot.clean;
        if (clean && slot.viewsView == job_.view)
            views = slot.views;
    }
    const std::shared_lock reading(scene_.mutex());
    const PreparedScene &prepared = scene_.prepared();
    if (prepared.crop != film->crop)
        throw Error(ErrorKind::BadInput, "the view has changed meanwhile: try once more");
    RenderSettings settings = prepared.loaded.settings;
    settings.integrator = integrator;
    settings.isDenoised = clean != nullptr;
    settings.exposureStops = wanted.exposureStops;
    if (!isAdaptive(settings))
        settings.samplesPerPixel = static_cast<int>( // some pixels may have more
            std::ranges::min(film->pixels, {}, &layout::FilmPixel::sampleCount).sampleCount);
    origin = provenanceOf(prepared, request_.commandLine);
    origin.settings = settings;
    const std::vector<ViewFilm> none;
    FilmPicture picture{.film = *film, .views = views ? *views : none};
    picture.wholeWidth = prepared.loaded.scene.camera.width;
    picture.wholeHeight = prepared.loaded.scene.camera.height;
    picture.attributes = attributesOf(provenanceToJson(origin, identity));
    picture.settings = settings;
    picture.options.tone = wanted.tone;
    picture.projection = projectionOf(prepared.loaded.scene);
    if (clean) {
        picture.clean = &clean->image;
        picture.attributes.emplace_back(denoisedAttribute, reference::denoiserName);
    }
    AtomicFile file = AtomicFile::inMemory(prepared.loaded.file);
    static_cast<void>(writeFilmPicture(file, wanted.format, picture));
    return file.contents();
}

} // namespace hyalite::core
