#include "host/gpu/renderer.h"

#include "host/error.h"
#include "host/gpu/kernel.h"
#include "host/gpu/scene_buffers.h"
#include "whittedSkipOneSlot.h"
#include "whittedSkipTwoSlots.h"
#include "whittedStackOneSlot.h"
#include "whittedStackTwoSlots.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>

namespace hyalite::gpu {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr std::uint32_t workgroupSize = 64;
constexpr std::uint32_t traceCapacity = 1u << 17;

/// Fills in what the caller left to the device.
Batching chooseBatching(Batching batching, const DeviceInfo &device) {
    // A software device has few cores and wants to report progress; a GPU wants to be filled.
    const int side = device.isSoftware() ? 128 : 512;
    if (batching.tileWidth == 0)
        batching.tileWidth = side;
    if (batching.tileHeight == 0)
        batching.tileHeight = side;
    // Two independent rays at once hide latency on a CPU; on a GPU other subgroups do, and registers are short.
    if (batching.slotsPerInvocation == 0)
        batching.slotsPerInvocation = device.isSoftware() && batching.kernel.empty() ? 2 : 1;
    // lavapipe stops a subgroup in silence after 65,535 loop iterations of all of its lanes together. The lanes count
    // for themselves, and lanes that diverge add up.
    const std::uint32_t limit = 65535u / (std::max(device.subgroupSize, 1u) + 1u);
    if (batching.traversal == Traversal::Automatic)
        batching.traversal =
            device.isSoftware() && batching.kernel.empty() ? Traversal::SkipList : Traversal::Stack;
    if (batching.steps == 0)
        batching.steps = 4096;
    if (device.isSoftware())
        batching.steps = std::min(batching.steps, limit);
    return batching;
}

std::span<const std::uint32_t> chooseKernel(const Batching &batching) {
    using Words = std::span<const std::uint32_t>;
    if (!batching.kernel.empty())
        return batching.kernel;
    if (batching.traversal == Traversal::SkipList)
        return batching.slotsPerInvocation == 2 ? Words(whittedSkipTwoSlots) : Words(whittedSkipOneSlot);
    return batching.slotsPerInvocation == 2 ? Words(whittedStackTwoSlots) : Words(whittedStackOneSlot);
}

/// A tile is a whole number of blocks of 8x8 pixels, which are 64 slots.
int fitTile(int pixels, int tile) { return std::min((pixels + 7) / 8 * 8, tile); }

/// Bands of whole rows whose films fit into a storage buffer of the device, from top to bottom.
std::vector<Crop> cutIntoBands(const Crop &crop, const DeviceInfo &device) {
    const std::uint64_t rowBytes = static_cast<std::uint64_t>(crop.width()) * sizeof(layout::FilmPixel);
    const int rows = static_cast<int>(std::clamp<std::uint64_t>(device.maxStorageBufferBytes / rowBytes, 1,
                                                                static_cast<std::uint64_t>(crop.height())));
    std::vector<Crop> bands;
    for (int y = crop.y0; y < crop.y1; y += rows)
        bands.push_back({crop.x0, crop.x1, y, std::min(y + rows, crop.y1)});
    return bands;
}

/// What a render is asked to do.
struct Job {
    const PackedScene &scene;
    Crop crop;
    SamplerKind sampler;
    std::uint32_t sampleBegin;
    std::uint32_t sampleEnd;
    bool isTraced;
};

/// Everything that a job needs on the device, and the loop over its tiles.
class TileRenderer {
  public:
    TileRenderer(Device &device, const SceneBuffers &buffers, const Batching &batching, const Job &job)
        : device_(device), job_(job), tileWidth_(fitTile(job.crop.width(), batching.tileWidth)),
          tileHeight_(fitTile(job.crop.height(), batching.tileHeight)),
          slotCount_(static_cast<std::size_t>(tileWidth_) * static_cast<std::size_t>(tileHeight_)),
          // One subtree waits for each level at most; kernels of a few sizes are enough.
          stackSize_(std::bit_ceil(
              std::clamp(static_cast<std::uint32_t>(job.scene.treeDepth), 8u, layout::maxTreeDepth))),
          buffers_(buffers),
          film_(device, "the film", BufferUse::Storage, filmPixelCount() * sizeof(layout::FilmPixel)),
          progress_(device, "the counters", BufferUse::Counters, sizeof(layout::DispatchProgress)),
          paths_(device, "the path slots", BufferUse::Storage, slotCount_ * sizeof(layout::PathRecord)),
          pending_(device, "the pending rays", BufferUse::Storage,
                   job.scene.hasDielectric
                       ? slotCount_ * job.scene.frame.maxDepth * sizeof(layout::PendingRay)
                       : 0),
          stacks_(device, "the traversal stacks", BufferUse::Storage,
                  job.scene.hasTriangles ? slotCount_ * stackSize_ * sizeof(std::uint32_t) : 0),
          trace_(device, "the trace", BufferUse::Storage,
                 job.isTraced ? traceCapacity * sizeof(layout::TraceEvent) : 0) {
        film_.clear();
        dispatch_.cropX = static_cast<std::uint32_t>(job.crop.x0);
        dispatch_.cropY = static_cast<std::uint32_t>(job.crop.y0);
        dispatch_.filmWidth = static_cast<std::uint32_t>(job.crop.width());
        dispatch_.filmHeight = static_cast<std::uint32_t>(job.crop.height());
        dispatch_.tileWidth = static_cast<std::uint32_t>(tileWidth_);
        dispatch_.tileHeight = static_cast<std::uint32_t>(tileHeight_);
        dispatch_.sampleBegin = job.sampleBegin;
        dispatch_.sampleEnd = job.sampleEnd;
        dispatch_.stepBudget = batching.steps;
        usesExactDivision_ = batching.arithmetic == Arithmetic::Native;
        dispatch_.traceCapacity = job.isTraced ? traceCapacity : 0;
        // lavapipe cuts the workgroups into one range a thread: 16 suits every number of threads that divides it.
        dispatch_.interleave = device.info().isSoftware() ? 16 : 1;
        const std::uint32_t slotsPerRound =
            workgroupSize * static_cast<std::uint32_t>(batching.slotsPerInvocation) * dispatch_.interleave;
        groupCount_ = (static_cast<std::uint32_t>(slotCount_) + slotsPerRound - 1) / slotsPerRound *
                      dispatch_.interleave;
    }

