#include "host/gpu/tile_renderer.h"

#include "host/error.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace hyalite::gpu {

namespace {

constexpr std::uint32_t workgroupSize = 64;
constexpr std::uint32_t samplesInPass = 64; // of each pixel, before any gets more
constexpr std::uint32_t traceCapacity = 1u << 17;

/// A tile is a whole number of blocks of 8x8 pixels, which are 64 slots.
int fitTile(int pixels, int tile) { return std::min((pixels + 7) / 8 * 8, tile); }

/// Samples of a pixel that run side by side: as many as leave few slots idle in the last round.
std::uint32_t fitSamplesAbreast(int most, std::uint32_t samples) {
    std::uint32_t abreast = static_cast<std::uint32_t>(most);
    while (abreast > 1 && samples < 8 * ((samples + abreast - 1) / abreast * abreast - samples))
        abreast /= 2;
    return abreast;
}

/// Storage that a kernel over texel buffers sees as texels.
BufferUse bulkUse(const Batching &batching) {
    return batching.traversal == Traversal::SkipList ? BufferUse::Texels : BufferUse::Storage;
}

RayCounts raysOf(const layout::DispatchProgress &counters) {
    return {counters.primaryRays, counters.shadowRays, counters.reflectionRays, counters.refractionRays,
            counters.bounceRays};
}

WorkCounts workOf(const layout::DispatchProgress &counters) {
    return {counters.nodesVisited, counters.boxesTested, counters.trianglesTested, counters.deepestStack};
}

LaneCounts lanesOf(const layout::DispatchProgress &counters, std::uint32_t slotsPerSubgroup) {
    return {counters.traversalPasses, counters.busySlots, slotsPerSubgroup};
}

} // namespace

TileRenderer::TileRenderer(Device &device, const SceneBuffers &buffers, const Batching &batching,
                           const Job &job)
    : device_(device), buffers_(buffers), batching_(batching), job_(job),
      tileWidth_(fitTile(job.crop.width(), batching.tileWidth)),
      tileHeight_(fitTile(job.crop.height(), batching.tileHeight)),
      samplesAbreast_(fitSamplesAbreast(batching.samplesAbreast, job.sampleEnd - job.sampleBegin)),
      slotCount_(static_cast<std::uint32_t>(tileWidth_) * static_cast<std::uint32_t>(tileHeight_) *
                 samplesAbreast_),
      // One subtree waits for each level at most; kernels of a few sizes are enough.
      stackSize_(std::bit_ceil(
          std::clamp(static_cast<std::uint32_t>(job.scene.treeDepth), 8u, layout::maxTreeDepth))),
      film_(device, "the film", BufferUse::Storage, filmPixelCount() * sizeof(layout::FilmPixel)),
      progress_(device, "the counters", BufferUse::Counters, sizeof(layout::DispatchProgress)),
      stacks_(device, "the traversal stacks", BufferUse::Storage,
              job.scene.hasTriangles && batching.traversal == Traversal::Stack
                  ? std::size_t{slotCount_} * stackSize_ * sizeof(std::uint32_t)
                  : 0),
      trace_(device, "the trace", BufferUse::Storage,
             job.isTraced ? traceCapacity * sizeof(layout::TraceEvent) : 0),
      pace_(batching.dispatchSeconds, samplesAbreast_, batching.steps) {
    if (job.film.empty())
        film_.clear();
    else
        film_.upload(std::as_bytes(job.film));
    for (const layout::FilmPixel &pixel : job.film)
        samplesInFilm_ += pixel.sampleCount;
    const auto fewest = std::min_element(job.film.begin(), job.film.end(), [](const auto &a, const auto &b) {
        return a.sampleCount < b.sampleCount;
    });
    if (fewest != job.film.end())
        fewestInFilm_ = fewest->sampleCount;
    dispatch_.cropX = static_cast<std::uint32_t>(job.crop.x0);
    dispatch_.cropY = static_cast<std::uint32_t>(job.crop.y0);
    dispatch_.filmWidth = static_cast<std::uint32_t>(job.crop.width());
    dispatch_.filmHeight = static_cast<std::uint32_t>(job.crop.height());
    dispatch_.tileWidth = static_cast<std::uint32_t>(tileWidth_);
    dispatch_.tileHeight = static_cast<std::uint32_t>(tileHeight_);
    dispatch_.sampleBegin = job.sampleBegin;
    dispatch_.stepBudget = batching.steps;
    dispatch_.traceCapacity = job.isTraced ? traceCapacity : 0;
    // lavapipe cuts the workgroups into one range a thread: 16 suits every number of threads that divides it.
    dispatch_.interleave = device.info().isSoftware() ? 16 : 1;
    const std::uint32_t slotsPerRound =
        workgroupSize * static_cast<std::uint32_t>(batching.slotsPerInvocation) * dispatch_.interleave;
    groupCount_ = (slotCount_ + slotsPerRound - 1) / slotsPerRound * dispatch_.interleave;
    dispatch_.sampleEnd = job.sampleEnd;
}

