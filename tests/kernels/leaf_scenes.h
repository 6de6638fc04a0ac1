// Scenes that leaf functions read: with all that leaves ask for, and with less.
#pragma once

#include "host/reference/scene_view.h"

#include <string>
#include <vector>

namespace hyalite::core::testing {

struct LeafScene {
    std::string name;
    leaves::SceneView<float> view; ///< as kernels have it, too: their constants are its members
};

/// All of them have all arrays, so that no leaf reads beyond one whatever the constants say. The first one has every
/// feature.
[[nodiscard]] const std::vector<LeafScene> &leafScenes();

/// Whether a leaf that reads these words of the scene may tell the scenes apart.
[[nodiscard]] bool differs(const std::vector<std::string> &sceneWords, const LeafScene &a,
                           const LeafScene &b);

} // namespace hyalite::core::testing
