#include "host/render/verify.h"

#include "host/base/error.h"
#include "host/render/contest.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <iterator>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace hyalite {

namespace {

/// A renderer with one kernel, and its films so far.
struct Contender {
    std::string kernel;
    gpu::KernelChoice choice;
    std::unique_ptr<Backend> backend;
    std::vector<FilmVerdict> films{};

    /// The cost is that of a traversal with a stack, so that other kernels have none.
    [[nodiscard]] bool renders(const ShippedFilm &film) const {
        return choice.slotsPerInvocation <= film.maxSlots &&
               (film.integrator != Integrator::Cost || choice.traversal != gpu::Traversal::SkipList);
    }
};

std::vector<Contender> openAll(const std::string &device) {
    std::vector<Contender> contenders;
    if (isReference(device)) {
        contenders.push_back({"", {}, openBackend(device)});
        return contenders;
    }
    for (const auto &[name, choice] : gpu::namedKernels) {
        DeviceOptions options;
        options.kernel = choice;
        contenders.push_back({std::string(name), choice, openBackend(device, {}, renderConfigFor(options))});
    }
    return contenders;
}

PreparedScene prepare(const ShippedFilms &shipped, const ShippedFilm &film) {
    SceneOptions options;
    options.scene = shipped.fileOf(film).string();
    options.settings.push_back(
        {[&film](RenderSettings &settings) { settings.integrator = film.integrator; }});
    return prepareScene(options, Source::Dropped, true);
}

bool areEqual(const layout::FilmPixel &a, const layout::FilmPixel &b) {
    return a.sum == b.sum && a.sumOfSquares == b.sumOfSquares && a.sampleCount == b.sampleCount;
}

/// The first dispatch that rendered this pixel.
std::optional<DispatchRecord> dispatchOf(const Timeline &timeline, const glm::ivec2 &pixel) {
    const auto found = std::ranges::find_if(timeline.dispatches, [&](const DispatchRecord &dispatch) {
        return pixel.x >= dispatch.tileX && pixel.x < dispatch.tileX + dispatch.tileWidth &&
               pixel.y >= dispatch.tileY && pixel.y < dispatch.tileY + dispatch.tileHeight;
    });
    return found == timeline.dispatches.end() ? std::nullopt : std::optional(*found);
}

/// Compares a film with that of the CPU twin, which is rendered for it.
FilmDifference explain(Backend &backend, const PreparedScene &scene, const Film &film,
                       const Timeline &timeline) {
    const std::unique_ptr<Backend> twin = openBackend("cpu");
    const Film wanted = twin->render(scene, {}, nullptr, {}, {}).film;
    FilmDifference difference;
    difference.pixelCount = differingPixelCount(film, wanted);
    const auto first = std::ranges::mismatch(film.pixels, wanted.pixels, areEqual).in1;
    if (first == film.pixels.end())
        return difference;
    const auto index = static_cast<int>(first - film.pixels.begin());
    const glm::ivec2 pixel(scene.crop.x0 + index % scene.crop.width(),
                           scene.crop.y0 + index / scene.crop.width());
    difference.pixel = pixel;
    difference.dispatch = dispatchOf(timeline, pixel);
    difference.divergence = findFirstDivergence(backend, *twin, scene, difference.pixel);
    return difference;
}

FilmVerdict judge(Contender &contender, const PreparedScene &scene, const ShippedFilm &film) {
    FilmVerdict verdict;
    verdict.film = film;
    verdict.kernel = contender.kernel;
    Stopwatch watch;
    try {
        Timeline timeline;
        const BackendResult result =
            contender.backend->render(scene, {}, contender.kernel.empty() ? nullptr : &timeline, {}, {});
        verdict.seconds = watch.lap().seconds();
        verdict.hash = filmHash(result.film);
        if (result.failure)
            verdict.failure = result.failure->what();
        else if (!result.faults.empty())
            verdict.failure = result.faults.front();
        if (!result.failure && verdict.hash != film.hash)
            verdict.difference = explain(*contender.backend, scene, result.film, timeline);
    } catch (const Error &error) {
        (error.kind == ErrorKind::LimitExceeded ? verdict.lack : verdict.failure) = error.what();
    }
    return verdict;
}

/// Calls `work` for each contender, as many at a time as there are processors: drivers compile on one each.
void runAll(std::vector<Contender> &contenders, const std::function<void(Contender &)> &work) {
    std::atomic<std::size_t> next = 0;
    const auto workSome = [&] {
        for (std::size_t i = next++; i < contenders.size(); i = next++)
            work(contenders[i]);
    };
    std::vector<std::future<void>> workers;
    for (unsigned i = 1; i < std::min<std::size_t>(std::thread::hardware_concurrency(), contenders.size());
         ++i)
        workers.push_back(std::async(std::launch::async, workSome));
    workSome();
    for (std::future<void> &worker : workers)
        worker.get();
}

} // namespace

bool DeviceVerdict::isPassed() const {
    const auto isRendered = [&](const FilmVerdict &verdict) {
        return std::ranges::any_of(films, [&](const FilmVerdict &other) {
            return !other.isSkipped() && other.film.scene == verdict.film.scene &&
                   other.film.integrator == verdict.film.integrator;
        });
    };
    return !films.empty() && std::ranges::none_of(films, &FilmVerdict::isFaulty) &&
           std::ranges::all_of(films, isRendered);
}

DeviceVerdict verifyDevice(const std::string &device, const ShippedFilms &shipped,
                           const std::function<void(const FilmVerdict &, double)> &onFilm) {
    std::vector<Contender> contenders = openAll(device);
    std::size_t filmCount = 0;
    for (const Contender &contender : contenders)
        filmCount += static_cast<std::size_t>(std::ranges::count_if(
            shipped.films, [&](const ShippedFilm &film) { return contender.renders(film); }));
    std::mutex mutex;
    std::size_t finishedCount = 0;
    const auto renderAll = [&](Contender &contender) {
        for (const ShippedFilm &film : shipped.films) {
            if (!contender.renders(film))
                continue;
            contender.films.push_back(judge(contender, prepare(shipped, film), film));
            const std::lock_guard lock(mutex);
            ++finishedCount;
            if (onFilm)
                onFilm(contender.films.back(),
                       static_cast<double>(finishedCount) / static_cast<double>(filmCount));
        }
    };
    runAll(contenders, renderAll);
    const Backend &first = *contenders.front().backend;
    DeviceVerdict verdict{first.name(), first.description(), first.bits(), {}};
    for (Contender &contender : contenders)
        std::ranges::move(contender.films, std::back_inserter(verdict.films));
    return verdict;
}

} // namespace hyalite
