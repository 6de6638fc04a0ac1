// Wavefront OBJ geometry reader; the only user of tinyobjloader.
#pragma once

#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hyalite {

/// Object space to world space: scale, then rotate about x, y and z in that order, then translate.
struct MeshTransform {
    double scale = 1.0;            ///< not 0
    glm::dvec3 rotateDegrees{0.0}; ///< right-handed, about the fixed axes x, y, z in that order
    glm::dvec3 translate{0.0};
};

/// Findings while reading a mesh, for `hyalite inspect` and for warnings.
struct MeshReport {
    std::string name;              ///< the file
    std::size_t triangleCount = 0; ///< and so on, of the mesh
    std::size_t vertexCount = 0;
    std::size_t normalCount = 0;
    std::size_t instanceCount = 0; ///< 0: the mesh is seen as it is

    std::size_t faceCount = 0;    ///< `f` statements
    std::size_t polygonCount = 0; ///< faces with more than three corners

    /// Triangles that were dropped: two equal corner positions, or exactly no area in double arithmetic.
    std::size_t degenerateTriangleCount = 0;

    /// Triangles that fell back to the geometric normal though a vn was given: one of the three is zero or not
    /// finite, or the face has normals at some of its corners only.
    std::size_t lostNormalCount = 0;

    std::size_t unknownMaterialCount = 0;       ///< `usemtl` with a name that no library of the file has
    std::vector<std::filesystem::path> files{}; ///< the mesh and its libraries
    std::vector<std::string>
        lostLibraries{};                  ///< `mtllib` files that are missing or outside the mesh's folder
    std::size_t uvLessCount = 0;          ///< triangles without texture coordinates, if others have some
    std::vector<std::string> warnings{};  ///< ignored statements of materials that would be visible
    std::size_t unusedStatementCount = 0; ///< `l`, `p`, unknown keywords: skipped
};

/// Called with the fraction of the file that is read, in [0, 1], about every 4 MiB.
using OnReading = std::function<void(double share)>;

struct ObjMesh {
    TriangleMesh mesh; ///< in world space; materialIndex is left 0
    /// Materials of its libraries, if they are read. mesh.triangleMaterials are indices into these, from 1; 0: no
    /// material. Both are empty if no triangle has a material.
    std::vector<Material> materials{};
    MeshReport report;
};

/// Loads all faces of all groups of an OBJ file as one mesh. Faces may be v, v/vt, v//vn or v/vt/vn, with negative
/// indices. Polygons may have up to 65,536 corners and be concave (triangulate.h). A triangle has texture coordinates
/// if the file defines them for all three corners. If `textures` is given, materials are read (mtl.h) from libraries in
/// or below the folder of the mesh. Coordinates are transformed in double and rounded to float once. Normals are
/// transformed with the mesh and normalised; a negative scale turns a mesh inside out, but its winding stays outward.
/// Lines may end in LF, CR or CRLF and continue after a backslash. Lines have at most 16 MiB, the file 4 GiB. Memory
/// stays below 64 MiB + 64 times the size of the file.
///
/// Throws Error{BadInput}, with file and line, if the file is not regular or cannot be read, for indices out of range,
/// numbers that are not finite floats, coordinates beyond 1e15 after the transform, and faces with fewer than three
/// corners; and if there is no triangle at all.
[[nodiscard]] ObjMesh loadObj(const std::filesystem::path &file, const MeshTransform &transform = {},
                              const OnReading &onReading = {}, TextureLibrary *textures = nullptr);

} // namespace hyalite
