// The probes of all leaf functions, in the order of the probe kernel: cmake/glsl_probes.cpp makes them.
#pragma once

#include "host/reference/scene_view.h"
#include "tests/kernels/words.h"

#include <string>
#include <vector>

namespace hyalite::core::testing {

/// A parameter, or a field of a struct.
struct LeafVariable {
    std::string type; ///< in GLSL
    std::string name;
};

struct LeafStruct {
    std::string name;
    std::vector<LeafVariable> fields;
};

struct LeafProbe {
    std::string file; ///< below the root of the sources
    std::string name;
    std::vector<LeafVariable> parameters; ///< those that go in
    std::vector<std::string>
        sceneWords{};     ///< what it reads of the scene: constants, `frame`, fetch functions
    bool divides = false; ///< or takes a root
    /// Calls the twin.
    void (*call)(const leaves::SceneView<float> &scene, WordReader &in, Words &out) = nullptr;
};

[[nodiscard]] const std::vector<LeafProbe> &leafProbes();

/// nullptr where `type` is no struct.
[[nodiscard]] const LeafStruct *leafStruct(const std::string &type);

} // namespace hyalite::core::testing