void TileRenderer::makeKernel() {
    // What is dropped and done again would be counted twice.
    if (batching_.traversal == Traversal::Stack || job_.isTraced || batching_.isCounting)
        resumable_.emplace(makeProgram(true));
    else
        direct_.emplace(makeProgram(false));
}

void TileRenderer::warmUp() { warmUp(direct_ ? direct_->kernel : resumable_->kernel); }

void TileRenderer::warmUp(Kernel &kernel) {
    const std::uint32_t sampleEnd = std::exchange(dispatch_.sampleEnd, dispatch_.sampleBegin);
    (void)runOnce(kernel);
    dispatch_.sampleEnd = sampleEnd;
}

TileRenderer::Program TileRenderer::makeProgram(bool isResumable) {
    const PackedScene &scene = job_.scene;
    const bool isSplitting = isWhitted(job_.integrator) && scene.hasDielectric;
    const std::uint32_t mostPending = isSplitting ? scene.frame.maxDepth - 1 : 0;
    const bool keepsPending = !isResumable && mostPending <= layout::mostPendingInRegisters;
    Buffer paths(device_, "the path slots", BufferUse::Storage,
                 isResumable ? std::size_t{slotCount_} * sizeof(layout::PathRecord) : 0);
    Buffer pending(device_, "the pending rays", bulkUse(batching_),
                   keepsPending ? 0 : std::size_t{slotCount_} * mostPending * sizeof(layout::PendingRay));

    SpecializationConstants constants{};
    constants[layout::constantWorkgroupSize] = workgroupSize;
    constants[layout::constantSphereCount] = static_cast<std::uint32_t>(scene.spheres.size());
    constants[layout::constantLightCount] = static_cast<std::uint32_t>(scene.lights.size());
    constants[layout::constantHasTriangles] = scene.hasTriangles;
    constants[layout::constantHasSpecular] = scene.hasSpecular;
    constants[layout::constantHasDielectric] = scene.hasDielectric;
    constants[layout::constantHasEmission] = scene.hasEmission;
    constants[layout::constantEmitterCount] = static_cast<std::uint32_t>(scene.emitters.size());
    constants[layout::constantView] = viewOf(job_.integrator);
    constants[layout::constantSampler] = static_cast<std::uint32_t>(job_.sampler);
    constants[layout::constantStackSize] = stackSize_;
    constants[layout::constantIsTracing] = job_.isTraced;
    constants[layout::constantExactDivision] = batching_.arithmetic == Arithmetic::Native;
    constants[layout::constantSamplesAbreast] = samplesAbreast_;
    constants[layout::constantIsResumable] = isResumable;
    constants[layout::constantIsCounting] = batching_.isCounting;
    constants[layout::constantShowsCost] = job_.integrator == Integrator::Cost;
    constants[layout::constantPendingInRegisters] = keepsPending ? mostPending : 0;
    const std::array<const Buffer *, layout::bindingCount> bound{&buffers_.frame,   &buffers_.spheres,
                                                                 &buffers_.lights,  &buffers_.materials,
                                                                 &buffers_.nodes,   &buffers_.triangles,
                                                                 &buffers_.normals, &film_,
                                                                 &progress_,        &paths,
                                                                 &pending,          &stacks_,
                                                                 &trace_,           &buffers_.sphereArray,
                                                                 &buffers_.emitters};
    const std::string name =
        fmt::format("{} {}{}", nameOf(job_.integrator), kernelName(batching_),
                    isResumable && batching_.traversal == Traversal::SkipList ? ", resumable" : "");
    Kernel kernel(device_, name, kernelWords(batching_, job_.integrator), constants, bound);
    return {std::move(paths), std::move(pending), std::move(kernel)};
}

Kernel &TileRenderer::resumableKernel(Timeline *timeline) {
    if (!resumable_) {
        Stopwatch watch;
        resumable_.emplace(makeProgram(true));
        warmUp(resumable_->kernel);
        const Span span = watch.lap();
        lateBuildSeconds_ += span.seconds();
        if (timeline != nullptr)
            timeline->stages.push_back({"resumable kernel", span, device_.allocatedBytes()});
    }
    return resumable_->kernel;
}

