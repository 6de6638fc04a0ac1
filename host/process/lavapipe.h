// Settings of lavapipe: environment variables that it reads when it is loaded.
#pragma once

#include "host/gpu/processor_use.h"

namespace hyalite::core {

/// Sets a flag of GALLIVM_PERF by the vector width in the environment. Mesa 25 keeps compiled functions that read
/// textures in its disk cache without their width, and a kernel of 512 bits that calls those of 256 misses half of its
/// lanes. Flags are part of the cache's key, and these are about sampling, which kernels here do not use.
void keepWidthsApart();

/// Sets environment variables that lavapipe reads when its driver is loaded (https://docs.mesa3d.org/envvars.html): the
/// number of threads and, unless the user has set it, the vector width, with keepWidthsApart(). 512-bit vectors take
/// three quarters of the time in scenes without triangles, where kernels compute and rarely read, and 0.65 to 0.9 in
/// other scenes, of paths, too (tests/bench/README.md). The rays that glass splits off at great depth lose: 16 lanes
/// idle more than 8, and take twice the time if the glass is a mesh. Kernels with a stack have 256, as Mesa 25 takes 7
/// to 38 s to compile one for 512. The driver reads the variables each time that it is loaded, with the first instance.
/// Do not call this while other threads read the environment.
void configureLavapipe(const gpu::ProcessorUse &use);

} // namespace hyalite::core
