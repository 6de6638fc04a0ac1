#include "host/view/viewer.h"

#include "host/film/film_file.h"
#include "host/film/noise.h"
#include "host/jobs/denoising.h"
#include "host/jobs/film_picture.h"
#include "host/jobs/layers.h"
#include "host/jobs/projection.h"
#include "host/packing/light_planes.h"
#include "host/reference/closest_hit.h"
#include "host/reference/denoise.h"
#include "host/scene/names.h"
#include "host/view/scene_text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <shared_mutex>
#include <utility>

namespace hyalite::core {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds betweenLooksAtFiles{500};
constexpr double secondsOfPreview = 0.05;
constexpr double secondsBetweenFrames = 0.4;
constexpr int samplesOfFirstRound = 16; ///< of an adaptive render (host/film/noise.h)
constexpr std::size_t maxTold = 20;

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

/// The samples of the next frame: as many as there is time for, and all powers of two, at which renderers are compared.
int nextSamples(int samples, double secondsPerSample, int wanted) {
    const double inTime = secondsPerSample > 0.0 ? secondsBetweenFrames / secondsPerSample : 0.0;
    const int more = static_cast<int>(std::clamp(inTime, 1.0, 65536.0));
    const int power = static_cast<int>(std::bit_ceil(static_cast<unsigned>(samples) + 1));
    return std::min({samples + more, power, wanted});
}

/// Whether a page may show it: its samples are colours.
bool isShowable(const IntegratorRow &row) {
    return !row.isOfNumbers() && !row.tallies() && row.integrator != Integrator::Cost;
}

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

double meanNoise(const Film &film, const RenderSettings &settings) {
    const NoiseTarget target{0.0, darknessOf(settings), static_cast<std::uint32_t>(settings.samplesPerPixel)};
    const double noise = noiseOf(film, blocksInFilm(film.crop, std::array{film.crop}), target).mean;
    return std::isfinite(noise) ? noise : 0.0;
}

} // namespace

/// What a renderer asks while it works on a job.
class Viewer::JobObserver : public Observer {
  public:
    JobObserver(Viewer &viewer, const Job &job) : viewer_(viewer), job_(job) {}

    [[nodiscard]] std::optional<Stop> wantsStop() override {
        return viewer_.isCancelled(job_) ? std::optional(Stop{"the viewer", ErrorKind::Interrupted})
                                         : std::nullopt;
    }
    void note(const std::string &text) override {
        const std::lock_guard lock(viewer_.mutex_);
        if (viewer_.told_.size() < maxTold)
            viewer_.told_.push_back(text);
    }

  private:
    Viewer &viewer_;
    const Job &job_;
};

/// Shows the film of an adaptive render between its rounds.
class Viewer::FrameTaker : public SnapshotTaker {
  public:
    FrameTaker(Viewer &viewer, Slot &slot, const Job &job) : viewer_(viewer), slot_(slot), job_(job) {}

    [[nodiscard]] bool isWanted() const noexcept override {
        return secondsBetween(last_, Clock::now()) > secondsBetweenFrames;
    }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts & /*rays*/) override {
        Film film(viewer_.scene_.prepared().crop);
        copyTo(film);
        viewer_.publish(slot_, job_, {.view = job_.view, .image = film.toImage()}, &film);
        last_ = Clock::now();
    }

  private:
    Viewer &viewer_;
    Slot &slot_;
    const Job &job_;
    Clock::time_point last_ = Clock::now();
};

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
    sceneState_ = describeScene();
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
            isClean = std::get<bool>(readValue(name, wish.is_boolean() ? wish : nlohmann::json(false)));
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
    difference_ = {};
    for (const std::unique_ptr<Slot> &slot : slots_) {
        slot->compared.clear();
        slot->figures = {};
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
    json["samplesPerPixel"] = prepared.loaded.settings.samplesPerPixel;
    json["noise"] = wantedNoise(prepared.loaded.settings);
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

// ---- Renderers

bool Viewer::hasWork(const Slot &slot) const {
    if (job_.number == 0 || job_.number != jobNumber_)
        return false;
    return slot.finished != job_.number ||
           (isClean_ && job_.share >= 1.0 && !slot.isCleaned && slot.film && slot.filmView == job_.view);
}

void Viewer::work(Slot &slot) {
    Lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return isStopping_ || hasWork(slot); });
        if (isStopping_)
            break;
        const Job job = job_;
        const bool isNew = slot.finished != job.number;
        const std::shared_ptr<const Film> film = slot.film;
        lock.unlock();
        std::string failure;
        try {
            const std::shared_lock reading(scene_.mutex());
            if (isCancelled(job)) {
            } else if (!isNew) {
                makeClean(slot, job, *film, scene_.prepared().loaded.settings.samplesPerPixel);
            } else if (job.share < 1.0) {
                preview(slot, job);
            } else {
                refine(slot, job);
            }
        } catch (const std::exception &error) {
            failure = error.what();
        }
        lock.lock();
        if (!isNew || !failure.empty())
            slot.isCleaned = true;
        slot.finished = job.number;
        if (!failure.empty() && !isCancelled(job))
            slot.failure = failure;
        tellNews();
    }
    --runningThreads_;
    changed_.notify_all();
}

