// Mesh files: what every reader of meshes takes and gives, whatever the format.
#pragma once

#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hyalite::core {

class FileAccess;
class TextureLibrary;

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

    std::size_t undefinedNormalCount = 0; ///< of these, those with an index past the file's normals

    std::size_t unknownMaterialCount = 0;       ///< `usemtl` with a name that no library of the file has
    std::vector<std::filesystem::path> files{}; ///< the mesh and its libraries
    /// `mtllib` files that are missing or outside the mesh's folder.
    std::vector<std::string> lostLibraries{};
    std::size_t uvLessCount = 0;          ///< triangles without texture coordinates, if others have some
    std::vector<std::string> warnings{};  ///< ignored statements of materials that would be visible
    std::size_t unusedStatementCount = 0; ///< `l`, `p`, unknown keywords: skipped
};

/// Called with the fraction of the file that is read, in [0, 1], about every 4 MiB.
using OnReading = std::function<void(double share)>;

/// How a mesh file is read.
struct MeshOptions {
    MeshTransform transform{};
    const OnReading &onReading;
    TextureLibrary *textures = nullptr; ///< null: materials are not read
    const FileAccess &access;           ///< which other files it may name
};

/// A mesh of a file, and where it is seen.
struct PlacedMesh {
    TriangleMesh mesh;                  ///< relative to its origin (origin.h)
    std::vector<glm::dmat4x3> places{}; ///< each with a volume; none: once, as it is
    std::vector<std::uint32_t>
        nodes{}; ///< of each place, or of the only one, in MeshFile::nodes; none: no node
};

struct MeshFile {
    /// Of meshes, materialIndex and triangleMaterials are indices into `materials`, from 1; 0: no material.
    std::vector<PlacedMesh> meshes{};
    std::vector<Material> materials{}; ///< empty if no triangle has a material
    std::vector<SceneNode> nodes{};    ///< parents before their children
    MeshReport report{};
};

} // namespace hyalite::core