    [[nodiscard]] Kernel makeKernel(std::span<const std::uint32_t> spirv) const {
        const PackedScene &scene = job_.scene;
        SpecializationConstants constants{};
        constants[layout::constantWorkgroupSize] = workgroupSize;
        constants[layout::constantSphereCount] = static_cast<std::uint32_t>(scene.spheres.size());
        constants[layout::constantHasTriangles] = scene.hasTriangles;
        constants[layout::constantHasSpecular] = scene.hasSpecular;
        constants[layout::constantHasDielectric] = scene.hasDielectric;
        constants[layout::constantSampler] = static_cast<std::uint32_t>(job_.sampler);
        constants[layout::constantStackSize] = stackSize_;
        constants[layout::constantIsTracing] = job_.isTraced;
        constants[layout::constantExactDivision] = usesExactDivision_;
        const std::array<const Buffer *, layout::bindingCount> bound{
            &buffers_.frame,     &buffers_.spheres, &buffers_.lights, &buffers_.materials, &buffers_.nodes,
            &buffers_.triangles, &buffers_.normals, &film_,           &progress_,          &paths_,
            &pending_,           &stacks_,          &trace_};
        return Kernel(device_, "whitted", spirv, constants, bound);
    }

    /// Runs without samples: drivers that compile at the first dispatch do it now.
    void warmUp(Kernel &kernel) {
        dispatch_.sampleEnd = dispatch_.sampleBegin;
        runOnce(kernel);
        dispatch_.sampleEnd = job_.sampleEnd;
    }

    /// Runs until all samples of all tiles are in the film.
    void run(Kernel &kernel, Result &result, const std::function<void(double)> &onProgress) {
        const int tilesAcross = (job_.crop.width() + tileWidth_ - 1) / tileWidth_;
        const int tilesDown = (job_.crop.height() + tileHeight_ - 1) / tileHeight_;
        const double samplesWanted =
            static_cast<double>(filmPixelCount()) * (job_.sampleEnd - job_.sampleBegin);
        std::uint64_t samplesFinished = 0;
        for (int tile = 0; tile < tilesAcross * tilesDown; ++tile) {
            dispatch_.tileX = static_cast<std::uint32_t>(tile % tilesAcross * tileWidth_);
            dispatch_.tileY = static_cast<std::uint32_t>(tile / tilesAcross * tileHeight_);
            dispatch_.isResumed = 0;
            std::uint32_t unfinishedSlots = 0;
            do {
                const layout::DispatchProgress counters = runOnce(kernel);
                unfinishedSlots = counters.unfinishedSlots;
                samplesFinished += counters.finishedSamples;
                result.rays += {counters.primaryRays, counters.shadowRays, counters.reflectionRays,
                                counters.refractionRays};
                ++result.timing.dispatchCount;
                dispatch_.isResumed = 1;
                if (onProgress)
                    onProgress(static_cast<double>(samplesFinished) / samplesWanted);
            } while (unfinishedSlots > 0);
        }
    }

    void readFilm(std::span<layout::FilmPixel> pixels) const {
        film_.download(std::as_writable_bytes(pixels));
    }

