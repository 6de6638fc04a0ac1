#include "host/view/viewer.h"

#include "host/scene/names.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds betweenLooksAtFiles{500};
constexpr double secondsOfPreview = 0.05;

std::optional<Integrator> readShown(const nlohmann::json &wish) {
    if (wish.is_null())
        return std::nullopt;
    std::vector<std::string_view> names;
    for (const IntegratorRow &row : integratorTable)
        if (isShowable(row)) {
            names.push_back(row.name);
            if (wish == row.name)
                return row.integrator;
        }
    throw OverrideError("show", refusalText(wish.dump(), quotedList(names)));
}

bool readFlag(const std::string &name, const nlohmann::json &wish) {
    if (!wish.is_boolean())
        throw OverrideError(name, refusalText(wish.dump(), "true or false"));
    return wish.get<bool>();
}

OptionValue readValue(const std::string &name, const nlohmann::json &wish) {
    if (wish.is_boolean())
        return wish.get<bool>();
    if (wish.is_number())
        return wish.get<double>();
    if (wish.is_string())
        return wish.get<std::string>();
    if (wish.is_array() && std::ranges::all_of(wish, [](const auto &number) { return number.is_number(); }))
        return wish.get<std::vector<double>>();
    throw OverrideError(name, refusalText(wish.dump(), "a number, a text, true, false, or several numbers"));
}

nlohmann::ordered_json toJson(const glm::dvec3 &v) { return {v.x, v.y, v.z}; }

} // namespace

bool isShowable(const IntegratorRow &row) {
    return !row.isOfNumbers() && !row.tallies() && row.integrator != Integrator::Cost;
}

Viewer::Viewer(ViewRequest request, Observer &observer)
    : request_(std::move(request)), observer_(observer), scene_(request_.scene, observer),
      wishedAt_(Clock::now()), shownOptions_(request_.scene) {
    for (const RendererNames &names : request_.renderers) {
        OpenedRenderers opened =
            openRenderers(names, observer, processorsFor(request_.threadCount, scene_.prepared()),
                          renderConfigFor(request_.deviceOptions));
        std::ranges::move(opened.notes, std::back_inserter(told_));
        auto slot = std::make_unique<Slot>();
        slot->backend = std::move(opened.backend);
        slots_.push_back(std::move(slot));
    }
    scene_.beforeChange = [this] { ++jobNumber_; };
    isClean_ = scene_.prepared().loaded.settings.isDenoised;
    sceneState_ = describeScene();
    isDenoisedByFile_ = scene_.prepared().givenSettings.isDenoised;
    runningThreads_ = 1 + static_cast<int>(slots_.size());
    for (const std::unique_ptr<Slot> &slot : slots_)
        slot->thread = std::thread([this, &slot = *slot] { work(slot); });
    director_ = std::thread([this] { direct(); });
}

Viewer::~Viewer() {
    static_cast<void>(stop(milliseconds(0)));
    director_.join();
    for (const std::unique_ptr<Slot> &slot : slots_)
        slot->thread.join();
}

bool Viewer::stop(milliseconds patience) {
    Lock lock(mutex_);
    isStopping_ = true;
    changed_.notify_all();
    return changed_.wait_for(lock, patience, [this] { return runningThreads_ == 0; });
}

void Viewer::tellNews() {
    ++news_;
    changed_.notify_all();
}

// ---- Wishes

void Viewer::change(const nlohmann::json &wishes) {
    if (!wishes.is_object())
        throw OverrideError("change", refusalText(wishes.dump().substr(0, 80), "an object"));
    const Lock lock(mutex_);
    ViewChanges changes = changes_;
    std::optional<Integrator> shown = shown_;
    bool isClean = isClean_;
    for (const auto &[name, wish] : wishes.items()) {
        if (name == "show")
            shown = readShown(wish);
        else if (name == "clean")
            isClean = readFlag(name, wish);
        else if (wish.is_null())
            changes.erase(name);
        else
            changes.insert_or_assign(name, readValue(name, wish));
    }
    static_cast<void>(scene_.optionsWith(changes)); // throws
    isClean_ = isClean;
    if (changes != changes_ || shown != shown_) {
        changes_ = std::move(changes);
        shown_ = shown;
        ++wished_;
        wishedAt_ = Clock::now();
    }
    tellNews();
}

// ---- The director: what is rendered

void Viewer::direct() {
    Lock lock(mutex_);
    Clock::time_point lookedAtFiles = Clock::now();
    while (!isStopping_) {
        if (wished_ != applied_) {
            applyWish(lock);
        } else if (isJobFinished() && job_.share < 1.0) {
            beginJob(lock, std::min(2.0 * job_.share, 1.0));
        } else if (Clock::now() - lookedAtFiles >= betweenLooksAtFiles) {
            lock.unlock();
            const bool haveChanged = scene_.haveFilesChanged();
            lookedAtFiles = Clock::now();
            lock.lock();
            if (haveChanged)
                reload(lock);
        } else {
            changed_.wait_for(lock, betweenLooksAtFiles, [this] {
                return isStopping_ || wished_ != applied_ || (isJobFinished() && job_.share < 1.0);
            });
        }
    }
    --runningThreads_;
    changed_.notify_all();
}

