// tinyobjloader as others use it: in float, with nothing around.
#pragma once

#include <cstddef>
#include <filesystem>

namespace hyalite::core::bench {

/// Reads an OBJ file by tinyobj::LoadObj, polygons cut into triangles. Throws Error{BadInput}.
[[nodiscard]] std::size_t countTrianglesByTinyObj(const std::filesystem::path &file);

} // namespace hyalite::core::bench
