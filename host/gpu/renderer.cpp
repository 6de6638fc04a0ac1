#include "host/gpu/renderer.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/gpu/denoiser.h"
#include "host/gpu/kernel_needs.h"
#include "host/gpu/lane_exchange.h"
#include "host/gpu/pipeline_cache.h"
#include "host/gpu/scene_buffers.h"
#include "host/gpu/tile_renderer.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/device.h"
#include "host/gpu/word_comparison.h"
#include "host/packing/light_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace hyalite::core::gpu {

namespace {

/// Bands of whole rows, from top to bottom, whose films fit into a storage buffer and a quarter of the device memory.
std::vector<Crop> cutIntoBands(const Film &film, const DeviceInfo &device) {
    const Crop &crop = film.crop;
    const std::uint64_t pixelBytes = sizeof(layout::FilmPixel) + film.lightSize() * sizeof(float);
    const std::uint64_t rowBytes = static_cast<std::uint64_t>(crop.width()) * pixelBytes;
    const std::uint64_t maxFilmBytes =
        std::min(maxBufferBytes(BufferUse::Storage, device), device.deviceMemoryBytes / 4);
    const int rows = static_cast<int>(
        std::clamp<std::uint64_t>(maxFilmBytes / rowBytes, 1, static_cast<std::uint64_t>(crop.height())));
    std::vector<Crop> bands;
    for (int y = crop.y0; y < crop.y1; y += rows)
        bands.push_back({crop.x0, crop.x1, y, std::min(y + rows, crop.y1)});
    return bands;
}

/// Number of further attempts after a failure.
constexpr int maxRetries = 3;
constexpr std::uint32_t minSteps = 256; // lower bound when dispatches are halved

} // namespace

/// When to copy the film to the host, because a lost device loses its film: often, except for at most a hundredth of
/// the time.
class FilmKeeper {
  public:
    [[nodiscard]] bool isDue() const { return hostNanos() >= dueNanos_; }
    void keep(const std::function<void()> &copy) {
        const std::int64_t begin = hostNanos();
        copy();
        const std::int64_t end = hostNanos();
        dueNanos_ = end + 100 * (end - begin);
    }

  private:
    std::int64_t dueNanos_ = 0;
};

/// A scene that stays on the device until another one is rendered.
struct ResidentScene {
    std::uint64_t serial;
    const KernelRow &kernel; ///< that reads its buffers
    std::uint64_t sizeBytes;
    SceneBuffers buffers;
    std::map<Integrator, DispatchCosts> costs{}; ///< of its renders so far
};

struct Renderer::State {
    DeviceInfo info;
    std::optional<Device> device; ///< empty if it failed and could not be opened again
    RenderConfig wanted;
    KernelChoices preferred;
    RenderConfig config; ///< after faults, for less at a time
    RenderConfig faultless;
    StartupCheck check; ///< of the device
    ArithmeticChoice arithmetic;
    BitGuarantee bits;
    PipelineCache pipelines;                 ///< of the device
    std::optional<ResidentScene> resident{}; ///< likewise

    State(const DeviceInfo &deviceInfo, const RenderConfig &asked, const KernelChoices &choices)
        : info(deviceInfo), device(std::in_place, info, transfers(asked)), preferred(choices),
          check(checkDevice(*device)) {
        info.consecutiveLanes = check.consecutiveLanes;
        if (!info.hasSlowShuffles && mayGainFromBroadcasts(info))
            info.hasSlowShuffles = areBroadcastsFaster(*device);
        bits = guaranteeOf(info, check);
        configure(asked);
    }

    void configure(const RenderConfig &asked) {
        wanted = asked;
        arithmetic = chooseArithmetic(info, check, asked.arithmetic);
        config = completed(asked, info);
        config.arithmetic = arithmetic.isNative ? Arithmetic::Native : Arithmetic::Own;
        faultless = config;
    }

    static Transfers transfers(const RenderConfig &config) {
        return config.isStaged ? Transfers::Staged : Transfers::Automatic;
    }

