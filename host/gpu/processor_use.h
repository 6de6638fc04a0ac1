// What software drivers, which compute on the processors, are told before they are loaded.
#pragma once

namespace hyalite::gpu {

struct ProcessorUse {
    int threadCount = 0;      ///< 0: all
    bool hasTriangles = true; ///< whether the scenes have any
};

/// Sets what lavapipe reads of the environment when its driver is loaded (https://docs.mesa3d.org/envvars.html): how many
/// threads it has, and how wide its vectors are, unless the user has said so. Without triangles, where kernels compute
/// and hardly read, vectors of 512 bits take three quarters of the time where the processor has them; rays that go
/// through a tree are apart sooner, and 16 of them idle more than 8. Not to be called while other threads read the
/// environment.
void tellLavapipe(const ProcessorUse &use);

} // namespace hyalite::gpu
