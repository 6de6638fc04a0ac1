#include "host/lab/verify.h"

#include "host/base/error.h"
#include "host/gpu/vk/device_list.h"
#include "host/lab/comparison_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <iterator>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace hyalite::core {

namespace {

struct Kernel {
    const gpu::KernelRow *row = nullptr; ///< null for the CPU

    [[nodiscard]] std::string name() const { return row != nullptr ? std::string(row->name) : ""; }
    /// The cost is that of node pairs and a stack, so that other kernels have none.
    [[nodiscard]] bool renders(const ShippedFilm &film) const {
        return row == nullptr || (row->raysAtOnce <= film.maxSlots &&
                                  (film.integrator != Integrator::Cost || countsCost(*row)));
    }
};

/// The kernels in groups that are opened one after the other: lavapipe has one vector width at a time, and a render's
/// depends on whether its kernel has a stack (host/process/lavapipe.h).
std::vector<std::vector<Kernel>> groupsOf(const std::string &device, const std::vector<std::string> &wanted) {
    std::vector<std::vector<Kernel>> groups(1);
    if (isReference(device)) {
        groups.front().emplace_back();
        return groups;
    }
    const gpu::DeviceInfo info = gpu::chooseDevice(gpu::listDevices(), device);
    for (const gpu::KernelRow &row : gpu::kernelTable) {
        if (wanted.empty() ? row.suits.isByNameOn(info) : std::ranges::find(wanted, row.name) == wanted.end())
            continue;
        std::vector<Kernel> &last = groups.back();
        const bool isOfLast = last.empty() || walksWithStack(*last.back().row) == walksWithStack(row);
        (isOfLast ? last : groups.emplace_back()).push_back({&row});
    }
    return groups;
}

/// A film by a kernel of a group.
struct Task {
    std::size_t kernel;
    const ShippedFilm *film;
};

/// Film by film, the last ones first, which are of the largest scenes.
std::vector<Task> tasksOf(const std::vector<Kernel> &kernels, const ShippedFilms &shipped) {
    std::vector<Task> tasks;
    for (std::size_t i = shipped.films.size(); i-- > 0;)
        for (std::size_t kernel = 0; kernel < kernels.size(); ++kernel)
            if (kernels[kernel].renders(shipped.films[i]))
                tasks.push_back({kernel, &shipped.films[i]});
    return tasks;
}

/// A renderer for each kernel that has something to render.
using Renderers = std::vector<std::unique_ptr<Backend>>;

Renderers openAll(const std::vector<Kernel> &kernels, const std::vector<Task> &tasks,
                  const std::string &device, Observer &observer) {
    Renderers renderers(kernels.size());
    for (const Task &task : tasks) {
        if (renderers[task.kernel] != nullptr)
            continue;
        DeviceOptions options;
        options.kernel = kernels[task.kernel].row;
        renderers[task.kernel] = openBackend(device, observer, {}, renderConfigFor(options));
    }
    return renderers;
}

PreparedScene prepare(const ShippedFilms &shipped, const ShippedFilm &film) {
    SceneOptions options;
    options.scene = shipped.fileOf(film).string();
    options.settings.push_back(
        {[&film](RenderSettings &settings) { settings.integrator = film.integrator; }});
    return prepareScene(options, Source::Dropped, nobody());
}

/// The first dispatch that rendered this pixel.
std::optional<DispatchRecord> dispatchOf(const Timeline &timeline, const glm::ivec2 &pixel) {
    const auto first = std::ranges::find_if(timeline.dispatches, [&](const DispatchRecord &dispatch) {
        return pixel.x >= dispatch.tileX && pixel.x < dispatch.tileX + dispatch.tileWidth &&
               pixel.y >= dispatch.tileY && pixel.y < dispatch.tileY + dispatch.tileHeight;
    });
    return first == timeline.dispatches.end() ? std::nullopt : std::optional(*first);
}

/// Compares a film with that of the CPU twin, which is rendered for it.
FilmDifference explain(Backend &backend, const PreparedScene &scene, const Film &film,
                       const Timeline &timeline) {
    const std::unique_ptr<Backend> twin = openBackend("cpu", nobody());
    const Film wanted = twin->render(scene.packed, scene.loaded.settings, scene.crop).film;
    FilmDifference difference;
    difference.pixelCount = differingPixelCount(film, wanted);
    const std::size_t first = firstDifference(film, wanted);
    if (first == film.pixels.size())
        return difference;
    const auto index = static_cast<int>(first);
    const glm::ivec2 pixel(scene.crop.x0 + index % scene.crop.width(),
                           scene.crop.y0 + index / scene.crop.width());
    difference.pixel = pixel;
    difference.dispatch = dispatchOf(timeline, pixel);
    difference.divergence = findFirstDivergence(backend, *twin, scene, difference.pixel);
    return difference;
}

/// Throws Error of the stop's kind once the observer wants one.
void throwIfStopped(Observer &observer) {
    if (const std::optional<Stop> stop = observer.wantsStop())
        throw Error(stop->kind, fmt::format("stopped by {} before all films were verified", stop->by));
}

FilmVerdict judge(Backend &backend, const Kernel &kernel, const PreparedScene &scene, const ShippedFilm &film,
                  Observer &observer) {
    FilmVerdict verdict;
    verdict.film = film;
    verdict.kernel = kernel.name();
    Stopwatch watch;
    try {
        Timeline timeline;
        RenderHooks hooks{.timeline = kernel.row == nullptr ? nullptr : &timeline};
        hooks.shouldStop = [&] { return observer.wantsStop().has_value(); };
        const BackendResult result = backend.render(scene.packed, scene.loaded.settings, scene.crop, hooks);
        verdict.seconds = watch.lap().seconds();
        verdict.hash = filmHash(result.film);
        if (result.failure)
            verdict.failure = result.failure->what();
        else if (!result.faults.empty())
            verdict.failure = result.faults.front();
        const bool isWhole = !result.failure && !observer.wantsStop();
        if (isWhole && verdict.hash != film.hash)
            verdict.difference = explain(backend, scene, result.film, timeline);
    } catch (const Error &error) {
        (error.kind == ErrorKind::LimitExceeded ? verdict.lack : verdict.failure) = error.what();
    }
    throwIfStopped(observer); // its film may lack samples
    return verdict;
}

// Drivers compile on one processor each; more would gain little, and each has a scene in memory.
constexpr unsigned maxWorkers = 4;

/// Calls work(renderers, index) for each of `count` tasks, by several threads with renderers of their own.
void runAll(std::vector<Renderers> &workers, std::size_t count,
            const std::function<void(Renderers &, std::size_t)> &work) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::future<void>> running;
    running.reserve(workers.size());
    for (Renderers &renderers : workers)
        running.push_back(std::async(std::launch::async, [&] {
            for (std::size_t i = next++; i < count; i = next++)
                work(renderers, i);
        }));
    for (std::future<void> &worker : running)
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

DeviceVerdict verifyDevice(const std::string &device, const ShippedFilms &shipped, Observer &observer,
                           const std::vector<std::string> &wanted,
                           const std::function<void(const FilmVerdict &, double)> &onFilm) {
    const std::vector<std::vector<Kernel>> groups = groupsOf(device, wanted);
    std::size_t filmCount = 0;
    for (const std::vector<Kernel> &kernels : groups)
        filmCount += tasksOf(kernels, shipped).size();
    const unsigned workerCount =
        isReference(device) ? 1 : std::clamp(std::thread::hardware_concurrency(), 1u, maxWorkers);
    DeviceVerdict verdict;
    std::mutex mutex;
    std::size_t finishedCount = 0;
    for (const std::vector<Kernel> &kernels : groups) {
        const std::vector<Task> tasks = tasksOf(kernels, shipped);
        if (tasks.empty())
            continue;
        std::vector<Renderers> workers;
        for (std::size_t i = 0; i < std::min<std::size_t>(workerCount, tasks.size()); ++i)
            workers.push_back(openAll(kernels, tasks, device, observer));
        const Backend &first = *workers.front()[tasks.front().kernel];
        verdict.device = first.name();
        verdict.description = first.description();
        verdict.bits = first.bits();
        std::vector<FilmVerdict> verdicts(tasks.size());
        runAll(workers, tasks.size(), [&](Renderers &renderers, std::size_t i) {
            throwIfStopped(observer);
            const auto &[kernel, film] = tasks[i];
            verdicts[i] =
                judge(*renderers[kernel], kernels[kernel], prepare(shipped, *film), *film, observer);
            const std::lock_guard lock(mutex);
            ++finishedCount;
            if (onFilm)
                onFilm(verdicts[i], static_cast<double>(finishedCount) / static_cast<double>(filmCount));
        });
        // As people read them: kernel by kernel.
        for (std::size_t kernel = 0; kernel < kernels.size(); ++kernel)
            for (std::size_t i = tasks.size(); i-- > 0;)
                if (tasks[i].kernel == kernel)
                    verdict.films.push_back(std::move(verdicts[i]));
    }
    return verdict;
}

} // namespace hyalite::core