bool Viewer::isJobFinished() const {
    return job_.number != 0 && std::ranges::all_of(slots_, [this](const std::unique_ptr<Slot> &slot) {
               return slot->finished == job_.number;
           });
}

void Viewer::applyWish(Lock &lock) {
    const std::uint64_t wish = wished_;
    const ViewChanges changes = changes_;
    std::string fault;
    SceneOptions options;
    lock.unlock();
    try {
        options = scene_.optionsWith(changes);
        scene_.show(options, 1.0, observer_);
    } catch (const Error &error) {
        fault = error.what();
    }
    lock.lock();
    applied_ = wish;
    fault_ = fault;
    if (fault.empty()) {
        shownChanges_ = changes;
        shownOptions_ = options;
        beginView(lock);
        return;
    }
    if (wished_ == wish)
        changes_ = shownChanges_;
    if (jobNumber_ == job_.number) // the scene was not touched
        tellNews();
    else
        beginView(lock);
}

void Viewer::reload(Lock &lock) {
    std::string fault;
    lock.unlock();
    try {
        scene_.reload(observer_);
    } catch (const Error &error) {
        fault = error.what();
    }
    lock.lock();
    fault_ = fault;
    wishedAt_ = Clock::now();
    if (fault.empty())
        beginView(lock);
    else
        tellNews();
}

void Viewer::beginView(Lock &lock) {
    lock.unlock();
    scene_.show(shownOptions_, 1.0, observer_);
    lock.lock();
    sceneState_ = describeScene();
    isDenoisedByFile_ = scene_.prepared().givenSettings.isDenoised;
    difference_ = {};
    for (const std::unique_ptr<Slot> &slot : slots_) {
        slot->compared.clear();
        slot->figures = {};
        slot->samples = 0;
        slot->failure.clear();
    }
    ++job_.view;
    beginJob(lock, firstShare());
}

void Viewer::beginJob(Lock &lock, double share) {
    lock.unlock();
    scene_.show(shownOptions_, share, observer_);
    lock.lock();
    job_.share = share;
    job_.number = ++jobNumber_;
    job_.integrator = shown_.value_or(scene_.prepared().loaded.settings.integrator);
    tellNews();
}

/// So small a picture that the slower renderer has it in no time; by halves from the whole one.
double Viewer::firstShare() const {
    const Camera &camera = scene_.prepared().loaded.scene.camera;
    constexpr double atFirst = 96.0 * 96.0;
    double pixels = 1e30;
    for (const std::unique_ptr<Slot> &slot : slots_)
        pixels = std::min(pixels,
                          slot->pixelsPerSecond > 0.0 ? slot->pixelsPerSecond * secondsOfPreview : atFirst);
    double share = 1.0;
    while (share > 1.0 / 64.0 && share * share * camera.width * camera.height > pixels)
        share *= 0.5;
    return share;
}

nlohmann::ordered_json Viewer::describeScene() const {
    const PreparedScene &prepared = scene_.prepared();
    const Camera &camera = prepared.loaded.scene.camera;
    const glm::dvec3 origin = prepared.loaded.scene.origin;
    nlohmann::ordered_json json;
    json["scene"] = prepared.loaded.file.filename().string();
    json["width"] = prepared.crop.width();
    json["height"] = prepared.crop.height();
    const RenderSettings shown = settingsOf(shown_.value_or(prepared.loaded.settings.integrator));
    json["samplesPerPixel"] = shown.samplesPerPixel;
    json["noise"] = wantedNoise(shown);
    json["exposure"] = prepared.loaded.settings.exposureStops;
    json["integrator"] = nameOf(prepared.loaded.settings.integrator);
    json["triangles"] = prepared.packed.triangles.size();
    nlohmann::ordered_json &view = json["camera"];
    view["type"] = nameIn(cameraNames, camera.kind);
    view["position"] = toJson(camera.position + origin);
    view["direction"] = toJson(glm::normalize(camera.direction));
    view["up"] = toJson(camera.up);
    view["fov"] = camera.horizontalFovDegrees;
    view["aperture"] = camera.aperture;
    view["focusDistance"] = camera.focusDistance;
    view["viewWidth"] = camera.viewWidth;
    view["moves"] = !prepared.loaded.cameraPath.empty();
    const glm::dvec3 low = glm::dvec3(prepared.packed.frame.boundsLower) + origin;
    const glm::dvec3 high = glm::dvec3(prepared.packed.frame.boundsUpper) + origin;
    json["bounds"] = {toJson(low), toJson(high)};
    json["cameras"] = nlohmann::json::array();
    if (prepared.loaded.outline)
        for (std::size_t i = 0; i < prepared.loaded.outline->cameras.size(); ++i) {
            const std::string &name = prepared.loaded.outline->cameras[i].name;
            json["cameras"].push_back(name.empty() ? fmt::format("{}", i) : name);
        }
    return json;
}

} // namespace hyalite::core