    /// The configuration for an integrator and a scene.
    [[nodiscard]] RenderConfig configFor(const PackedScene &scene, Integrator integrator,
                                         bool showsWork) const {
        RenderConfig used = config;
        used.kernel = wanted.kernel;
        used.samplesInFlight = wanted.samplesInFlight;
        const Workload workload = workloadOf(scene, integrator);
        if (showsWork) {
            used.isCounting = true;
            used.kernel = &kernelOfCost(workload);
        } else if (used.kernel == nullptr) {
            used.kernel = preferred[static_cast<std::size_t>(workload)];
        }
        used = completed(used, info, workload);
        // Only the user's choice is better refused than replaced.
        if (wanted.kernel == nullptr && used.kernel->memory == KernelMemory::Texels &&
            !areTexelsAllowed(scene, *used.kernel, info)) {
            const KernelRow &other = chooseKernel(
                info, workload, [](const KernelRow &row) { return row.memory != KernelMemory::Texels; });
            if (lackFor(other, info).empty()) {
                used.kernel = &other;
                used = completed(used, info, workload);
            }
        }
        if (const std::string lack = lackFor(*used.kernel, info); !lack.empty())
            throw Error(
                ErrorKind::LimitExceeded,
                fmt::format("the kernel {} cannot run on {}: it {}", gpu::kernelName(used), info.name, lack),
                wanted.kernel == nullptr ? Remedy::ReferenceInstead : Remedy::NoKernelChoice);
        return used;
    }

    /// The kernel whose work samples show. Throws Error{Usage} if another one is wanted.
    [[nodiscard]] const KernelRow &kernelOfCost(Workload workload) const {
        if (wanted.kernel == nullptr)
            return chooseKernel(info, workload, countsCost);
        if (countsCost(*wanted.kernel))
            return *wanted.kernel;
        std::string allowed;
        for (const KernelRow &row : kernelTable)
            if (countsCost(row))
                allowed += fmt::format("{}, ", row.name);
        throw Error(ErrorKind::Usage,
                    fmt::format("the cost is that of a traversal with a stack: found the kernel {}; "
                                "allowed: {}or auto",
                                wanted.kernel->name, allowed));
    }

    [[nodiscard]] MemoryPlan requireMemory(const ScenePlan &scene, const JobPlan &job) const {
        return gpu::requireMemory(scene, job, device->isStagingPreferred(), info,
                                  resident ? resident->sizeBytes : 0);
    }

    /// Frees the device's memory, unless the scene in it is this one.
    void keepOnly(const PackedScene &scene, const KernelRow &kernel) {
        if (resident &&
            (scene.serial == 0 || resident->serial != scene.serial || !shareScenes(resident->kernel, kernel)))
            resident.reset();
    }

    /// The scene on the device, after keepOnly().
    const SceneBuffers &buffersOf(const Job &job, const ScenePlan &plan, const KernelRow &kernel) {
        if (!resident) {
            const std::uint64_t before = device->allocatedBytes();
            SceneBuffers buffers(*device, job.scene, plan, kernel);
            resident.emplace(ResidentScene{job.scene.serial, kernel, device->allocatedBytes() - before,
                                           std::move(buffers)});
        }
        resident->buffers.setFrame(frameOf(job.scene, job.settings));
        return resident->buffers;
    }

    /// Drops all that is on the device.
    void forget() {
        resident.reset();
        pipelines.clear();
    }

    /// Opens the device again, with half the work per dispatch. Throws DeviceFault.
    void reopen() {
        forget();
        device.reset();
        config.tileHeight = std::max(config.tileHeight / 2 / 8 * 8, 8);
        config.steps = std::max(config.steps / 2, std::min(config.steps, minSteps));
        config.dispatchSeconds /= 2.0;
        try {
            device.emplace(info, transfers(config));
        } catch (const DeviceFault &) {
            throw;
        } catch (const Error &error) { // the device is gone
            throw DeviceFault(error.kind, error.what());
        }
    }
};

/// The pixels of a band in the film.
struct BandRange {
    std::size_t first;
    std::size_t count;

