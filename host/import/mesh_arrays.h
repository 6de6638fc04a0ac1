// Meshes of arrays: what a reader makes of a file, made of memory.
#pragma once

#include "host/import/mesh_file.h"
#include "host/import/scene_document.h"

#include <string>

namespace hyalite::core {

/// Reads the arrays as a mesh file without materials: faces of more than three corners are cut (triangulate.h), those
/// without area are left out, and coordinates far away keep their doubles until the mesh is moved (origin.h). Throws
/// Error{BadInput} "NAME: row 7: ..." for indices past the last vertex, vertices of faces that are not finite floats,
/// places without a volume, and if no triangle is left.
[[nodiscard]] MeshFile readMeshArrays(const std::string &name, const MeshArrays &arrays,
                                      const MeshTransform &transform);

} // namespace hyalite::core