RenderSettings Viewer::settingsOf(const Job &job) const {
    RenderSettings settings = scene_.prepared().loaded.settings;
    settings.integrator = job.integrator;
    settings.isDenoised = false;
    settings.hasDenoisingData = true; // it counts where the integrator has it
    return settings;
}

Film Viewer::addSamples(Slot &slot, const Job &job, const RenderSettings &settings, Film film,
                        SnapshotTaker *snapshots) {
    JobObserver observer(*this, job);
    BackendResult result =
        unlessFailed(render(*slot.backend, scene_.prepared().packed, settings, std::move(film), observer,
                            {.name = "view", .snapshots = snapshots, .keepsFirst = true}));
    const double seconds = result.timing.renderSeconds;
    const Lock lock(mutex_);
    slot.figures.seconds += seconds;
    slot.figures.dispatchCount += result.timing.dispatchCount;
    if (seconds > 0.0)
        slot.figures.megaraysPerSecond = static_cast<double>(result.rays.total()) / 1e6 / seconds;
    if (result.timing.dispatchCount > 0)
        slot.figures.dispatchMillis = 1e3 * seconds / static_cast<double>(result.timing.dispatchCount);
    return std::move(result.film);
}

void Viewer::preview(Slot &slot, const Job &job) {
    RenderSettings settings = settingsOf(job);
    settings.samplesPerPixel = 1;
    settings.noise = 0.0;
    settings.hasDenoisingData = false;
    const Clock::time_point start = Clock::now();
    const Film film = addSamples(slot, job, settings, Film(scene_.prepared().crop));
    if (isCancelled(job))
        return;
    const double seconds = secondsBetween(start, Clock::now());
    publish(slot, job, {.view = job.view, .image = film.toImage(), .samples = 1, .isPreview = true});
    const Lock lock(mutex_);
    slot.pixelsPerSecond = static_cast<double>(film.pixels.size()) / std::max(seconds, 1e-4);
}

void Viewer::refine(Slot &slot, const Job &job) {
    const PreparedScene &prepared = scene_.prepared();
    RenderSettings settings = settingsOf(job);
    const RenderSettings whole = settings;
    {
        RendererIdentity identity = slot.backend->identity(prepared.packed, job.integrator);
        const Lock lock(mutex_);
        slot.identity = std::move(identity);
        slot.film.reset();
        slot.isCleaned = false;
        slot.clean.reset();
    }
    requireFilmMemory(prepared.crop, 3, lightPlanesOf(prepared.packed, settings).count(),
                      denoisingBytes(settings, prepared.crop, 2));
    Film film(prepared.crop);
    const int inSteps =
        isAdaptive(whole) ? std::min(samplesOfFirstRound, whole.samplesPerPixel) : whole.samplesPerPixel;
    settings.noise = 0.0;
    double secondsPerSample = 0.0;
    for (int samples = 0; samples < inSteps;) {
        settings.samplesPerPixel = nextSamples(samples, secondsPerSample, inSteps);
        const Clock::time_point start = Clock::now();
        film = addSamples(slot, job, settings, std::move(film));
        if (isCancelled(job))
            return;
        secondsPerSample = secondsBetween(start, Clock::now()) / (settings.samplesPerPixel - samples);
        samples = settings.samplesPerPixel;
        if (samples > 1 && keepsDenoisingData(settings)) {
            const double noise = meanNoise(film, settings);
            const Lock lock(mutex_);
            slot.figures.noise = noise;
        }
        publish(slot, job, {.view = job.view, .image = film.toImage(), .samples = samples}, &film);
        const bool isSoon = samples < 4 || !std::has_single_bit(static_cast<unsigned>(samples));
        if (isClean_ && samples < inSteps && !isSoon)
            makeClean(slot, job, film, samples);
    }
    if (isAdaptive(whole)) {
        FrameTaker taker(*this, slot, job);
        film = addSamples(slot, job, whole, std::move(film), &taker);
        if (isCancelled(job))
            return;
        const double noise = meanNoise(film, whole);
        {
            const Lock lock(mutex_);
            slot.figures.noise = noise;
        }
        publish(slot, job, {.view = job.view, .image = film.toImage(), .samples = whole.samplesPerPixel},
                &film);
    }
    auto finished = std::make_shared<const Film>(std::move(film));
    if (isClean_)
        makeClean(slot, job, *finished, whole.samplesPerPixel);
    const Lock lock(mutex_);
    slot.isCleaned = isClean_;
    slot.film = std::move(finished);
    slot.filmView = job.view;
    changed_.notify_all();
}

