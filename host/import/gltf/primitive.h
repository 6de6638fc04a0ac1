// Primitives of a glTF mesh (glTF 2.0, section 3.7.2): their triangles, and the vertices that these use.
#pragma once

#include "host/import/gltf/accessor.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

/// Attributes by name, such as POSITION. All have as many elements.
using Attributes = std::map<std::string, Accessor, std::less<>>;

/// Vertices that triangles use. An attribute that is missing is empty.
struct Vertices {
    std::vector<std::uint32_t> sources; ///< of each its index in the accessors
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;            ///< of any length
    std::vector<glm::vec4> tangents;           ///< the vector of any length, and the sign
    std::array<std::vector<glm::vec2>, 2> uvs; ///< v = 0 at the bottom of images, as in scenes
    std::vector<glm::vec4> colours;            ///< linear, in [0, 1]
};

struct Primitive {
    std::optional<std::size_t> material; ///< index in /materials
    std::vector<glm::uvec3> triangles;   ///< counter-clockwise seen from outside; indices in the vertices
    Vertices vertices;
    Attributes attributes; ///< for what follows: weights of joints
};

/// Counts of primitives and features that are ignored.
struct PassedOver {
    std::size_t points = 0; ///< primitives of points
    std::size_t lines = 0;  ///< of lines, strips and loops
    std::size_t empty = 0;  ///< without positions
};

/// Reads a primitive of triangles, strips or fans; nothing for another one, which is counted. Throws Error{BadInput}
/// for accessors of wrong types and counts, and for indices out of range.
[[nodiscard]] std::optional<Primitive> readPrimitive(Buffers &buffers, const JsonNode &node,
                                                     PassedOver &passedOver);

/// Opens the attributes of an object, such as a morph target.
[[nodiscard]] Attributes readAttributes(Buffers &buffers, const JsonNode &node);

} // namespace hyalite::core::gltf
