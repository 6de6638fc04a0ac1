#include "host/gpu/tile_renderer.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace hyalite::gpu {

namespace {

constexpr std::uint32_t workgroupSize = 64;
constexpr std::uint32_t traceCapacity = 1u << 17;

/// A tile is a whole number of blocks of 8x8 pixels, which are 64 slots.
int fitTile(int pixels, int tile) { return std::min((pixels + 7) / 8 * 8, tile); }

} // namespace

TileRenderer::TileRenderer(Device &device, const SceneBuffers &buffers, const Batching &batching,
                           const Job &job)
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
               job.scene.hasDielectric ? slotCount_ * job.scene.frame.maxDepth * sizeof(layout::PendingRay)
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
    groupCount_ =
        (static_cast<std::uint32_t>(slotCount_) + slotsPerRound - 1) / slotsPerRound * dispatch_.interleave;
}

Kernel TileRenderer::makeKernel(std::span<const std::uint32_t> spirv) const {
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

void TileRenderer::warmUp(Kernel &kernel) {
    dispatch_.sampleEnd = dispatch_.sampleBegin;
    runOnce(kernel);
    dispatch_.sampleEnd = job_.sampleEnd;
}

TileTotals TileRenderer::run(Kernel &kernel, const std::function<void(double)> &onProgress) {
    const int tilesAcross = (job_.crop.width() + tileWidth_ - 1) / tileWidth_;
    const int tilesDown = (job_.crop.height() + tileHeight_ - 1) / tileHeight_;
    const double samplesWanted = static_cast<double>(filmPixelCount()) * (job_.sampleEnd - job_.sampleBegin);
    std::uint64_t samplesFinished = 0;
    TileTotals totals;
    for (int tile = 0; tile < tilesAcross * tilesDown; ++tile) {
        dispatch_.tileX = static_cast<std::uint32_t>(tile % tilesAcross * tileWidth_);
        dispatch_.tileY = static_cast<std::uint32_t>(tile / tilesAcross * tileHeight_);
        dispatch_.isResumed = 0;
        std::uint32_t unfinishedSlots = 0;
        do {
            const layout::DispatchProgress counters = runOnce(kernel);
            unfinishedSlots = counters.unfinishedSlots;
            samplesFinished += counters.finishedSamples;
            totals.rays +=
                {counters.primaryRays, counters.shadowRays, counters.reflectionRays, counters.refractionRays};
            ++totals.dispatchCount;
            dispatch_.isResumed = 1;
            if (onProgress)
                onProgress(static_cast<double>(samplesFinished) / samplesWanted);
        } while (unfinishedSlots > 0);
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

layout::DispatchProgress TileRenderer::runOnce(Kernel &kernel) {
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

} // namespace hyalite::gpu
