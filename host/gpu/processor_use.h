// How software drivers are to use the processors, on which they compute.
#pragma once

#include "host/scene/settings.h"

namespace hyalite::core::gpu {

/// The facts that decide it. host/process/lavapipe.h makes settings of them before a driver is loaded.
struct ProcessorUse {
    int threadCount = 0;      ///< 0: all
    bool hasTriangles = true; ///< whether the scenes have any
    Integrator integrator = Integrator::Path;
    int maxDepth = 1;      ///< segments of a path
    bool hasStack = false; ///< whether kernels go through the tree with a stack
};

/// Whether the processor has vectors of 512 bits.
[[nodiscard]] bool hasWideVectors();

/// Throws Error{Usage} for a vector width in the environment that lavapipe does not have: Mesa crashes with less than
/// 128.
void requireVectorWidth();

} // namespace hyalite::core::gpu
