#include "host/gpu/memory_plan.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/quantities.h"
#include "host/packing/light_planes.h"
#include "host/packing/primitive_boxes.h"
#include "host/packing/skip_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint64_t bytesPerTexel = 16;
constexpr std::uint64_t maxWaitingBytes = 256u << 20;

/// Of a tree for ray queries while it is made, estimated, as drivers have their own: the box itself, scratch memory, and
/// nodes. Mesa 25 takes 24 and 88 bytes on the CPU.
constexpr std::uint64_t bytesPerQueryBox = 192;

/// Maximum tile size for the resumable helper kernel. It keeps the memory of waiting paths small, and its dispatches
/// short.
constexpr std::uint64_t maxHelperPixels = 64 * 64;
constexpr std::uint64_t minHelperPixels = 8 * 8; // a tile that cannot be halved

/// At least 16 bytes: Vulkan has no empty buffers.
BufferPlan plan(std::string name, BufferUse use, std::uint64_t sizeBytes) {
    return {std::move(name), use, std::max<std::uint64_t>(sizeBytes, 16)};
}

BufferUse bulkUse(const KernelRow &kernel) {
    return kernel.memory == KernelMemory::Texels ? BufferUse::Texels : BufferUse::Storage;
}

std::uint32_t fitTile(std::uint32_t pixels, int tile) {
    const std::uint32_t side = Tile::blockSide;
    return std::min((pixels + side - 1) / side * side, static_cast<std::uint32_t>(tile));
}

/// Samples in flight: the maximum that leaves few slots idle in the last round.
std::uint32_t fitSamplesInFlight(int most, std::uint32_t samples) {
    std::uint32_t inFlight = static_cast<std::uint32_t>(most);
    while (inFlight > 1 && samples < 8 * ((samples + inFlight - 1) / inFlight * inFlight - samples))
        inFlight /= 2;
    return inFlight;
}

/// The minimum over the pixels of the film that the job begins with.
std::uint32_t fewestSamples(const Job &job) {
    std::uint32_t fewest = job.film.empty() ? 0 : job.sampleEnd;
    for (const layout::FilmPixel &pixel : job.film)
        fewest = std::min(fewest, pixel.sampleCount);
    return fewest;
}

/// Of a path that waits.
std::uint64_t lightBytesOfPath(const LightPlanes &planes) {
    return planes.count() == 0 ? 0 : (layout::lightStateWords + 3 * planes.groups) * sizeof(std::uint32_t);
}

/// For `slots` path slots. `isResumable`: the kernel can stop inside a sample.
WaitingPlan planWaiting(const Job &job, const KernelRow &kernel, bool isResumable, std::uint64_t slots) {
    const bool isSplitting = rowOf(job.settings.integrator).splitsAtGlass && job.scene.hasDielectric;
    const std::uint32_t maxPending = isSplitting ? static_cast<std::uint32_t>(job.settings.maxDepth) - 1 : 0;
    const bool keepsPending = !isResumable && maxPending <= layout::maxPendingInRegisters;
    WaitingPlan waiting;
    const std::uint64_t lightBytes = lightBytesOfPath(lightPlanesOf(job.scene, job.settings));
    waiting.paths = plan("the path slots", BufferUse::Storage,
                         isResumable ? slots * (sizeof(layout::PathRecord) + lightBytes) : 0);
    waiting.pending = plan("the pending rays", bulkUse(kernel),
                           keepsPending ? 0 : slots * maxPending * sizeof(layout::PendingRay));
    waiting.pendingInRegisters = keepsPending ? maxPending : 0;
    return waiting;
}

/// Whether the buffers of the slots fit, each alone and all together.
bool haveRoom(std::initializer_list<const BufferPlan *> buffers, const DeviceInfo &device) {
    std::uint64_t sumBytes = 0;
    for (const BufferPlan *buffer : buffers) {
        if (buffer->sizeBytes > maxBufferBytes(buffer->use, device))
            return false;
        sumBytes += buffer->sizeBytes;
    }
    return sumBytes <= std::min(maxWaitingBytes, device.deviceMemoryBytes / 4);
}

std::string listLargest(std::vector<const BufferPlan *> buffers) {
    std::ranges::sort(buffers, [](const auto *a, const auto *b) { return a->sizeBytes > b->sizeBytes; });
    std::string text;
    for (const BufferPlan *buffer : std::span(buffers).first(3))
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", buffer->name, sizeText(buffer->sizeBytes));
    return text;
}

} // namespace

std::uint64_t maxBufferBytes(BufferUse use, const DeviceInfo &device) {
    if (use == BufferUse::Storage)
        return std::min(device.maxStorageBufferBytes, device.maxAllocationBytes);
    if (use == BufferUse::Texels)
        return std::min(device.maxTexelBufferElements * bytesPerTexel + bytesPerTexel - 1,
                        device.maxAllocationBytes);
    return device.maxAllocationBytes;
}