    [[nodiscard]] std::span<layout::FilmPixel> pixelsOf(FilmRecords &film) const {
        return std::span(film.pixels).subspan(first, count);
    }
    [[nodiscard]] std::span<float> lightOf(FilmRecords &film) const {
        const std::size_t size = film.lightSize();
        return std::span(film.light).subspan(first * size, count * size);
    }
    void read(const TileRenderer &tiles, FilmRecords &film) const {
        tiles.readFilm(pixelsOf(film), lightOf(film));
    }
};

/// One attempt at a render: adds the missing samples to the result, and keeps its film and rays consistent.
class Renderer::Attempt {
  public:
    /// `isBegun`: the film of the result may have samples.
    Attempt(State &state, const PackedScene &scene, const RenderSettings &settings, bool isBegun,
            const RenderHooks &hooks, Result &result)
        : state_(state), scene_(scene), settings_(settings), isBegun_(isBegun), hooks_(hooks),
          result_(result), config_(state.configFor(scene, settings.integrator, showsWork(settings))),
          scenePlan_(planScene(scene, *config_.kernel)) {}

    void run() {
        if (hooks_.timeline != nullptr)
            hooks_.timeline->clock = state_.device->timestamps().describe();
        const std::vector<Crop> bands = cutIntoBands(result_.film, state_.info);
        const Job firstJob = jobOf(bands.front());
        const JobPlan firstPlan = planJob(firstJob, config_, state_.info);
        state_.keepOnly(scene_, *config_.kernel);
        Job whole = firstJob; // all pixels of the largest band, with all of their samples
        whole.film = {};
        result_.memory = state_.requireMemory(scenePlan_, planJob(whole, config_, state_.info));
        // A driver compiles a pipeline on one processor. Meanwhile the others prepare the buffers, if they are not
        // there.
        const std::launch when = state_.resident ? std::launch::deferred : std::launch::async;
        std::future<void> firstPipeline = std::async(when, [&] {
            TileRenderer::makePipeline(*state_.device, state_.pipelines, config_, firstJob, scenePlan_,
                                       firstPlan);
        });
        const SceneBuffers &buffers = state_.buffersOf(firstJob, scenePlan_, *config_.kernel);
        result_.timing.uploadSeconds = endStage("upload");
        for (const Crop &band : bands)
            if (!renderBand(band, buffers, firstPipeline))
                return;
    }

  private:
    [[nodiscard]] BandRange rangeOf(const Crop &band) const {
        return {result_.film.crop.indexOf(band.x0, band.y0), band.pixelCount()};
    }

    [[nodiscard]] Job jobOf(const Crop &band) const {
        Job job{scene_, settings_, band, 0, static_cast<std::uint32_t>(settings_.samplesPerPixel), false};
        if (isBegun_) {
            job.film = rangeOf(band).pixelsOf(result_.film);
            job.light = rangeOf(band).lightOf(result_.film);
        }
        return job;
    }

    /// Returns the time of the stage.
    double endStage(const char *name) {
        const Span span = watch_.lap();
        if (hooks_.timeline != nullptr)
            hooks_.timeline->stages.push_back({name, span, state_.device->allocatedBytes()});
        return span.seconds();
    }

