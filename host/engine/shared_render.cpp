#include "host/engine/shared_render.h"

#include "host/base/error.h"
#include "host/engine/spot_check.h"
#include "host/engine/tile_queue.h"
#include "host/film/partition.h"
#include "host/packing/light_planes.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <thread>
#include <utility>

namespace hyalite::core {

namespace {

/// A member during one render.
struct Worker {
    Member *member;
    double samplesPerSecond = 0.0; ///< of the last tile or of all, whichever is less; 0: unknown
    double workingSeconds = 0.0;   ///< that it took for all, except for its compiler's
    std::uint64_t lastSamples = 0; ///< that it added in the last tile
    double currentSamples = 0.0;   ///< of the tile that it renders now, those from before included
    BackendResult total{Film(Crop{}), {}, {}, {}};
    RendererShare share{};
};

/// Of those that are wanted: some pixels may have more.
std::uint64_t samplesIn(const Film &film, std::uint32_t samplesPerPixel) {
    std::uint64_t count = 0;
    for (const layout::FilmPixel &pixel : film.pixels)
        count += std::min(pixel.sampleCount, samplesPerPixel);
    return count;
}

/// Why a member that does `work` is to be left out; empty if it is done.
template <class Work> std::optional<Error> failureOf(const Work &work) {
    try {
        work();
        return std::nullopt;
    } catch (const Error &error) {
        return error;
    } catch (const std::bad_alloc &) {
        return Error(ErrorKind::LimitExceeded, "it has too little memory");
    }
}

/// One picture.
class SharedRender {
  public:
    SharedRender(std::vector<Member> &members, const PackedScene &scene, const RenderSettings &settings,
                 Film begun, const RenderHooks &hooks)
        : members_(members), scene_(scene), settings_(settings), hooks_(hooks),
          samplesPerPixel_(static_cast<std::uint32_t>(settings.samplesPerPixel)),
          spotCheck_(scene, settings, begun.crop, hooks.shouldStop), film_(std::move(begun)),
          queue_(film_, samplesPerPixel_),
          finishedSamples_(static_cast<double>(samplesIn(film_, samplesPerPixel_))) {
        for (Member &member : members)
            if (!member.isLeftOut()) {
                workers_.push_back({.member = &member});
                workers_.back().share.name = member.backend->name();
            }
    }

    [[nodiscard]] BackendResult render() {
        Stopwatch watch;
        {
            std::vector<std::jthread> threads;
            threads.reserve(workers_.size());
            for (Worker &worker : workers_)
                threads.emplace_back([this, &worker] { run(worker); });
        }
        if (bug_)
            std::rethrow_exception(bug_);
        BackendResult all{std::move(film_), rays_, {}, {}};
        all.timing.renderSeconds = watch.lap().seconds();
        for (const Member &member : members_)
            if (member.isLeftOut() && std::ranges::find(workers_, &member, &Worker::member) == workers_.end())
                all.shares.push_back({member.backend->name(), 0, 0, 0.0, member.failure->what()});
        for (Worker &worker : workers_) {
            const BackendResult &total = worker.total;
            all.work += total.work;
            all.timing.dispatchCount += total.timing.dispatchCount;
            all.memory.deviceBytes += total.memory.deviceBytes;
            all.memory.hostBytes += total.memory.hostBytes;
            std::ranges::copy(total.faults, std::back_inserter(all.faults));
            all.shares.push_back(worker.share);
        }
        if (std::ranges::all_of(members_, &Member::isLeftOut))
            all.failure.emplace(*members_.front().failure);
        return all;
    }

  private:
    void run(Worker &worker) {
        try {
            while (const std::optional<Crop> tile = take(worker))
                renderTile(worker, *tile);
        } catch (...) {
            const std::scoped_lock lock(mutex_);
            bug_ = std::current_exception();
            changed_.notify_all();
        }
    }

    /// Waits while others may give their tiles back.
    [[nodiscard]] std::optional<Crop> take(Worker &worker) {
        std::unique_lock lock(mutex_);
        while (!worker.member->isLeftOut() && !bug_ && !isToStop()) {
            if (std::optional<Crop> tile = queue_.take(wantedPixels(worker))) {
                ++busyCount_;
                return tile;
            }
            if (busyCount_ == 0)
                break;
            changed_.wait_for(lock, std::chrono::milliseconds(50)); // shouldStop tells nobody when it changes
        }
        changed_.notify_all();
        return std::nullopt;
    }

    [[nodiscard]] std::uint64_t wantedPixels(const Worker &worker) const {
        TileWish wish;
        wish.samplesPerPixel = samplesPerPixel_;
        wish.samplesPerSecond = worker.samplesPerSecond;
        for (const Worker &other : workers_)
            if (!other.member->isLeftOut())
                wish.allSamplesPerSecond +=
                    other.samplesPerSecond > 0.0 ? other.samplesPerSecond : worker.samplesPerSecond;
        wish.lastSamples = static_cast<double>(worker.lastSamples);
        wish.waitingPixels = static_cast<double>(queue_.pixelCount());
        return tilePixels(wish);
    }

