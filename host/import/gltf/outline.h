// Outline of a glTF file: its cameras and nodes by name, as people choose from them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hyalite {

struct GltfOutline {
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
    std::vector<CameraRow> cameras; ///< by index
    std::size_t cameraCount = 0;
    std::vector<NodeRow> nodes; ///< of the scene, parents before their children
    std::size_t nodeCount = 0;
};

/// `scene` is the name or the index of one; empty: the default one. Of each list there are the first rows, and the count
/// of all. Names are as the file has them. Throws as loadGltf does.
[[nodiscard]] GltfOutline outlineGltf(const std::filesystem::path &file, const std::string &scene,
                                      std::size_t maxRows);

} // namespace hyalite