void requireBuffer(const BufferPlan &plan, const DeviceInfo &device) {
    if (plan.sizeBytes <= maxBufferBytes(plan.use, device))
        return;
    const std::string what =
        fmt::format("the buffer for {}, {} bytes, is too large", plan.name, plan.sizeBytes);
    if (plan.sizeBytes > device.maxAllocationBytes)
        throw Error(ErrorKind::LimitExceeded, fmt::format("{}: {} allows {} bytes in one piece of memory",
                                                          what, device.name, device.maxAllocationBytes));
    if (plan.use == BufferUse::Texels)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{}: {} allows {} texels of {} bytes", what, device.name,
                                device.maxTexelBufferElements, bytesPerTexel));
    throw Error(ErrorKind::LimitExceeded, fmt::format("{}: {} allows {} bytes in a storage buffer", what,
                                                      device.name, device.maxStorageBufferBytes));
}

ScenePlan planScene(const PackedScene &scene, const KernelRow &kernel) {
    const BufferUse use = bulkUse(kernel);
    ScenePlan planned;
    planned.buffers[layout::bindingFrame] =
        plan("the frame constants", BufferUse::Uniform, sizeof(layout::FrameRecord));
    planned.buffers[layout::bindingSphereConstants] =
        plan("the spheres", BufferUse::Uniform, sizeof(layout::SphereRecord) * layout::maxUnrolledSpheres);
    planned.buffers[layout::bindingLightConstants] =
        plan("the first lights", BufferUse::Uniform, sizeof(layout::LightRecord) * layout::maxUniformLights);
    planned.buffers[layout::bindingPairConstants] =
        plan("the pairs of triangles", BufferUse::Uniform,
             sizeof(layout::TrianglePair) * layout::maxListedTriangles);
    for (const SceneArray &array : scene.arrays())
        planned.buffers[array.binding] = plan(fmt::format("the {}", array.name), use, array.bytes.size());
    if (kernel.tree == KernelTree::SkipLists) {
        const std::uint64_t listBytes = scene.hasTriangles ? maxSkipListBytes(scene.nodes.size()) : 0;
        planned.buffers[layout::bindingNodes] = plan("the skip lists", use, listBytes);
        planned.hostBytes = scene.hasTriangles ? listBytes + skipListWorkBytes(scene.nodes.size()) +
                                                     std::span(scene.instances).size_bytes()
                                               : 0;
    } else if (kernel.tree == KernelTree::WideNodes) {
        planned.buffers[layout::bindingNodes] =
            plan("the wide nodes", use, scene.nodes.size() * sizeof(layout::WideNode));
        planned.hostBytes =
            planned.buffers[layout::bindingNodes].sizeBytes + std::span(scene.instances).size_bytes();
    } else if (kernel.tree == KernelTree::PrimitiveBoxes) {
        const std::uint64_t boxes = countPrimitiveBoxes(scene);
        planned.buffers[layout::bindingNodes] =
            plan("the boxes of ray queries", BufferUse::TopLevel, boxes * bytesPerQueryBox);
        planned.hostBytes = boxes * sizeof(Box) + std::span(scene.instances).size_bytes();
    } else {
        planned.buffers[layout::bindingNodes] = plan("the nodes", use, std::span(scene.nodes).size_bytes());
    }
    return planned;
}