    void renderTile(Worker &worker, const Crop &tile) {
        Film begun(tile);
        std::uint64_t samplesBefore = 0;
        {
            const std::scoped_lock lock(mutex_);
            static_cast<FilmRecords &>(begun) = recordsIn(film_, std::span(&tile, 1));
            samplesBefore = samplesIn(begun, samplesPerPixel_);
            worker.currentSamples = static_cast<double>(samplesBefore);
            finishedSamples_ -= worker.currentSamples;
        }
        const double samplesInAll = static_cast<double>(begun.pixels.size()) * samplesPerPixel_;
        const auto onProgress = [&](double share) {
            const std::scoped_lock lock(mutex_);
            worker.currentSamples = share * samplesInAll;
            tellProgress();
        };
        Stopwatch watch;
        const std::optional<Error> failure = failureOf([&] {
            checkBits(worker, watch);
            BackendResult result =
                worker.member->backend->render(scene_, settings_, std::move(begun),
                                               {.onProgress = onProgress, .shouldStop = hooks_.shouldStop});
            const double seconds = watch.lap().seconds();
            const std::scoped_lock lock(mutex_);
            takeIn(worker, tile, samplesBefore, seconds, std::move(result));
        });
        if (!failure)
            return;
        const std::scoped_lock lock(mutex_);
        worker.share.seconds += watch.lap().seconds();
        finishedSamples_ += static_cast<double>(samplesBefore);
        leaveOut(worker, tile, *failure);
    }

    /// Throws if they are not the CPU's. A picture by one renderer has no seams, whatever its bits.
    void checkBits(Worker &worker, Stopwatch &watch) {
        Member &member = *worker.member;
        const Integrator integrator = settings_.integrator;
        if (workers_.size() == 1 || std::ranges::find(member.checked, integrator) != member.checked.end())
            return;
        if (spotCheck_.run(*member.backend, worker.total.faults))
            member.checked.push_back(integrator);
        const std::scoped_lock lock(mutex_);
        worker.share.seconds += watch.lap().seconds();
    }

    // With the mutex:

    void takeIn(Worker &worker, const Crop &tile, std::uint64_t samplesBefore, double seconds,
                BackendResult result) {
        const std::uint64_t samplesNow = samplesIn(result.film, samplesPerPixel_);
        setRecordsIn(film_, std::span(&tile, 1), result.film);
        rays_ += result.rays;
        BackendResult &total = worker.total;
        total.work += result.work;
        total.timing.dispatchCount += result.timing.dispatchCount;
        total.memory.deviceBytes = std::max(total.memory.deviceBytes, result.memory.deviceBytes);
        total.memory.hostBytes = std::max(total.memory.hostBytes, result.memory.hostBytes);
        if (result.failure && !result.faults.empty())
            result.faults.pop_back(); // after which it was not opened again
        for (const std::string &fault : result.faults)
            total.faults.push_back(worker.share.name + ": " + fault);
        isBegun_ = true;
        const std::uint64_t added = samplesNow - samplesBefore;
        // A driver compiles once, and says nothing of the next tiles.
        const double working = seconds - result.timing.pipelineSeconds - result.timing.uploadSeconds;
        worker.workingSeconds += std::max(working, 1e-6);
        // A tile of the background says little of the next one.
        if (added > 0)
            worker.samplesPerSecond =
                std::min(static_cast<double>(added) / std::max(working, 1e-6),
                         static_cast<double>(worker.share.sampleCount + added) / worker.workingSeconds);
        worker.lastSamples = added;
        worker.share.seconds += seconds;
        worker.share.sampleCount += added;
        ++worker.share.tileCount;
        worker.currentSamples = 0.0;
        finishedSamples_ += static_cast<double>(samplesNow);
        if (result.failure) {
            leaveOut(worker, tile, *result.failure);
            return;
        }
        --busyCount_;
        changed_.notify_all();
        tellProgress();
        if (hooks_.snapshots != nullptr && hooks_.snapshots->isWanted())
            hooks_.snapshots->take([this](Film &copy) { copy = film_; }, rays_);
    }

    void leaveOut(Worker &worker, const Crop &tile, const Error &why) {
        worker.member->failure.emplace(why);
        worker.currentSamples = 0.0;
        worker.share.failure = why.what();
        queue_.giveBack(tile);
        --busyCount_;
        changed_.notify_all();
    }

    void tellProgress() {
        if (!hooks_.onProgress)
            return;
        double samples = finishedSamples_;
        for (const Worker &worker : workers_)
            samples += worker.currentSamples;
        hooks_.onProgress(samples / (static_cast<double>(film_.pixels.size()) * samplesPerPixel_));
    }

    /// Not before there is something to be kept: until then a signal ends the program, which may wait for a compiler.
    [[nodiscard]] bool isToStop() const { return isBegun_ && hooks_.shouldStop && hooks_.shouldStop(); }

    const std::vector<Member> &members_;
    const PackedScene &scene_;
    const RenderSettings &settings_;
    const RenderHooks &hooks_;
    const std::uint32_t samplesPerPixel_;
    std::vector<Worker> workers_;
    SpotCheck spotCheck_;
    std::mutex mutex_; ///< of what follows, and of the workers
    std::condition_variable changed_;
    Film film_;
    TileQueue queue_;
    RayCounts rays_;
    double finishedSamples_; ///< in the film, except for tiles that are being rendered
    bool isBegun_ = false;
    int busyCount_ = 0;
    std::exception_ptr bug_;
};

} // namespace

BackendResult renderShared(std::vector<Member> &members, const PackedScene &scene,
                           const RenderSettings &settings, Film begun, const RenderHooks &hooks) {
    begun.keepLight(lightPlaneNames(scene, settings));
    return SharedRender(members, scene, settings, std::move(begun), hooks).render();
}

} // namespace hyalite::core
