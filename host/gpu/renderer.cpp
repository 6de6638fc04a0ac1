#include "host/gpu/renderer.h"

#include "host/error.h"
#include "host/gpu/kernel.h"
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
        batching.slotsPerInvocation = device.isSoftware() ? 2 : 1;
    // lavapipe stops a subgroup in silence after 65,535 loop iterations of all of its lanes together. The lanes count
    // for themselves, and lanes that diverge add up.
    const std::uint32_t limit = 65535u / (std::max(device.subgroupSize, 1u) + 1u);
    if (batching.steps == 0)
        batching.steps = 4096;
    if (device.isSoftware())
        batching.steps = std::min(batching.steps, limit);
    return batching;
}

/// A tile is a whole number of workgroups: 8x8 pixels are 64 slots.
int roundUpToTile(int pixels, int tile) { return std::min((pixels + 7) / 8 * 8, tile); }

template <class Record> std::span<const std::byte> bytesOf(const std::vector<Record> &records) {
    return std::as_bytes(std::span(records));
}

} // namespace

struct Renderer::State {
    Device device;
    Batching batching;

    State(const DeviceInfo &info, const Batching &wanted)
        : device(info, wanted.isStaged ? Transfers::Staged : Transfers::Automatic),
          batching(chooseBatching(wanted, info)) {}

    Buffer upload(const char *name, BufferUse use, std::size_t sizeBytes, std::span<const std::byte> bytes) {
        Buffer buffer(device, name, use, sizeBytes);
        buffer.upload(bytes);
        return buffer;
    }
};

Renderer::Renderer(const DeviceInfo &device, const Batching &batching)
    : state_(std::make_unique<State>(device, batching)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer &&) noexcept = default;
Renderer &Renderer::operator=(Renderer &&) noexcept = default;

