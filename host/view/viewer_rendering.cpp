// The renderers of a viewer: previews, more and more samples, and clean pictures.
#include "host/film/noise.h"
#include "host/jobs/denoising.h"
#include "host/jobs/layers.h"
#include "host/packing/light_planes.h"
#include "host/view/viewer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <shared_mutex>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

constexpr double secondsBetweenFrames = 0.4;
constexpr int samplesOfFirstRound = 16; ///< of an adaptive render (host/film/noise.h)
constexpr std::size_t maxTold = 20;

double secondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

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

/// Shows the film of a render while its pixels get their samples, one after another.
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
                makeClean(slot, job, *film, settingsOf(job.integrator).samplesPerPixel);
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

RenderSettings Viewer::settingsOf(Integrator integrator) const {
    const PreparedScene &prepared = scene_.prepared();
    RenderSettings settings = prepared.loaded.settings;
    settings.integrator = integrator;
    settings.isDenoised = false;
    settings.hasDenoisingData = true; // it counts where the integrator has it
    if (settings.noise > 0.0 && !isAdaptive(settings) && settings.samplesPerPixel == samplesForNoise)
        settings.samplesPerPixel = prepared.givenSettings.samplesPerPixel; // the most is for a noise alone
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
    RenderSettings settings = settingsOf(job.integrator);
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
    RenderSettings settings = settingsOf(job.integrator);
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
    FrameTaker taker(*this, slot, job);
    // Twice as many each time: a device takes several times as long for a sample if there are few to add. At powers of two
    // renderers are compared.
    for (int samples = 0; samples < inSteps;) {
        settings.samplesPerPixel = std::min(std::max(2 * samples, 1), inSteps);
        const Clock::time_point start = Clock::now();
        SnapshotTaker *const between =
            samples > 0 ? &taker : nullptr; // a preview is better than half a picture
        film = addSamples(slot, job, settings, std::move(film), between);
        if (isCancelled(job))
            return;
        if (samples == 0) {
            const double speed =
                static_cast<double>(film.pixels.size()) / std::max(secondsBetween(start, Clock::now()), 1e-4);
            const Lock lock(mutex_); // without a preview, or where that was fast, this is all that is known
            slot.pixelsPerSecond = slot.pixelsPerSecond > 0.0 ? std::min(slot.pixelsPerSecond, speed) : speed;
        }
        samples = settings.samplesPerPixel;
        if (samples > 1 && keepsDenoisingData(settings)) {
            const double noise = meanNoise(film, settings);
            const Lock lock(mutex_);
            slot.figures.noise = noise;
        }
        publish(slot, job, {.view = job.view, .image = film.toImage(), .samples = samples}, &film);
        if (isClean_ && samples >= 4 && samples < inSteps)
            makeClean(slot, job, film, samples);
    }
    if (isAdaptive(whole)) {
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
    const bool isToBeClean = isClean_;
    if (isToBeClean)
        makeClean(slot, job, *finished, whole.samplesPerPixel);
    const Lock lock(mutex_);
    slot.isCleaned = isToBeClean;
    slot.film = std::move(finished);
    slot.filmView = job.view;
    changed_.notify_all();
}

void Viewer::makeClean(Slot &slot, const Job &job, const Film &film, int samples) {
    const PreparedScene &prepared = scene_.prepared();
    if (!keepsDenoisingData(settingsOf(job.integrator)))
        return;
    JobObserver observer(*this, job);
    if (slot.views == nullptr || slot.viewsView != job.view) {
        std::array<PictureView, denoiserViews.size()> wanted{};
        std::ranges::transform(denoiserViews, wanted.begin(), [](Integrator view) {
            return PictureView{view, true};
        });
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
    if (!shared->isClean && (shared->samples > 0 || shared->isPreview))
        slot.samples = shared->isPreview ? 0 : shared->samples;
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

} // namespace hyalite::core
