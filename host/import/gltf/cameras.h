// Cameras of a glTF file (glTF 2.0, section 3.10).
#pragma once

#include "host/import/gltf/buffers.h"
#include "host/import/gltf/document.h"
#include "host/import/gltf/nodes.h"
#include "host/import/loaded_scene.h"
#include "host/scene/camera_path.h"
#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

struct PlacedCamera {
    Camera camera;
    /// Of a perspective one: the image's shape gives the horizontal one.
    std::optional<double> verticalFovDegrees{};
    std::optional<double> aspectRatio{}; ///< width / height of what it sees, if the file says it
    std::size_t node = 0;                ///< that has it
};

/// The camera that a user means by its name, the name of its node, or its index in /cameras; with an empty choice the
/// first one of the nodes, which are those of the scene; nothing where they have none. Throws Error{Usage} for a choice
/// that no node has.
[[nodiscard]] std::optional<PlacedCamera> readCamera(const Document &document,
                                                     const std::vector<std::size_t> &nodes,
                                                     const std::vector<glm::dmat4x3> &toWorld,
                                                     const std::string &choice);

/// The path of the camera as the animations move it and the nodes above it, from the sequence's first frame to its
/// last. `rest` are the poses that the file gives its nodes.
[[nodiscard]] CameraPath readCameraPath(Buffers &buffers, const NodeTree &tree, const std::vector<Pose> &rest,
                                        const PlacedCamera &camera, const SequenceTimes &sequence);

} // namespace hyalite::core::gltf