    /// Returns false if the hooks stop the render.
    bool renderBand(const Crop &band, const SceneBuffers &buffers, std::future<void> &firstPipeline) {
        const Crop crop = result_.film.crop;
        const BandRange range = rangeOf(band);
        const Job job = jobOf(band);
        const RayCounts raysBefore = result_.rays;
        DispatchCosts &costs = state_.resident->costs[settings_.integrator];
        RenderTiming &timing = result_.timing;
        TileRenderer tiles(*state_.device, state_.pipelines, buffers, config_, job, scenePlan_,
                           planJob(job, config_, state_.info), costs);
        timing.pipelineSeconds += endStage("buffers");
        if (firstPipeline.valid())
            firstPipeline.get();
        tiles.makeKernel();
        timing.pipelineSeconds += endStage("pipeline");
        tiles.warmUp();
        timing.pipelineSeconds += endStage("first dispatch");

        const double rowsBefore = band.y0 - crop.y0;
        const TileTotals totals = tiles.run(
            [&](double share) {
                if (hooks_.onProgress)
                    hooks_.onProgress((rowsBefore + share * band.height()) / crop.height());
            },
            hooks_.timeline, hooks_.shouldStop,
            [&](const RayCounts &rays) { copyFilm(tiles, range, raysBefore + rays); });
        if (range.count >= DispatchSizer::minPixels) // fewer leave most slots idle
            costs = tiles.costs();
        result_.work += totals.work;
        result_.lanes += totals.lanes;
        timing.dispatchCount += totals.dispatchCount;
        timing.pipelineSeconds += tiles.lateBuildSeconds();
        timing.renderSeconds += endStage("dispatches") - tiles.lateBuildSeconds();
        range.read(tiles, result_.film);
        result_.rays = raysBefore + totals.rays;
        endStage("readback");
        return !totals.isStopped;
    }

    /// Between two dispatches: copies the film to the result and to a snapshot, if it is time.
    void copyFilm(const TileRenderer &tiles, const BandRange &range, const RayCounts &rays) {
        // The work of lost dispatches is unknown, so a render that counts starts again.
        if (!config_.isCounting && keeper_.isDue()) {
            keeper_.keep([&] { range.read(tiles, result_.film); });
            result_.rays = rays;
        }
        if (hooks_.snapshots == nullptr || !hooks_.snapshots->isWanted())
            return;
        const auto copyTo = [&](Film &copy) {
            copy = result_.film; // other bands have all their samples, or those from before the render
            range.read(tiles, copy);
        };
        hooks_.snapshots->take(copyTo, rays);
    }

    State &state_;
    const PackedScene &scene_;
    const RenderSettings &settings_;
    const bool isBegun_;
    const RenderHooks &hooks_;
    Result &result_;
    Stopwatch watch_;
    FilmKeeper keeper_;
    const RenderConfig config_;
    const ScenePlan scenePlan_;
};

Renderer::Renderer(const DeviceInfo &device, const RenderConfig &config, const KernelChoices &preferred)
    : state_(std::make_unique<State>(device, config, preferred)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer &&) noexcept = default;
Renderer &Renderer::operator=(Renderer &&) noexcept = default;

void Renderer::configure(const RenderConfig &config) {
    assert(config.isStaged == state_->wanted.isStaged);
    state_->configure(config);
}

const DeviceInfo &Renderer::device() const { return state_->info; }

const ArithmeticChoice &Renderer::arithmetic() const { return state_->arithmetic; }

const BitGuarantee &Renderer::bits() const { return state_->bits; }

std::string_view Renderer::kernelName(const PackedScene &scene, Integrator integrator) const {
    return gpu::kernelName(state_->configFor(scene, integrator, integrator == Integrator::Cost));
}

std::uint64_t Renderer::kernelHash(const PackedScene &scene, Integrator integrator) const {
    return hashBytes(std::as_bytes(
        kernelWords(state_->configFor(scene, integrator, integrator == Integrator::Cost), integrator)));
}

Result Renderer::render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                        const RenderHooks &hooks) {
    bool isBegun = std::ranges::any_of(begun.pixels, [](const auto &pixel) { return pixel.sampleCount > 0; });
    begun.keepLight(lightPlaneNames(scene, settings));
    state_->config = state_->faultless; // a fault of a former render says little of this one
    Result result{std::move(begun), {}, {}, {}};
    for (int retry = 0;; ++retry) {
        try {
            if (retry > 0 || !state_->device)
                state_->reopen();
            Attempt(*state_, scene, settings, isBegun, hooks, result).run();
            return result;
        } catch (const DeviceFault &fault) {
            state_->forget();
            result.faults.emplace_back(fault.what());
            isBegun = true;
            if (retry == maxRetries) {
                const bool isGone = fault.kind == ErrorKind::NoDevice;
                result.failure.emplace(
                    isGone ? ErrorKind::DeviceLost : fault.kind,
                    fmt::format("{}; the device was reopened {} times, for half as much at a "
                                "time each, and failed each time",
                                fault.what(), maxRetries));
                return result;
            }
            if (hooks.shouldStop && hooks.shouldStop())
                return result;
        }
    }
}

