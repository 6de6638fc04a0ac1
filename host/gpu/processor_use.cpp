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

namespace {

// Of Whitted's rays, by when 512 bits were slower with glass: a mesh at depth 6, spheres at depth 12.
constexpr int mostDepthInTree = 5;
constexpr int mostDepthOfSpheres = 10;

bool areRaysTogether(const ProcessorUse &use) {
    const IntegratorRow &row = rowOf(use.integrator);
    if (row.splitsAtGlass)
        return use.maxDepth <= (use.hasTriangles ? mostDepthInTree : mostDepthOfSpheres);
    if (row.followsPaths)
        return !use.hasTriangles;
    return true;
}

} // namespace

void tellLavapipe(const ProcessorUse &use) {
    if (use.threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(use.threadCount).c_str(), 1);
    if (areRaysTogether(use) && hasWideVectors())
        setenv("LP_NATIVE_VECTOR_WIDTH", "512", 0);
}

} // namespace hyalite::gpu
