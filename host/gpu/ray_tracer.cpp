#include "host/gpu/ray_tracer.h"

#include "host/base/error.h"
#include "host/gpu/kernel.h"
#include "host/gpu/scene_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t workgroupSize = 64;

// As many as lavapipe allows (render_config.cpp tells of its limit): the one loop of the kernel runs on lanes together.
constexpr std::uint32_t stepBudget = 60'000;

std::uint32_t stackSizeFor(const PackedScene &scene) {
    return std::bit_ceil(std::max(static_cast<std::uint32_t>(scene.treeDepth), 8u));
}

} // namespace

struct RayScene::State {
    Device device;
    SceneBuffers buffers;
    const KernelRow &kernel;
    std::uint32_t stackSize;
    bool hasInstances;
    bool hasPairs;
    bool isDivisionExact;

    State(const DeviceInfo &info, const PackedScene &scene, const KernelRow &row)
        : device(info), buffers(device, scene, planScene(scene, row), row), kernel(row),
          stackSize(stackSizeFor(scene)), hasInstances(!scene.instances.empty()),
          hasPairs(row.tree == KernelTree::SkipLists && scene.hasPairs),
          isDivisionExact(
              chooseArithmetic(device.info(), checkDevice(device), Arithmetic::Automatic).isNative) {
        buffers.setFrame(frameOf(scene, RenderSettings{}));
    }
};

RayScene::RayScene(const DeviceInfo &device, const PackedScene &scene, const KernelRow &kernel)
    : state_(std::make_unique<State>(device, scene, kernel)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene &&) noexcept = default;
RayScene &RayScene::operator=(RayScene &&) noexcept = default;

struct RayTracer::State {
    std::uint32_t rayCount;
    Buffer rays;
    Buffer hits;
    Buffer stacks;
    Buffer unused; ///< bound where only integrators read or write
    Kernel kernel;
    layout::DispatchConstants dispatch{};
    std::uint32_t groupCount = 0;

    State(RayScene::State &scene, const RayKernel &code, RayGoal goal,
          std::span<const layout::RayRecord> wanted)
        : rayCount(static_cast<std::uint32_t>(wanted.size())),
          rays(scene.device, "the rays",
               code.row.memory == KernelMemory::Texels ? BufferUse::Texels : BufferUse::Storage,
               wanted.size_bytes()),
          hits(scene.device, "the hits", BufferUse::Storage, wanted.size() * sizeof(layout::HitRecord)),
          stacks(scene.device, "the traversal stacks", BufferUse::Storage,
                 code.row.hasStack ? wanted.size() * scene.stackSize * sizeof(std::uint32_t) : 0),
          unused(scene.device, "nothing", BufferUse::Storage, 0), kernel(makeKernel(scene, code, goal)) {
        assert(shareScenes(code.row, scene.kernel) && !wanted.empty());
        rays.upload(std::as_bytes(wanted));
        dispatch.tileWidth = rayCount;
        dispatch.tileHeight = 1;
        dispatch.stepBudget = stepBudget;
        dispatch.interleave = scene.device.info().isSoftware() ? 16 : 1; // as in tile_renderer.cpp
        const std::uint32_t raysPerRound =
            workgroupSize * static_cast<std::uint32_t>(code.row.raysAtOnce) * dispatch.interleave;
        groupCount = (rayCount + raysPerRound - 1) / raysPerRound * dispatch.interleave;
    }

    [[nodiscard]] Kernel makeKernel(RayScene::State &scene, const RayKernel &code, RayGoal goal) const {
        std::array<std::uint32_t, layout::rayConstantCount> constants{};
        constants[layout::constantWorkgroupSize] = workgroupSize;
        constants[layout::constantHasTriangles] = 1;
        constants[layout::constantHasInstances] = scene.hasInstances;
        constants[layout::constantHasPairs] = scene.hasPairs;
        constants[layout::constantStackSize] = scene.stackSize;
        constants[layout::constantExactDivision] = scene.isDivisionExact;
        constants[layout::constantSamplesInFlight] = 1;
        constants[layout::constantIsAnyHit] = goal == RayGoal::AnyHit;
        std::array<const Buffer *, layout::rayBindingCount> bound{};
        bound.fill(&unused);
        std::ranges::transform(scene.buffers.buffers, bound.begin(),
                               [](const Buffer &each) { return &each; });
        bound[layout::bindingStacks] = &stacks;
        bound[layout::bindingRays] = &rays;
        bound[layout::bindingHits] = &hits;
        return Kernel(scene.device, std::string(code.row.name), code.spirv, constants, bound);
    }
};

RayTracer::RayTracer(RayScene &scene, const RayKernel &kernel, RayGoal goal,
                     std::span<const layout::RayRecord> rays)
    : state_(std::make_unique<State>(*scene.state_, kernel, goal, rays)) {}
RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer &&) noexcept = default;
RayTracer &RayTracer::operator=(RayTracer &&) noexcept = default;

void RayTracer::run() { state_->kernel.run(state_->dispatch, state_->groupCount); }

std::vector<layout::HitRecord> RayTracer::hits() const {
    std::vector<layout::HitRecord> hits(state_->rayCount);
    state_->hits.download(std::as_writable_bytes(std::span(hits)));
    const auto unknownCount = std::count_if(hits.begin(), hits.end(), [](const layout::HitRecord &hit) {
        return hit.primitive == layout::hitUnknown;
    });
    if (unknownCount > 0)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{} of {} rays take more than the {} steps of one dispatch", unknownCount,
                                hits.size(), stepBudget));
    return hits;
}

} // namespace hyalite::core::gpu
