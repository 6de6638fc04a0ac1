// Textures, and meshes that wear them, for tests.
#pragma once

#include "tests/unit/geometry_fixture.h"

#include <cstdint>
#include <functional>
#include <string>

namespace hyalite::testing {

/// An image of 8-bit levels; `levelsAt` gives those of a pixel, x from the left and y from the top.
[[nodiscard]] inline Texture drawnTexture(int width, int height,
                                          const std::function<std::uint32_t(int x, int y)> &levelsAt) {
    Texture texture;
    texture.name = "drawn";
    texture.width = width;
    texture.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            texture.levels.push_back(levelsAt(x, y));
    return texture;
}

[[nodiscard]] constexpr std::uint32_t levels(std::uint32_t red, std::uint32_t green, std::uint32_t blue,
                                             std::uint32_t alpha = 255) {
    return red | green << 8u | blue << 16u | alpha << 24u;
}

/// As addQuad, which has (u, v) from (0, 0) at the corner to (1, 1) at the opposite one. All of the mesh is made so.
inline void addTexturedQuad(TriangleMesh &mesh, const glm::vec3 &corner, const glm::vec3 &a,
                            const glm::vec3 &b) {
    addQuad(mesh, corner, a, b);
    const auto first = static_cast<std::uint32_t>(mesh.uvs.size());
    mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    mesh.triangleUvs.push_back(first + glm::uvec3(0, 1, 2));
    mesh.triangleUvs.push_back(first + glm::uvec3(0, 2, 3));
}

[[nodiscard]] inline TriangleMesh texturedQuad(const glm::vec3 &corner, const glm::vec3 &a,
                                               const glm::vec3 &b, std::uint32_t materialIndex = 0) {
    TriangleMesh mesh;
    mesh.name = "quad";
    mesh.materialIndex = materialIndex;
    addTexturedQuad(mesh, corner, a, b);
    return mesh;
}

/// The red of sRGB levels as light, by the standard's own formula.
[[nodiscard]] inline double lightOf(std::uint32_t level) {
    const double encoded = level / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace hyalite::testing