void Renderer::repeat(const PackedScene &scene, const RenderSettings &settings, const Film &expected,
                      const RepeatHooks &hooks) {
    const Job job{scene, settings, expected.crop, 0, static_cast<std::uint32_t>(settings.samplesPerPixel),
                  false};
    try {
        if (!state_->device)
            state_->reopen();
        const RenderConfig config = state_->configFor(scene, settings.integrator, showsWork(settings));
        const ScenePlan scenePlan = planScene(scene, *config.kernel);
        const JobPlan plan = planJob(job, config, state_->info);
        state_->keepOnly(scene, *config.kernel);
        (void)state_->requireMemory(scenePlan, plan);
        const SceneBuffers &buffers = state_->buffersOf(job, scenePlan, *config.kernel);
        TileRenderer tiles(*state_->device, state_->pipelines, buffers, config, job, scenePlan, plan);
        tiles.makeKernel();
        tiles.warmUp();
        const std::span<const std::uint32_t> words(
            reinterpret_cast<const std::uint32_t *>(expected.pixels.data()),
            expected.pixels.size() * sizeof(layout::FilmPixel) / sizeof(std::uint32_t));
        ExpectedWords expectedWords(*state_->device, words);
        const auto film = [&] {
            Film copy(expected.crop);
            tiles.readFilm(copy.pixels, copy.light);
            return copy;
        };
        for (bool goesOn = true; goesOn;) {
            RepeatedPass pass;
            Stopwatch watch;
            tiles.restart();
            const TileTotals totals = tiles.run({}, &pass.timeline, hooks.shouldStop);
            if (totals.isStopped)
                return;
            pass.rays = totals.rays;
            pass.renderSeconds = watch.lap().seconds();
            pass.isEqual =
                expectedWords.compare(tiles.film(), static_cast<std::uint32_t>(words.size())).count == 0;
            pass.compareSeconds = watch.lap().seconds();
            pass.film = film;
            pass.laneOf = [&](const glm::uvec2 &pixel, std::uint32_t sample) {
                return tiles.laneOf(pixel, sample);
            };
            goesOn = hooks.onPass(pass);
        }
    } catch (const DeviceFault &) {
        state_->forget();
        state_->device.reset();
        throw;
    }
}

std::vector<layout::TraceEvent> Renderer::trace(const PackedScene &scene, const RenderSettings &settings,
                                                const glm::uvec2 &pixel, std::uint32_t sampleIndex) {
    const int x = static_cast<int>(pixel.x);
    const int y = static_cast<int>(pixel.y);
    const Job job{scene, settings, {x, x + 1, y, y + 1}, sampleIndex, sampleIndex + 1, true};
    if (!state_->device)
        state_->reopen();
    const RenderConfig config = state_->configFor(scene, settings.integrator, showsWork(settings));
    const KernelRow &kernel = *config.kernel;
    const ScenePlan scenePlan = planScene(scene, kernel);
    const JobPlan jobPlan = planJob(job, config, state_->info);
    state_->keepOnly(scene, kernel);
    (void)state_->requireMemory(scenePlan, jobPlan);
    const SceneBuffers &buffers = state_->buffersOf(job, scenePlan, kernel);
    TileRenderer tiles(*state_->device, state_->pipelines, buffers, config, job, scenePlan, jobPlan);
    tiles.makeKernel();
    (void)tiles.run({});
    return tiles.readTrace();
}

Image Renderer::denoise(const NoisyPicture &picture) {
    const auto attempt = [&] {
        if (!state_->device)
            state_->reopen();
        return gpu::denoise(*state_->device, state_->pipelines, state_->arithmetic.isNative, picture);
    };
    try {
        return attempt();
    } catch (const DeviceFault &) {
        state_->forget();
        state_->device.reset();
    }
    return attempt();
}

} // namespace hyalite::core::gpu
