// Wavefront OBJ geometry reader; the only user of tinyobjloader.
#pragma once

#include "host/import/mesh_file.h"
#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <filesystem>
#include <vector>

namespace hyalite::core {

struct ObjMesh {
    TriangleMesh mesh; ///< in world space, relative to its origin (origin.h); materialIndex is left 0
    /// Materials of its libraries, if they are read. mesh.triangleMaterials are indices into these, from 1; 0: no
    /// material. Both are empty if no triangle has a material.
    std::vector<Material> materials{};
    MeshReport report;
};

/// Loads all faces of all groups of an OBJ file as one mesh. Faces may be v, v/vt, v//vn or v/vt/vn, with negative
/// indices. A v may have a colour behind it (obj_statement.cpp). Polygons may have up to 65,536 corners and be concave
/// (triangulate.h). A triangle has texture coordinates if the file defines them for all three corners, and the
/// geometric normal if one of its normals is not defined, of which a warning says. If `textures` is given, materials
/// are read (mtl.h) from libraries in or below the folder of the mesh. Coordinates are transformed in double and
/// rounded to float once. Normals are transformed with the mesh and normalised; a negative scale turns a mesh inside
/// out, but its winding stays outward. Lines may end in LF, CR or CRLF and continue after a backslash. Lines have at
/// most 16 MiB, the file 4 GiB. Memory stays below 64 MiB + 64 times the size of the file.
///
/// Throws Error{BadInput}, with file and line, if the file is not regular or cannot be read, for indices out of range,
/// numbers that are not finite floats, coordinates beyond 1e15 after the transform, and faces with fewer than three
/// corners; and if there is no triangle at all.
[[nodiscard]] ObjMesh loadObj(const std::filesystem::path &file, const MeshTransform &transform = {},
                              const OnReading &onReading = {}, TextureLibrary *textures = nullptr);

/// As one mesh of a file.
[[nodiscard]] MeshFile meshFileOf(ObjMesh loaded);

/// The same as one mesh of a file.
[[nodiscard]] MeshFile readObjMeshes(const std::filesystem::path &file, const MeshOptions &options);

} // namespace hyalite::core