Result Renderer::render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                        const std::function<void(double)> &onProgress) {
    Device &device = state_->device;
    const Batching &batching = state_->batching;
    Result result{Film(crop), {}, {}};

    Clock::time_point start = Clock::now();
    const auto storage = [&](const char *name, const auto &records) {
        return state_->upload(name, BufferUse::Storage, bytesOf(records).size(), bytesOf(records));
    };
    const Buffer frame =
        state_->upload("the frame constants", BufferUse::Uniform, sizeof(layout::FrameRecord),
                       std::as_bytes(std::span(&scene.frame, 1)));
    const Buffer spheres =
        state_->upload("the spheres", BufferUse::Uniform,
                       sizeof(layout::SphereRecord) * layout::maxSphereCount, bytesOf(scene.spheres));
    const Buffer lights =
        state_->upload("the lights", BufferUse::Uniform, sizeof(layout::LightRecord) * layout::maxLightCount,
                       bytesOf(scene.lights));
    const Buffer materials = storage("the materials", scene.materials);
    const Buffer nodes = storage("the nodes", scene.nodes);
    const Buffer triangles = storage("the triangles", scene.triangles);
    const Buffer normals = storage("the normals", scene.normals);

    const int tileWidth = roundUpToTile(crop.width(), batching.tileWidth);
    const int tileHeight = roundUpToTile(crop.height(), batching.tileHeight);
    const std::size_t slotCount = static_cast<std::size_t>(tileWidth) * static_cast<std::size_t>(tileHeight);
    // At least one subtree waits for every level but the last; kernels of a few sizes are enough.
    const std::uint32_t stackSize =
        std::bit_ceil(std::clamp(static_cast<std::uint32_t>(scene.treeDepth), 8u, layout::maxTreeDepth));
    Buffer film(device, "the film", BufferUse::Storage,
                result.film.pixels.size() * sizeof(layout::FilmPixel));
    film.clear();
    Buffer progress(device, "the counters", BufferUse::Counters, sizeof(layout::DispatchProgress));
    const Buffer paths(device, "the path slots", BufferUse::Storage, slotCount * sizeof(layout::PathRecord));
    const Buffer pending(device, "the pending rays", BufferUse::Storage,
                         scene.hasDielectric ? slotCount * scene.frame.maxDepth * sizeof(layout::PendingRay)
                                             : 0);
    const Buffer stacks(device, "the traversal stacks", BufferUse::Storage,
                        scene.hasTriangles ? slotCount * stackSize * sizeof(std::uint32_t) : 0);
    result.timing.uploadSeconds = secondsSince(start);

    start = Clock::now();
    SpecializationConstants constants{};
    constants[layout::constantWorkgroupSize] = workgroupSize;
    constants[layout::constantSphereCount] = static_cast<std::uint32_t>(scene.spheres.size());
    constants[layout::constantHasTriangles] = scene.hasTriangles;
    constants[layout::constantHasSpecular] = scene.hasSpecular;
    constants[layout::constantHasDielectric] = scene.hasDielectric;
    constants[layout::constantSampler] = static_cast<std::uint32_t>(settings.sampler);
    constants[layout::constantStackSize] = stackSize;
    const std::array<const Buffer *, layout::bindingCount> buffers{
        &frame,   &spheres, &lights,   &materials, &nodes,   &triangles,
        &normals, &film,    &progress, &paths,     &pending, &stacks};
    const std::span<const std::uint32_t> spirv = batching.slotsPerInvocation == 2
                                                     ? std::span<const std::uint32_t>(whittedStackTwoSlots)
                                                     : std::span<const std::uint32_t>(whittedStackOneSlot);
    Kernel kernel(device, "whitted", spirv, constants, buffers);
    result.timing.pipelineSeconds = secondsSince(start);

    start = Clock::now();
    const int tilesAcross = (crop.width() + tileWidth - 1) / tileWidth;
    const int tilesDown = (crop.height() + tileHeight - 1) / tileHeight;
    const std::uint32_t slotsPerGroup =
        workgroupSize * static_cast<std::uint32_t>(batching.slotsPerInvocation);
    // lavapipe cuts the workgroups into one range a thread: 16 suits every number of threads that divides it.
    const std::uint32_t interleave = device.info().isSoftware() ? 16 : 1;
    const std::uint32_t slotsPerRound = slotsPerGroup * interleave;
    const std::uint32_t groupCount =
        (static_cast<std::uint32_t>(slotCount) + slotsPerRound - 1) / slotsPerRound * interleave;
    layout::DispatchConstants dispatch{};
    dispatch.cropX = static_cast<std::uint32_t>(crop.x0);
    dispatch.cropY = static_cast<std::uint32_t>(crop.y0);
    dispatch.filmWidth = static_cast<std::uint32_t>(crop.width());
    dispatch.filmHeight = static_cast<std::uint32_t>(crop.height());
    dispatch.tileWidth = static_cast<std::uint32_t>(tileWidth);
    dispatch.tileHeight = static_cast<std::uint32_t>(tileHeight);
    dispatch.sampleEnd = static_cast<std::uint32_t>(settings.samplesPerPixel);
    dispatch.stepBudget = batching.steps;
    dispatch.interleave = interleave;
    const double sampleCount = static_cast<double>(result.film.pixels.size()) * settings.samplesPerPixel;
    std::uint64_t finishedSamples = 0;
    for (int tile = 0; tile < tilesAcross * tilesDown; ++tile) {
        dispatch.tileX = static_cast<std::uint32_t>(tile % tilesAcross * tileWidth);
        dispatch.tileY = static_cast<std::uint32_t>(tile / tilesAcross * tileHeight);
        dispatch.isResumed = 0;
        layout::DispatchProgress counters{};
        do {
            counters = {};
            progress.upload(std::as_bytes(std::span(&counters, 1)));
            kernel.run(dispatch, groupCount);
            progress.download(std::as_writable_bytes(std::span(&counters, 1)));
            if (counters.stackOverflows > 0)
                throw Error(
                    ExitCode::LimitExceeded,
                    fmt::format(
                        "the traversal stack of {} entries overflowed: the tree of depth {} is damaged",
                        stackSize, scene.treeDepth));
            result.rays +=
                {counters.primaryRays, counters.shadowRays, counters.reflectionRays, counters.refractionRays};
            ++result.timing.dispatchCount;
            dispatch.isResumed = 1;
            finishedSamples += counters.finishedSamples;
            if (onProgress)
                onProgress(static_cast<double>(finishedSamples) / sampleCount);
        } while (counters.unfinishedSlots > 0);
    }
    result.timing.renderSeconds = secondsSince(start);
    film.download(std::as_writable_bytes(std::span(result.film.pixels)));
    return result;
}

} // namespace hyalite::gpu
