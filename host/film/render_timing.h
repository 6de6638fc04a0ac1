// Times of the parts of a render.
#pragma once

#include <cstdint>
#include <string>

namespace hyalite::core {

struct RenderTiming {
    double uploadSeconds = 0.0; ///< scene data to the device
    /// Building kernels, unless during the upload, and their first runs, without work.
    double pipelineSeconds = 0.0;
    double renderSeconds = 0.0; ///< from the first ray to the last
    std::uint64_t dispatchCount = 0;
};

/// The share of one of several renderers in a picture.
struct RendererShare {
    std::string name;
    std::uint64_t tileCount = 0;
    std::uint64_t sampleCount = 0;
    double seconds = 0.0; ///< rendering tiles
    std::string failure;  ///< why it was left out, or empty
};

} // namespace hyalite::core
