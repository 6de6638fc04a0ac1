// A render job for a device.
#pragma once

#include "host/film/film.h"
#include "host/packing/packed_scene.h"
#include "host/scene/settings.h"

#include <cstdint>
#include <span>

namespace hyalite::core::gpu {

struct Job {
    const PackedScene &scene;
    const RenderSettings &settings;
    Crop crop;
    std::uint32_t sampleBegin;
    std::uint32_t sampleEnd;
    bool isTraced;
    /// Samples are added to it; empty: start without samples. Read only at the start.
    std::span<const layout::FilmPixel> film{};
    std::span<const float> light{}; ///< the layers of light of these pixels
};

} // namespace hyalite::core::gpu