void Viewer::makeClean(Slot &slot, const Job &job, const Film &film, int samples) {
    const PreparedScene &prepared = scene_.prepared();
    if (!keepsDenoisingData(settingsOf(job)))
        return;
    JobObserver observer(*this, job);
    if (slot.views == nullptr || slot.viewsView != job.view) {
        std::vector<PictureView> wanted;
        for (const Integrator view : denoiserViews)
            wanted.push_back({view, true});
        auto views = std::make_shared<const std::vector<ViewFilm>>(
            renderViews(*slot.backend, prepared, wanted, {}, {}, observer, TimeLimit()));
        if (isCancelled(job))
            return;
        const Lock lock(mutex_);
        slot.views = std::move(views);
        slot.viewsView = job.view;
    }
    if (std::optional<Image> image = denoised(*slot.backend, film, *slot.views, observer);
        image && !isCancelled(job))
        publish(slot, job,
                {.view = job.view, .image = std::move(*image), .samples = samples, .isClean = true});
}

void Viewer::publish(Slot &slot, const Job &job, ViewFrame &&frame, const Film *film) {
    auto shared = std::make_shared<ViewFrame>(std::move(frame));
    Lock lock(mutex_);
    if (job.view != job_.view)
        return;
    shared->number = ++frameNumber_;
    (shared->isClean ? slot.clean : slot.raw) = shared;
    if (slot.figures.firstMillis == 0.0)
        slot.figures.firstMillis = 1e3 * secondsBetween(wishedAt_, Clock::now());
    if (film != nullptr) {
        slot.film = slot.filmWaiters > 0 ? std::make_shared<const Film>(*film) : nullptr;
        slot.filmView = job.view;
    }
    tellNews();
    lock.unlock();
    if (slots_.size() == 2 && !shared->isPreview && !shared->isClean && shared->samples > 0)
        compareWithOther(slot, shared);
}

void Viewer::compareWithOther(Slot &slot, const std::shared_ptr<const ViewFrame> &frame) {
    Slot &other = *slots_[slots_.front().get() == &slot ? 1 : 0];
    std::shared_ptr<const ViewFrame> match;
    {
        const Lock lock(mutex_);
        slot.compared[frame->samples] = frame;
        const auto found = other.compared.find(frame->samples);
        if (found == other.compared.end() || found->second->view != frame->view)
            return;
        match = found->second;
        for (Slot *each : {&slot, &other}) // what is older is of no use any more
            each->compared.erase(each->compared.begin(), each->compared.upper_bound(frame->samples));
    }
    const auto bits = [](const ViewFrame &of) { return std::as_bytes(std::span(of.image.pixels())); };
    Difference difference{frame->samples, 0};
    constexpr std::size_t size = sizeof(glm::vec3);
    for (std::size_t i = 0; i < bits(*frame).size(); i += size)
        difference.pixels +=
            !std::ranges::equal(bits(*frame).subspan(i, size), bits(*match).subspan(i, size));
    const Lock lock(mutex_);
    if (frame->view == job_.view) {
        difference_ = difference;
        tellNews();
    }
}

// ---- Questions

std::string Viewer::sceneText() const {
    const std::shared_lock reading(scene_.mutex());
    return sceneWithCamera(scene_.prepared());
}

nlohmann::ordered_json Viewer::state() const {
    const Lock lock(mutex_);
    nlohmann::ordered_json json = sceneState_;
    json["view"] = job_.view;
    json["isChanging"] = wished_ != applied_ || job_.number != jobNumber_; // to another view
    json["show"] = shown_ ? nlohmann::json(nameOf(*shown_)) : nlohmann::json();
    json["clean"] = isClean_;
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
    json["command"] = request_.renderCommand ? request_.renderCommand(changes_, shown_, isClean_) : "";
    json["renderers"] = nlohmann::json::array();
    for (const std::unique_ptr<Slot> &slot : slots_) {
        nlohmann::ordered_json &renderer = json["renderers"].emplace_back();
        renderer["name"] = slot->backend->name();
        renderer["description"] = slot->backend->description();
        renderer["failure"] = slot->failure;
        renderer["isFinished"] = job_.share >= 1.0 && slot->finished == job_.number && !hasWork(*slot);
        renderer["raw"] = slot->raw ? slot->raw->number : 0;
        renderer["clean"] = slot->clean ? slot->clean->number : 0;
        const bool isOfView = slot->raw && slot->raw->view == job_.view && !slot->raw->isPreview;
        renderer["samples"] = isOfView ? slot->raw->samples : 0;
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

std::uint64_t Viewer::waitForNews(std::uint64_t seen, milliseconds patience) const {
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
    const reference::SceneView<float> view(packed, layout::samplerCentre);
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
    constexpr milliseconds patience{20'000};
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
        settings.samplesPerPixel = static_cast<int>(film->pixels.front().sampleCount);
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
