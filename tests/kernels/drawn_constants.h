// Specialization constants by chance, as the host may set them.
#pragma once

#include "shaders/layout/layout.h"

#include <cstdint>
#include <random>
#include <vector>

namespace hyalite::core::testing {

/// What the host may set a constant to, with values that are rare among them.
[[nodiscard]] inline std::vector<std::uint32_t> valuesOf(std::uint32_t id) {
    switch (id) {
    case layout::constantWorkgroupSize:
        return {64};
    case layout::constantSphereCount:
        return {0, 1, 3, 15, 16};
    case layout::constantTreeSpheres:
        return {layout::treeHasTriangles, layout::treeHasSpheresToo, layout::treeHasSpheresOnly};
    case layout::constantLightCount:
    case layout::constantEmitterCount:
        return {0, 1, 2, 39};
    case layout::constantSamplesInFlight:
        return {1, 2, 4, 8};
    case layout::constantStackSize:
        return {1, 20, layout::maxTreeDepth};
    case layout::constantPendingInRegisters:
        return {0, 1, 4};
    case layout::constantLighting:
        return {0, 1, 2, 4, 6, 8, 16, 32, 33, ~0u};
    case layout::constantScattering:
    case layout::constantTexturing:
        return {0, 1, 2, 4, 5, ~0u};
    default:
        return {0, 1, 2, 3};
    }
}

/// Specialization constants as for some scene, device and job.
[[nodiscard]] inline std::vector<std::uint32_t> drawnConstants(std::mt19937 &random) {
    std::vector<std::uint32_t> constants(layout::constantCount);
    for (std::uint32_t id = 0; id < constants.size(); ++id) {
        const std::vector<std::uint32_t> values = valuesOf(id);
        constants[id] = values[random() % values.size()];
    }
    return constants;
}

} // namespace hyalite::core::testing
