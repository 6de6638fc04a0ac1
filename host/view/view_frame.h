// View frames: pictures of a view as they get better.
#pragma once

#include "host/film/ray_counts.h"
#include "host/image/image.h"

#include <cstdint>

namespace hyalite::core {

/// A picture by one renderer. It does not change once others have it.
struct ViewFrame {
    std::uint64_t view = 0;   ///< the number of the view that it is of: camera, settings and what is shown
    std::uint64_t number = 0; ///< ascending over all frames of a viewer
    Image image{
        0, 0}; ///< linear radiance, or what the view of an integrator has; smaller than the view in a preview
    int samples = 0;        ///< of each pixel; 0: some have more than others
    bool isPreview = false; ///< of a smaller size
    bool isClean = false;   ///< denoised
};

/// What the renderer did for its last frame.
struct ViewFigures {
    double noise = 0.0;              ///< mean estimated noise of the picture (host/film/noise.h); 0: unknown
    double megaraysPerSecond = 0.0;  ///< of the last samples
    double dispatchMillis = 0.0;     ///< mean of the last samples; 0: without dispatches, as on the CPU
    std::uint64_t dispatchCount = 0; ///< of the view
    double seconds = 0.0;            ///< of rendering, of the view
    double firstMillis = 0.0;        ///< from the wish for the view to its first frame
};

} // namespace hyalite::core
