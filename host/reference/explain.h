// Explanations of pixels that differ from the double-precision oracle by more than rounding.
#pragma once

#include "host/reference/renderer.h"

#include <optional>
#include <string>

namespace hyalite::core::reference {

enum class Cause {
    Edge,           ///< another primitive was hit
    ShadowBoundary, ///< only one of the two sees the light
    LightHorizon,   ///< the light is on the horizon of the surface
    CriticalAngle,  ///< total reflection in only one of the two
    Rounding,       ///< no decision differs, only numbers
};

[[nodiscard]] const char *causeName(Cause cause);

struct Explanation {
    Cause cause = Cause::Rounding;
    std::uint32_t sampleIndex = 0;
    std::uint32_t rayDepth = 0;
    /// The margin of the oracle: moved by this many pixels, the sample takes the same decisions in double precision as
    /// in float32. Empty if a quarter of a pixel is not enough.
    std::optional<double> marginPixels;
};

/// Traces the samples of a pixel of the whole image in float32 and in double precision, and finds the first decision
/// that differs.
[[nodiscard]] Explanation explainOutlier(const PackedScene &scene, const RenderSettings &settings,
                                         const glm::uvec2 &pixel);

} // namespace hyalite::core::reference
