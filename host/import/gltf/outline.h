// Outline of a glTF file: its cameras, nodes and animations by name, as people choose from them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hyalite::core {

/// The first rows of each list, and how many there are. Names are as the file has them.
struct GltfOutline {
    static constexpr std::size_t maxRows = 32;

    struct CameraRow {
        std::string name;
        std::string type; ///< "perspective" or "orthographic"
    };
    struct NodeRow {
        std::size_t index; ///< in /nodes
        std::size_t depth; ///< 0 for a root
        std::string name;
        std::string contents; ///< "mesh 2, camera 0"; empty for none
    };
    struct AnimationRow {
        std::string name{};
        double seconds = 0.0; ///< of its last key, as the file states it
    };
    std::vector<CameraRow> cameras; ///< by index
    std::size_t cameraCount = 0;
    std::vector<NodeRow> nodes; ///< of the scene, parents before their children
    std::size_t nodeCount = 0;
    std::vector<AnimationRow> animations; ///< by index
    std::size_t animationCount = 0;
};

} // namespace hyalite::core
