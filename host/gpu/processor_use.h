// What software drivers, which compute on the processors, are told before they are loaded.
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

/// Sets what lavapipe reads of the environment when its driver is loaded (https://docs.mesa3d.org/envvars.html): how many
/// threads it has, and how wide its vectors are, unless the user has said so. Where the processor has vectors of 512 bits
/// they take three quarters of the time without triangles, when kernels compute and hardly read, and nine tenths with
/// them, as long as rays stay together. Paths through a tree are soon apart, and 16 of them idle more than 8; the rays
/// that glass splits off are at great depth, too, to twice the time where the glass is a mesh. Not to be called while other
/// threads read the environment.
void tellLavapipe(const ProcessorUse &use);

} // namespace hyalite::gpu