JobPlan planJob(const Job &job, const RenderConfig &config, const DeviceInfo &device) {
    const KernelRow &kernel = *config.kernel;
    const bool isExchanging = kernel.lanes == KernelLanes::Exchanging;
    JobPlan planned;
    planned.layout = FilmLayout(job.crop, job.film, job.sampleEnd);
    const std::uint64_t filmPixels = planned.layout.pixelCount();
    planned.exchangesByBroadcast = isExchanging && device.hasSlowShuffles.value_or(false);
    planned.fewestSamples = fewestSamples(job);
    planned.samplesInFlight =
        fitSamplesInFlight(config.samplesInFlight, job.sampleEnd - job.sampleBegin - planned.fewestSamples);
    // At most one subtree waits per level. Powers of two keep the number of different kernels small.
    planned.stackSize = std::bit_ceil(std::max(static_cast<std::uint32_t>(job.scene.treeDepth), 8u));
    // A direct kernel drops unfinished samples and repeats them, so they would be counted and traced twice.
    planned.isDirect = isExchanging && !job.isTraced && !config.isCounting;
    const std::uint32_t lightPlanes = lightPlanesOf(job.scene, job.settings).count();
    // Where every pass takes the same time, lanes whose paths have ended cost as much as others. In a tree few rays
    // take less, and whitted's paths end together. To keep layers of light of samples that wait costs more than that.
    planned.regeneratesPaths = planned.isDirect && rowOf(job.settings.integrator).aimsAtEmitters &&
                               !job.scene.needsTree(job.settings.integrator) && lightPlanes == 0;
    planned.film = plan(
        "the film", BufferUse::Storage,
        filmPixels * (sizeof(layout::FilmPixel) + (planned.layout.isGathered() ? sizeof(std::uint32_t) : 0)));
    planned.light = plan("the layers of light", BufferUse::Storage,
                         filmPixels * lightPlanes * layout::lightWordsPerPlane * sizeof(float));
    planned.progress = plan("the counters", BufferUse::Counters, sizeof(layout::DispatchProgress));
    planned.trace =
        plan("the trace", BufferUse::Storage, job.isTraced ? traceCapacity * sizeof(layout::TraceEvent) : 0);
    planned.largestTile = {0, 0, fitTile(planned.layout.width(), config.tileWidth),
                           fitTile(planned.layout.height(), config.tileHeight)};
    const std::uint64_t recordsPerSample = alphaKindOf(job.settings) == layout::alphaOfNothing ? 1 : 2;
    const auto planSlots = [&] {
        const std::uint64_t slots = planned.largestTile.pixelCount() * planned.samplesInFlight;
        planned.stacks = planned.regeneratesPaths
                             ? plan("the finished samples", BufferUse::Storage,
                                    slots * recordsPerSample * sizeof(layout::SampleRecord))
                             : plan("the traversal stacks", BufferUse::Storage,
                                    job.scene.hasTriangles && kernel.hasStack
                                        ? slots * planned.stackSize * sizeof(std::uint32_t)
                                        : 0);
        planned.waiting = planWaiting(job, kernel, !planned.isDirect, slots);
    };
    planSlots();
    while (!haveRoom({&planned.stacks, &planned.waiting.paths, &planned.waiting.pending}, device) &&
           planned.largestTile.canBeHalved()) {
        planned.largestTile = planned.largestTile.halves().first;
        planSlots();
    }
    if (!planned.isDirect)
        return planned;
    planned.maxHelperPixels = std::min(planned.largestTile.pixelCount(), maxHelperPixels);
    const auto planHelper = [&] {
        planned.helperWaiting =
            planWaiting(job, kernel, true, planned.maxHelperPixels * planned.samplesInFlight);
    };
    planHelper();
    while (!haveRoom({&planned.helperWaiting.paths, &planned.helperWaiting.pending}, device) &&
           planned.maxHelperPixels > minHelperPixels) {
        planned.maxHelperPixels = std::max(planned.maxHelperPixels / 2, minHelperPixels);
        planHelper();
    }
    return planned;
}

MemoryPlan requireMemory(const ScenePlan &scene, const JobPlan &job, bool isStaged, const DeviceInfo &device,
                         std::uint64_t residentBytes) {
    std::vector<const BufferPlan *> buffers{&job.film,
                                            &job.light,
                                            &job.progress,
                                            &job.stacks,
                                            &job.trace,
                                            &job.waiting.paths,
                                            &job.waiting.pending,
                                            &job.helperWaiting.paths,
                                            &job.helperWaiting.pending};
    for (const BufferPlan &buffer : scene.buffers)
        buffers.push_back(&buffer);
    MemoryPlan memory;
    std::uint64_t largestBytes = 0;
    for (const BufferPlan *buffer : buffers) {
        requireBuffer(*buffer, device);
        memory.deviceBytes += buffer->sizeBytes;
        largestBytes = std::max(largestBytes, buffer->sizeBytes);
    }
    memory.hostBytes = (residentBytes > 0 ? 0 : scene.hostBytes) + (isStaged ? largestBytes : 0);
    if (memory.deviceBytes > device.deviceMemoryBytes)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("the render takes {} of the memory of {}, which has {} ({})",
                                sizeText(memory.deviceBytes), device.name, sizeText(device.deviceMemoryBytes),
                                listLargest(buffers)),
                    Remedy::SmallerRender);
    const std::uint64_t neededBytes =
        memory.hostBytes +
        (device.isSoftware() ? memory.deviceBytes - std::min(residentBytes, memory.deviceBytes) : 0);
    const std::optional<std::uint64_t> available = availableHostBytes();
    if (available && neededBytes > *available)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("the render takes {} of memory besides the scene and the image, and {} are "
                                "available ({})",
                                sizeText(neededBytes), sizeText(*available), listLargest(buffers)),
                    Remedy::SmallerRender);
    return memory;
}

} // namespace hyalite::core::gpu
