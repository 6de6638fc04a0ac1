// Tangents of a mesh by the definition of MikkTSpace (M. S. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008,
// and mikktspace.com): what normal maps of most programs are made for.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// The triangles that want tangents: values at their corners, by index.
struct TangentInput {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals; ///< unit length, one for each position
    std::span<const glm::vec2> uvs;     ///< one for each position
    std::span<const glm::uvec3> triangles;
};

struct Tangents {
    /// Unit vectors at right angles to the normal in which u grows, and the sign of the direction of v:
    /// cross(normal, xyz) * w.
    std::vector<glm::vec4> values;
    std::vector<glm::uvec3> corners; ///< of each triangle's corners the indices in `values`
};

/// Corners are one vertex where position, normal and texture coordinates are equal. Around a vertex, triangles that
/// share edges and whose texture is not mirrored, or that all have it mirrored, share a tangent: the sum of their
/// directions of u, projected to the tangent plane and of unit length, weighted by their angles there. A triangle
/// without area in the texture takes the tangent of a neighbour; where there is none, the tangent is any at right
/// angles.
[[nodiscard]] Tangents mikkTangents(const TangentInput &input);

} // namespace hyalite::core
