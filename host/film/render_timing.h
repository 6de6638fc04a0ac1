// Times of the parts of a render.
#pragma once

#include <cstdint>

namespace hyalite {

struct RenderTiming {
    double uploadSeconds = 0.0; ///< scene data to the device
    double pipelineSeconds =
        0.0; ///< building kernels, unless during the upload, and their first runs, without work
    double renderSeconds = 0.0; ///< from the first ray to the last
    std::uint64_t dispatchCount = 0;
};

} // namespace hyalite
