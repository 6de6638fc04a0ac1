#include "host/gpu/kernels.h"

#include "host/gpu/kernel_needs.h"

#include <fmt/format.h>

#include <limits>

namespace hyalite::core::gpu {

Workload workloadOf(const PackedScene &scene, Integrator integrator) {
    if (rowOf(integrator).aimsAtEmitters &&
        (scene.scattering != 0 || (scene.lighting & layout::lightsByEnvironment) != 0))
        return Workload::Shading;
    return scene.needsTree(integrator) ? Workload::Triangles : Workload::Spheres;
}

std::string moduleName(std::string_view program, const KernelRow &kernel) {
    return fmt::format("{}{}{}", program, kernel.trace, kernel.raysAtOnce == 2 ? "TwoSlots" : "OneSlot");
}

const KernelRow &chooseKernel(const DeviceInfo &device, Workload workload,
                              const std::function<bool(const KernelRow &)> &isAllowed) {
    const KernelRow *best = nullptr;
    const KernelRow *firstAllowed = nullptr;
    int bestPlace = std::numeric_limits<int>::max();
    for (const KernelRow &row : kernelTable) {
        if (isAllowed && !isAllowed(row))
            continue;
        if (firstAllowed == nullptr)
            firstAllowed = &row;
        const int place = row.suits.placeOn(device, workload);
        if (place > 0 && place < bestPlace && lackFor(row, device).empty()) {
            best = &row;
            bestPlace = place;
        }
    }
    return best != nullptr ? *best : firstAllowed != nullptr ? *firstAllowed : kernelTable.front();
}

} // namespace hyalite::core::gpu