TileTotals TileRenderer::run(const std::function<void(double)> &onProgress, Timeline *timeline,
                             const std::function<bool()> &shouldStop,
                             const std::function<void(const RayCounts &)> &onPause) {
    const int tilesAcross = (job_.crop.width() + tileWidth_ - 1) / tileWidth_;
    const int tilesDown = (job_.crop.height() + tileHeight_ - 1) / tileHeight_;
    const double samplesWanted = static_cast<double>(filmPixelCount()) * (job_.sampleEnd - job_.sampleBegin);
    std::uint64_t samplesFinished = samplesInFilm_;
    TileTotals totals;
    bool isResumed = false;
    const auto dispatch = [&](Kernel &kernel) {
        dispatch_.stepBudget = pace_.steps();
        const Step step = runOnce(kernel);
        pace_.learn(step.times.best().seconds());
        samplesFinished += step.counters.finishedSamples;
        totals.rays += raysOf(step.counters);
        totals.work += workOf(step.counters);
        totals.lanes += lanesOf(step.counters, device_.info().subgroupSize *
                                                   static_cast<std::uint32_t>(batching_.slotsPerInvocation));
        if (timeline != nullptr)
            timeline->dispatches.push_back(describe(kernel, step, isResumed));
        isResumed = true;
        ++totals.dispatchCount;
        if (onProgress)
            onProgress(static_cast<double>(samplesFinished) / samplesWanted);
        totals.isStopped = shouldStop && shouldStop();
        if (onPause && !totals.isStopped)
            onPause(totals.rays);
        return step.counters;
    };
    // The film says where each pixel stands: the samples of the tile up to `end` are wanted.
    const auto fillTile = [&](std::uint32_t begin, std::uint32_t end) {
        dispatch_.sampleEnd = begin;
        while (dispatch_.sampleEnd < end && !totals.isStopped) {
            dispatch_.sampleEnd += std::min(pace_.samples(), end - dispatch_.sampleEnd);
            dispatch_.isResumed = 0;
            isResumed = false;
            layout::DispatchProgress last{};
            last.unfinishedSlots = slotCount_;
            if (direct_) {
                do
                    last = dispatch(direct_->kernel);
                while (last.unfinishedSlots > 0 && last.finishedSamples > 0 && !totals.isStopped);
            }
            while (last.unfinishedSlots > 0 && !totals.isStopped) {
                last = dispatch(resumableKernel(timeline));
                dispatch_.isResumed = 1;
            }
        }
    };
    // Pass after pass over the whole image, so that one that is stopped early has samples everywhere.
    for (std::uint32_t begin = job_.sampleBegin + fewestInFilm_;
         begin < job_.sampleEnd && !totals.isStopped;) {
        const std::uint32_t end = begin + std::min(samplesInPass, job_.sampleEnd - begin);
        for (int tile = 0; tile < tilesAcross * tilesDown && !totals.isStopped; ++tile) {
            dispatch_.tileX = static_cast<std::uint32_t>(tile % tilesAcross * tileWidth_);
            dispatch_.tileY = static_cast<std::uint32_t>(tile / tilesAcross * tileHeight_);
            fillTile(begin, end);
        }
        begin = end;
    }
    return totals;
}

void TileRenderer::readFilm(std::span<layout::FilmPixel> pixels) const {
    film_.download(std::as_writable_bytes(pixels));
}

std::vector<layout::TraceEvent> TileRenderer::readTrace() const {
    std::vector<layout::TraceEvent> events(std::min(traceEventCount_, traceCapacity));
    trace_.download(std::as_writable_bytes(std::span(events)));
    return events;
}

std::size_t TileRenderer::filmPixelCount() const {
    return static_cast<std::size_t>(job_.crop.width()) * static_cast<std::size_t>(job_.crop.height());
}

TileRenderer::Step TileRenderer::runOnce(Kernel &kernel) {
    layout::DispatchProgress counters{};
    counters.traceEvents = traceEventCount_;
    progress_.upload(std::as_bytes(std::span(&counters, 1)));
    const RunTimes times = kernel.run(dispatch_, groupCount_);
    progress_.download(std::as_writable_bytes(std::span(&counters, 1)));
    traceEventCount_ = counters.traceEvents;
    if (counters.stackOverflows > 0)
        throw Error(
            ExitCode::LimitExceeded,
            fmt::format("the traversal stack of {} entries overflowed: the tree of depth {} is damaged",
                        stackSize_, job_.scene.treeDepth));
    return {counters, times};
}

DispatchRecord TileRenderer::describe(const Kernel &kernel, const Step &step, bool isResumed) const {
    DispatchRecord record;
    record.kernel = kernel.name();
    record.tileX = job_.crop.x0 + static_cast<int>(dispatch_.tileX);
    record.tileY = job_.crop.y0 + static_cast<int>(dispatch_.tileY);
    record.tileWidth = std::min(tileWidth_, job_.crop.x1 - record.tileX);
    record.tileHeight = std::min(tileHeight_, job_.crop.y1 - record.tileY);
    record.sampleBegin = dispatch_.sampleBegin;
    record.sampleEnd = dispatch_.sampleEnd;
    record.isResumed = isResumed;
    record.rays = raysOf(step.counters);
    record.invocations = std::uint64_t{groupCount_} * workgroupSize;
    record.times = step.times;
    return record;
}

} // namespace hyalite::gpu
