// How a scene is rendered. The scene itself (scene.h) does not depend on it.
#pragma once

#include "host/scene/integrators.h"

#include <cstdint>

namespace hyalite::core {

enum class TreeKind { None, Midpoint, Sah };
enum class SamplerKind : std::uint32_t { Centre = 0, Sobol = 1 };

/// Reconstruction filters. Box: all samples of the pixel count the same. BlackmanHarris: weights fall off smoothly to
/// 1.5 pixels from the centre.
enum class FilterKind { Box, BlackmanHarris };

/// How a shadow ray chooses its emitter. Power: with probability in proportion to power. Tree: by where they are. Auto:
/// by a tree if there are many.
enum class LightChoice { Auto, Power, Tree };

/// Each may be set by a scene file and overridden by the command line; settings_table.h has their ranges.
struct RenderSettings {
    Integrator integrator = Integrator::Whitted;
    int samplesPerPixel = 16;
    double occlusionDistance = 1e15; ///< AmbientOcclusion: occluders further away are ignored
    int maxDepth = 7;                ///< segments of a path, the primary ray being the first
    TreeKind tree = TreeKind::Midpoint;
    int leafSize = 8; ///< maximum number of triangles in a leaf, where they can be separated
    SamplerKind sampler = SamplerKind::Sobol;
    /// Sobol only: samples at the centre are at the centre of any filter.
    FilterKind filter = FilterKind::Box;
    std::uint32_t seed = 0;
    /// Path: upper bound, per channel, on each contribution at the second hit or later; 0: none.
    double radianceLimit = 0.0;
    LightChoice lightChoice = LightChoice::Auto; ///< Path
    bool hasAlpha = false; ///< Whitted, Path: the background is transparent, and still lights the scene
    bool isClearGlassTransparent = false; ///< with it: so is the background through clear glass
    /// Normal, Depth, Albedo: of what mirrors and clear glass show, as means of the image's own samples.
    bool areLayersThrough = false;
    bool hasLightLayers = false;   ///< Path: the film keeps layers of light by class, ...
    bool hasLightGroups = false;   ///< ... and by group of emitters
    bool isDenoised = false;       ///< Whitted, Path: the denoiser filters the picture, ...
    bool hasDenoisingData = false; ///< ... or the file has what it needs
    /// Whitted, Path: pixels get samples until the estimated error of each block is below it (host/film/noise.h), and
    /// samplesPerPixel at most. 0: samplesPerPixel in any case.
    double noise = 0.0;
    double exposureStops = 0.0; ///< radiance is multiplied by 2^exposureStops before the tone curve
    /// For profiles alone, without a row: a sample is the traversal work of the integrator's sample, as Cost is that of
    /// Whitted.
    bool isWorkShown = false;
    /// For the denoiser alone, without a row: a sample of Albedo has the normal and the depth beside it, and the film
    /// their sums in place of squares and transparency.
    bool areFeaturesShown = false;
};

/// layout::view...: what the kernel "view" shows.
[[nodiscard]] inline std::uint32_t viewOf(const RenderSettings &settings) {
    return settings.areFeaturesShown ? layout::viewFeatures : rowOf(settings.integrator).view;
}

/// layout::alpha...: the background that is transparent.
[[nodiscard]] inline std::uint32_t alphaKindOf(const RenderSettings &settings) {
    if (!settings.hasAlpha || !rowOf(settings.integrator).showsLight)
        return layout::alphaOfNothing;
    return settings.isClearGlassTransparent ? layout::alphaThroughGlass : layout::alphaOfBackground;
}

/// Whether a view of an image with these settings looks through mirrors and glass.
[[nodiscard]] inline bool looksThrough(Integrator view, const RenderSettings &settings) {
    return settings.areLayersThrough && rowOf(view).canLookThrough;
}

/// Whether a render keeps what the denoiser needs: first samples, and views that look through mirrors and glass.
[[nodiscard]] inline bool keepsDenoisingData(const RenderSettings &settings) {
    return (settings.isDenoised || settings.hasDenoisingData) && rowOf(settings.integrator).showsLight &&
           !settings.isWorkShown;
}

/// Whether the number of a pixel's samples depends on its noise.
[[nodiscard]] inline bool isAdaptive(const RenderSettings &settings) {
    return settings.noise > 0.0 && rowOf(settings.integrator).showsLight && !settings.isWorkShown;
}

/// The noise that a render is to reach; 0: none.
[[nodiscard]] inline double wantedNoise(const RenderSettings &settings) {
    return isAdaptive(settings) ? settings.noise : 0.0;
}

/// Whether a film keeps first samples (host/film/first_samples.h).
[[nodiscard]] inline bool keepsFirst(const RenderSettings &settings) {
    return keepsDenoisingData(settings) || isAdaptive(settings);
}

/// The most samples of a pixel where a noise is asked for, and no number of samples.
inline constexpr int samplesForNoise = 4096;

/// Whether a sample is its traversal work, of a traversal with a stack: nodes, boxes and triangles.
[[nodiscard]] inline bool showsWork(const RenderSettings &settings) {
    return settings.isWorkShown || settings.integrator == Integrator::Cost;
}

} // namespace hyalite::core
