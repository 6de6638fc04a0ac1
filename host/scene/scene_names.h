// Names of what a scene has, and their numbers, by which mattes and views of numbers tell things apart.
//
// An object is what has a name in the input: a node of a glTF file, or else its mesh; a mesh file; a shape or a sphere
// of a scene file. Its asset is the outermost node above it. What has no name gets one from its place in the input:
// "node 3", "box 0", "sphere 12", "material 2". Things of one name are one thing.
#pragma once

#include "host/scene/integrators.h"
#include "host/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

/// Names in the order of their numbers, which count from 1 on: clean UTF-8, not empty, and each is there once. Spheres
/// come first among objects and assets, and their names, of which there may be many, are not stored.
struct SceneNames {
    std::uint32_t sphereCount = 0;
    std::vector<std::string> objects{};
    std::vector<std::string> assets{};
    std::vector<std::string> materials{};

    /// `names` are the objects or the assets.
    [[nodiscard]] std::vector<std::string> withSpheres(const std::vector<std::string> &names) const;
};

/// The names of a scene, with the number of each thing.
struct NumberedScene {
    SceneNames names;
    std::vector<layout::PlaceRecord> places; ///< spheres, then meshes and instances in the order of the input
    std::vector<std::uint32_t> materials;    ///< of each material its number
};

/// `firstTriangleId` is FrameRecord::firstTriangleId.
[[nodiscard]] NumberedScene numberScene(const Scene &scene, std::uint32_t firstTriangleId);

} // namespace hyalite::core
