// Settings of software drivers, which compute on the processors. They are made before the driver is loaded.
#pragma once

#include "host/scene/scene.h"

namespace hyalite::gpu {

struct ProcessorUse {
    int threadCount = 0;      ///< 0: all
    bool hasTriangles = true; ///< whether the scenes have any
    Integrator integrator = Integrator::Path;
    int maxDepth = 1; ///< segments of a path
};

/// Whether the processor has vectors of 512 bits.
[[nodiscard]] bool hasWideVectors();

/// Sets environment variables that lavapipe reads when its driver is loaded (https://docs.mesa3d.org/envvars.html): the
/// number of threads, and the width of vectors, unless the user has set it. Vectors of 512 bits take three quarters of
/// the time in scenes without triangles, where kernels compute and rarely read, and nine tenths in others, as long as
/// rays are coherent. Paths through a tree diverge soon, and 16 of them idle more than 8. So do the rays that glass
/// splits off at great depth: twice the time if the glass is a mesh. Do not call it while other threads read the
/// environment.
void tellLavapipe(const ProcessorUse &use);

} // namespace hyalite::gpu
