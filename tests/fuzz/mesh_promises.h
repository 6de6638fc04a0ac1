// What all readers of meshes promise.
#pragma once

#include "host/scene/scene.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace hyalite::core::fuzz {

/// The reader promises 64 MiB + 64 times the file's size. So that a small file can break the promise at all, less is
/// allowed here: what is taken for any file is far below.
inline void requireBoundedMemory(const HeapPeak &peak, std::size_t fileBytes) {
    constexpr std::size_t anyFileBytes = std::size_t{1} << 20;
    require(peak.bytes() <= anyFileBytes + 64 * fileBytes, "reading took " + std::to_string(peak.bytes()) +
                                                               " bytes for a file of " +
                                                               std::to_string(fileBytes));
}

inline void requireSound(const TriangleMesh &mesh) {
    require(!mesh.triangles.empty(), "a mesh without triangles");
    for (const glm::vec3 &position : mesh.positions)
        require(std::abs(position.x) <= 1.001e15f && std::abs(position.y) <= 1.001e15f &&
                    std::abs(position.z) <= 1.001e15f,
                "a position beyond 1e15");
    require(mesh.triangleUvs.empty() || mesh.triangleUvs.size() == mesh.triangles.size(),
            "texture coordinates for some triangles alone");
    for (const glm::uvec3 &corners : mesh.triangleUvs)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            require(corners == glm::uvec3(TriangleMesh::noUv) || corners[corner] < mesh.uvs.size(),
                    "undefined texture coordinates");
    for (const glm::vec2 &uv : mesh.uvs)
        require(std::isfinite(uv.x) && std::isfinite(uv.y), "texture coordinates that are no numbers");
    require(mesh.colours.corners.empty() || mesh.colours.corners.size() == mesh.triangles.size(),
            "colours for some triangles alone");
    for (const glm::uvec3 &corners : mesh.colours.corners)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            require(corners[corner] < mesh.colours.values.size(), "an undefined colour");
    for (const glm::vec4 &colour : mesh.colours.values)
        for (glm::length_t channel = 0; channel < 4; ++channel)
            require(colour[channel] >= 0.0f && colour[channel] <= 1.0f, "a colour out of range");
    for (const MeshTriangle &triangle : mesh.triangles) {
        const bool isFlat = triangle.normals == glm::uvec3(MeshTriangle::noNormal);
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            require(triangle.positions[corner] < mesh.positions.size(), "an undefined vertex");
            require(isFlat || triangle.normals[corner] < mesh.normals.size(), "an undefined normal");
        }
    }
}

} // namespace hyalite::core::fuzz
