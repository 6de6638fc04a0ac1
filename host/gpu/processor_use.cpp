#include "host/gpu/processor_use.h"

#include <cstdlib>
#include <string>

namespace hyalite::gpu {

bool hasWideVectors() {
    // The extensions that compilers assume together.
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

namespace {

// Maximum depths for 512 bits with Whitted's rays: with glass they were slower for a mesh at depth 6, for spheres at
// depth 12.
constexpr int maxDepthInTree = 5;
constexpr int maxDepthOfSpheres = 10;

bool maySplitDeeply(const ProcessorUse &use) {
    return rowOf(use.integrator).splitsAtGlass &&
           use.maxDepth > (use.hasTriangles ? maxDepthInTree : maxDepthOfSpheres);
}

} // namespace

void tellLavapipe(const ProcessorUse &use) {
    if (use.threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(use.threadCount).c_str(), 1);
    constexpr const char *width = "LP_NATIVE_VECTOR_WIDTH";
    static const bool isUsers = std::getenv(width) != nullptr;
    if (isUsers)
        return;
    if (hasWideVectors() && !use.hasStack && !maySplitDeeply(use))
        setenv(width, "512", 1);
    else
        unsetenv(width);
}

} // namespace hyalite::gpu
