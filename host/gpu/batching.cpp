#include "host/gpu/batching.h"

#include "host/report/hash.h"

#include "pathSkipOneSlot.h"
#include "pathSkipTwoSlots.h"
#include "pathStackOneSlot.h"
#include "pathStackTwoSlots.h"
#include "richPathSkipOneSlot.h"
#include "richPathSkipTwoSlots.h"
#include "richPathStackOneSlot.h"
#include "richPathStackTwoSlots.h"
#include "richWhittedSkipOneSlot.h"
#include "richWhittedSkipTwoSlots.h"
#include "richWhittedStackOneSlot.h"
#include "richWhittedStackTwoSlots.h"
#include "viewSkipOneSlot.h"
#include "viewSkipTwoSlots.h"
#include "viewStackOneSlot.h"
#include "viewStackTwoSlots.h"
#include "whittedSkipOneSlot.h"
#include "whittedSkipTwoSlots.h"
#include "whittedStackOneSlot.h"
#include "whittedStackTwoSlots.h"

#include <algorithm>
#include <array>
#include <bit>

namespace hyalite::gpu {

Workload workloadOf(const PackedScene &scene, Integrator integrator) {
    if (integrator == Integrator::Path &&
        (scene.scattering != 0 || (scene.lighting & layout::lightsByEnvironment) != 0))
        return Workload::Shading;
    return scene.hasTriangles ? Workload::Triangles : Workload::Spheres;
}

Batching completed(Batching batching, const DeviceInfo &device, Workload workload) {
    // A software device has few cores; a GPU wants to be filled.
    const int side = device.isSoftware() ? 256 : 512;
    if (batching.tileWidth == 0)
        batching.tileWidth = side;
    if (batching.tileHeight == 0)
        batching.tileHeight = side;
    // Two independent rays at once hide on a CPU how long it waits for nodes of the tree; where there is none, they are
    // only more code, and where there is much code, no registers are left: 3 times slower. On a GPU other subgroups
    // hide it.
    const bool isWaiting = workload == Workload::Triangles && device.isSoftware();
    if (batching.slotsPerInvocation == 0)
        batching.slotsPerInvocation = isWaiting && batching.kernel.empty() ? 2 : 1;
    // lavapipe stops a subgroup in silence after 65,535 loop iterations of all of its lanes together. The lanes count
    // for themselves, and lanes that diverge add up.
    const std::uint32_t limit = 65535u / (std::max(device.subgroupSize, 1u) + 1u);
    if (batching.traversal == Traversal::Automatic)
        batching.traversal =
            device.isSoftware() && batching.kernel.empty() ? Traversal::SkipList : Traversal::Stack;
    // Sums over samples abreast cross lanes, which only the kernels over texel buffers do.
    const int lanes = static_cast<int>(std::bit_floor(std::clamp(device.subgroupSize, 1u, 8u)));
    if (batching.samplesAbreast == 0)
        batching.samplesAbreast = lanes;
    batching.samplesAbreast =
        batching.traversal == Traversal::SkipList ? std::min(batching.samplesAbreast, lanes) : 1;
    if (batching.steps == 0)
        batching.steps = device.isSoftware() ? limit : 4096;
    if (device.isSoftware())
        batching.steps = std::min(batching.steps, limit);
    return batching;
}

namespace {

/// Whether a kernel with RICH=0 will do: bindings.glsl says what they leave out.
bool isLeanEnough(const Batching &batching, Integrator integrator, const KernelDuties &duties) {
    const bool isForLavapipe = batching.traversal == Traversal::SkipList;
    return duties.isPlain && !batching.isCounting && integrator != Integrator::Cost && !duties.isTracing &&
           (!isForLavapipe || (!duties.isResumable && batching.arithmetic == Arithmetic::Native));
}

} // namespace

std::span<const std::uint32_t> kernelWords(const Batching &batching, Integrator integrator,
                                           const KernelDuties &duties) {
    using Words = std::span<const std::uint32_t>;
    if (!batching.kernel.empty())
        return batching.kernel;
    const std::array<Words, 4> whitted{whittedStackOneSlot, whittedStackTwoSlots, whittedSkipOneSlot,
                                       whittedSkipTwoSlots};
    const std::array<Words, 4> path{pathStackOneSlot, pathStackTwoSlots, pathSkipOneSlot, pathSkipTwoSlots};
    const std::size_t index =
        (batching.traversal == Traversal::SkipList ? 2u : 0u) + (batching.slotsPerInvocation == 2 ? 1u : 0u);
    const std::array<Words, 4> view{viewStackOneSlot, viewStackTwoSlots, viewSkipOneSlot, viewSkipTwoSlots};
    const std::array<Words, 4> richWhitted{richWhittedStackOneSlot, richWhittedStackTwoSlots,
                                           richWhittedSkipOneSlot, richWhittedSkipTwoSlots};
    const std::array<Words, 4> richPath{richPathStackOneSlot, richPathStackTwoSlots, richPathSkipOneSlot,
                                        richPathSkipTwoSlots};
    const bool isLean = isLeanEnough(batching, integrator, duties);
    if (isWhitted(integrator))
        return isLean ? whitted[index] : richWhitted[index];
    if (integrator == Integrator::Path)
        return isLean ? path[index] : richPath[index];
    return view[index];
}

std::uint64_t hashOfKernels() {
    std::uint64_t hash = 0;
    for (const Integrator integrator : {Integrator::Whitted, Integrator::Path, Integrator::Normal})
        for (const Traversal traversal : {Traversal::Stack, Traversal::SkipList})
            for (const int slots : {1, 2})
                for (const bool isPlain : {true, false}) {
                    Batching batching;
                    batching.traversal = traversal;
                    batching.slotsPerInvocation = slots;
                    batching.arithmetic = Arithmetic::Native;
                    hash = hashBytes(std::as_bytes(kernelWords(batching, integrator, {isPlain})), hash);
                }
    return hash;
}

std::string_view kernelName(const KernelChoice &choice) {
    for (const auto &[name, known] : kernelNames)
        if (known.traversal == choice.traversal && known.slotsPerInvocation == choice.slotsPerInvocation)
            return name;
    return "auto";
}

std::string_view kernelName(const Batching &batching) {
    return kernelName(KernelChoice{batching.traversal, batching.slotsPerInvocation});
}

} // namespace hyalite::gpu
