// Where the time of a render went.
#pragma once

#include <cstdint>

namespace hyalite {

struct RenderTiming {
    double uploadSeconds = 0.0;   ///< scene data to the device
    double pipelineSeconds = 0.0; ///< kernels built, and run once without work as some drivers compile then
    double renderSeconds = 0.0;   ///< from the first ray to the last
    std::uint64_t dispatchCount = 0;
};

} // namespace hyalite
