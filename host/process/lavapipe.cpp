#include "host/process/lavapipe.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

namespace hyalite::core {

namespace {

// Maximum depths for 512 bits with Whitted's rays: with glass they were slower for a mesh at depth 6, for spheres at
// depth 12.
constexpr int maxDepthInTree = 5;
constexpr int maxDepthOfSpheres = 10;

bool maySplitDeeply(const gpu::ProcessorUse &use) {
    return rowOf(use.integrator).splitsAtGlass &&
           use.maxDepth > (use.hasTriangles ? maxDepthInTree : maxDepthOfSpheres);
}

constexpr const char *width = "LP_NATIVE_VECTOR_WIDTH";

} // namespace

void keepWidthsApart() {
    constexpr const char *name = "GALLIVM_PERF";
    const std::string of128 = "no_aos_sampling";
    const std::string of512 = "no_quad_lod";
    const char *given = std::getenv(name);
    std::istringstream words(given != nullptr ? given : "");
    std::string flags;
    for (std::string word; std::getline(words, word, ',');)
        if (word != of128 && word != of512)
            flags += word + ',';
    const char *bits = std::getenv(width);
    const std::string_view wide = bits != nullptr ? bits : "";
    flags += wide == "128" ? of128 : wide == "512" ? of512 : "";
    if (flags.empty())
        unsetenv(name);
    else
        setenv(name, flags.c_str(), 1);
}

void configureLavapipe(const gpu::ProcessorUse &use) {
    if (use.threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(use.threadCount).c_str(), 1);
    static const bool isUsers = std::getenv(width) != nullptr;
    if (!isUsers && gpu::hasWideVectors() && !use.hasStack && !maySplitDeeply(use))
        setenv(width, "512", 1);
    else if (!isUsers)
        unsetenv(width);
    keepWidthsApart();
}

} // namespace hyalite::core
