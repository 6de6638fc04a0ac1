// Loads: films that are rendered again and again, to see whether a device still computes the same. They are scenes of
// the shipped films in two sizes: one for processors, one that keeps a GPU busy.
#pragma once

#include "host/engine/prepare.h"
#include "host/scene/integrators.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core {

struct LoadSize {
    int width = 0; ///< pixels
    int height = 0;
    int samplesPerPixel = 0;
    std::uint64_t hash = 0; ///< filmHash()
};

struct Load {
    std::string name;
    std::string scene; ///< without folder and extension
    Integrator integrator = Integrator::Path;
    LoadSize small;
    LoadSize large;
};

struct Loads {
    std::filesystem::path folder; ///< of the scenes
    int version = 0;              ///< grows with each change of a hash
    std::vector<Load> loads;
};

/// Reads verify/loads.json of the first asset folder that has one. Throws Error{BadInput}.
[[nodiscard]] Loads readLoads();

[[nodiscard]] PreparedScene prepareLoad(const Loads &loads, const Load &load, const LoadSize &size);

} // namespace hyalite::core
