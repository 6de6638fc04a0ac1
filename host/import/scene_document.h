// Scene document: a scene file in memory, with arrays in place of files that it names.
#pragma once

#include "host/image/image.h"
#include "host/image/texture.h"

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hyalite::core {

/// A mesh as arrays, in object space. Nothing is promised of the numbers: they are checked when the scene is loaded.
struct MeshArrays {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> corners; ///< indices of positions, face by face
    std::size_t cornersPerFace = 3;     ///< at least 3
    std::vector<glm::dvec3> normals;    ///< of any length, one for each position; or none
    std::vector<glm::dvec2> uvs;        ///< likewise; v grows upwards
    std::vector<glm::vec3> colours;     ///< likewise; linear, in [0, 1]
    std::vector<glm::dmat4x3> places;   ///< where it is seen; none: once, as it is
};

/// Arrays by the names that "file" has for them in the document.
struct SceneArrays {
    std::map<std::string, std::shared_ptr<const MeshArrays>> meshes;
    std::map<std::string, std::shared_ptr<const Texture>> textures;
    std::map<std::string, std::shared_ptr<const Image>> environments; ///< linear radiance, any float
};

// NOLINTNEXTLINE(bugprone-exception-escape): the JSON library throws nothing when it moves
struct SceneDocument {
    nlohmann::json json;        ///< as a scene file has it
    std::filesystem::path file; ///< the name in messages; names of files are relative to its folder
    SceneArrays arrays{};
    bool isFramed = false; ///< its camera, and lights if nothing shines, are those of a bare mesh
};

} // namespace hyalite::core