    [[nodiscard]] std::vector<layout::TraceEvent> readTrace() const {
        std::vector<layout::TraceEvent> events(std::min(traceEventCount_, traceCapacity));
        trace_.download(std::as_writable_bytes(std::span(events)));
        return events;
    }

  private:
    [[nodiscard]] std::size_t filmPixelCount() const {
        return static_cast<std::size_t>(job_.crop.width()) * static_cast<std::size_t>(job_.crop.height());
    }

    layout::DispatchProgress runOnce(Kernel &kernel) {
        layout::DispatchProgress counters{};
        counters.traceEvents = traceEventCount_;
        progress_.upload(std::as_bytes(std::span(&counters, 1)));
        kernel.run(dispatch_, groupCount_);
        progress_.download(std::as_writable_bytes(std::span(&counters, 1)));
        traceEventCount_ = counters.traceEvents;
        if (counters.stackOverflows > 0)
            throw Error(
                ExitCode::LimitExceeded,
                fmt::format("the traversal stack of {} entries overflowed: the tree of depth {} is damaged",
                            stackSize_, job_.scene.treeDepth));
        return counters;
    }

    Device &device_;
    Job job_;
    int tileWidth_;
    int tileHeight_;
    std::size_t slotCount_;
    std::uint32_t stackSize_;
    const SceneBuffers &buffers_;
    Buffer film_;
    Buffer progress_;
    Buffer paths_;
    Buffer pending_;
    Buffer stacks_;
    Buffer trace_;
    layout::DispatchConstants dispatch_{};
    bool usesExactDivision_ = false;
    std::uint32_t groupCount_ = 0;
    std::uint32_t traceEventCount_ = 0;
};

} // namespace

struct Renderer::State {
    Device device;
    Batching batching;
    ArithmeticChoice arithmetic;

    State(const DeviceInfo &info, const Batching &wanted)
        : device(info, wanted.isStaged ? Transfers::Staged : Transfers::Automatic),
          batching(chooseBatching(wanted, info)), arithmetic(chooseArithmetic(device, wanted.arithmetic)) {
        batching.arithmetic = arithmetic.isNative ? Arithmetic::Native : Arithmetic::Own;
    }

    SceneBuffers upload(const PackedScene &scene) {
        return SceneBuffers(device, scene, batching.traversal == Traversal::SkipList);
    }
};

Renderer::Renderer(const DeviceInfo &device, const Batching &batching)
    : state_(std::make_unique<State>(device, batching)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer &&) noexcept = default;
Renderer &Renderer::operator=(Renderer &&) noexcept = default;

const ArithmeticChoice &Renderer::arithmetic() const { return state_->arithmetic; }

Result Renderer::render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                        const std::function<void(double)> &onProgress) {
    Result result{Film(crop), {}, {}};
    Clock::time_point start = Clock::now();
    const SceneBuffers buffers = state_->upload(scene);
    result.timing.uploadSeconds = secondsSince(start);

    for (const Crop &band : cutIntoBands(crop, state_->device.info())) {
        start = Clock::now();
        const Job job{scene, band, settings.sampler, 0, static_cast<std::uint32_t>(settings.samplesPerPixel),
                      false};
        TileRenderer tiles(state_->device, buffers, state_->batching, job);
        Kernel kernel = tiles.makeKernel(chooseKernel(state_->batching));
        tiles.warmUp(kernel);
        result.timing.pipelineSeconds += secondsSince(start);

        start = Clock::now();
        const double rowsBefore = band.y0 - crop.y0;
        tiles.run(kernel, result, [&](double share) {
            if (onProgress)
                onProgress((rowsBefore + share * band.height()) / crop.height());
        });
        result.timing.renderSeconds += secondsSince(start);
        const std::size_t width = static_cast<std::size_t>(crop.width());
        tiles.readFilm(std::span(result.film.pixels)
                           .subspan(static_cast<std::size_t>(band.y0 - crop.y0) * width,
                                    static_cast<std::size_t>(band.height()) * width));
    }
    return result;
}

std::vector<layout::TraceEvent> Renderer::trace(const PackedScene &scene, const RenderSettings &settings,
                                                const glm::uvec2 &pixel, std::uint32_t sampleIndex) {
    const int x = static_cast<int>(pixel.x);
    const int y = static_cast<int>(pixel.y);
    const Job job{scene, {x, x + 1, y, y + 1}, settings.sampler, sampleIndex, sampleIndex + 1, true};
    const SceneBuffers buffers = state_->upload(scene);
    TileRenderer tiles(state_->device, buffers, state_->batching, job);
    Kernel kernel = tiles.makeKernel(chooseKernel(state_->batching));
    Result result{Film(job.crop), {}, {}};
    tiles.run(kernel, result, {});
    return tiles.readTrace();
}

} // namespace hyalite::gpu
