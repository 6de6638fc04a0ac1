// Trials: shipped scenes by which the speed of renderers and kernels is measured, one for each workload.
#pragma once

#include "host/engine/prepare.h"
#include "host/gpu/render_config.h"

#include <array>

namespace hyalite::core {

/// With enough samples per pixel to fill the lanes of a subgroup.
struct Trial {
    gpu::Workload workload;
    const char *scene;
    int samplesPerPixel;
};

inline constexpr std::array<Trial, gpu::workloadNames.size()> trials{
    {{gpu::Workload::Spheres, "spheres", 4},
     {gpu::Workload::Triangles, "cat", 8},
     {gpu::Workload::Shading, "studio-cat", 8}}};

/// The scene of a trial, small.
[[nodiscard]] inline PreparedScene prepareTrial(const Trial &trial) {
    constexpr int imageSide = 192; // pixels
    SceneOptions options;
    options.scene = trial.scene;
    options.width = options.height = imageSide;
    options.settings.push_back(
        {[&trial](RenderSettings &settings) { settings.samplesPerPixel = trial.samplesPerPixel; }});
    return prepareScene(options, Source::Dropped, nobody());
}

} // namespace hyalite::core
