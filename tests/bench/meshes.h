// The meshes that are traced.
#pragma once

#include "host/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core::bench {

/// "cat_4k" and so on, from small to large.
[[nodiscard]] const std::vector<std::string> &meshNames();

/// The OBJ file of a cat. Throws Error{Usage} for a mesh that comes from no file.
[[nodiscard]] std::filesystem::path meshFile(const std::string &name);

/// Throws Error{Usage} for an unknown name, and as loadObj does.
[[nodiscard]] TriangleMesh loadMesh(const std::string &name);

/// A sphere of radius 1 with smooth bumps and rough noise on each vertex, closed except for pinholes at its poles, and
/// of 2 * around * (down - 1) triangles.
[[nodiscard]] TriangleMesh noisySphere(int around, int down);

} // namespace hyalite::core::bench
