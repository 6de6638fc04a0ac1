// Morph targets and skins: vertices where a pose brings them (glTF 2.0, sections 3.7.2.2 and 3.7.3.3).
#pragma once

#include "host/import/gltf/primitive.h"

#include <glm/mat4x3.hpp>

#include <vector>

namespace hyalite::core::gltf {

/// Morph weights and joints that move the vertices of a mesh.
struct Deformation {
    std::vector<double> weights{};      ///< of morph targets; missing ones are 0
    std::vector<glm::dmat4x3> joints{}; ///< of a skin; none: the mesh has none
    glm::dvec3 origin{0.0};             ///< what a skin's vertices are relative to: joints bring them there
};

/// Moves the vertices of the primitive at `node`, morph targets first. A skin brings them to the world. Throws
/// Error{BadInput} for accessors that do not fit, and joints that the skin has not.
void deform(Buffers &buffers, const JsonNode &node, const Deformation &deformation, Primitive &primitive);

} // namespace hyalite::core::gltf
