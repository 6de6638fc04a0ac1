#include "host/gpu/processor_use.h"

#include <cstdlib>
#include <string>

namespace hyalite::gpu {

bool hasWideVectors() {
    // All that compilers take for granted then.
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

void tellLavapipe(const ProcessorUse &use) {
    if (use.threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(use.threadCount).c_str(), 1);
    const bool areRaysTogether = !use.hasTriangles || use.integrator != Integrator::Path;
    if (areRaysTogether && hasWideVectors())
        setenv("LP_NATIVE_VECTOR_WIDTH", "512", 0);
}

} // namespace hyalite::gpu
