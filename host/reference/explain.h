// Explanations of pixels that differ from the double-precision oracle by more than rounding.
#pragma once

#include "host/reference/renderer.h"

#include <optional>
#include <string>

namespace hyalite::reference {

enum class Cause {
    Edge,           ///< another primitive was hit
    ShadowBoundary, ///< the light was seen by one and not by the other
    LightHorizon,   ///< the light stands on the surface's horizon
    CriticalAngle,  ///< total reflection for one, not for the other
    Rounding,       ///< no decision differs: the numbers alone do
};

[[nodiscard]] const char *causeName(Cause cause);

struct Explanation {
    Cause cause = Cause::Rounding;
    std::uint32_t sampleIndex = 0;
    std::uint32_t rayDepth = 0;
    /// The oracle's margin: it decides like float32 when the sample is moved by so many pixels. Nothing if a quarter
    /// of a pixel does not suffice.
    std::optional<double> marginPixels;
};

/// Traces the samples of a pixel of the whole image in float32 and in double precision, and finds the first decision
/// at which they part.
[[nodiscard]] Explanation explainOutlier(const PackedScene &scene, const RenderSettings &settings,
                                         const glm::uvec2 &pixel);

} // namespace hyalite::reference
