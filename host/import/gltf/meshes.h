// Meshes of a glTF file: all triangles of a mesh's primitives as one mesh of the scene.
#pragma once

#include "host/import/gltf/deform.h"
#include "host/import/gltf/primitive.h"
#include "host/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

/// Vertex attributes that a material needs of its meshes.
struct MaterialNeeds {
    bool uvs[2] = {false, false}; ///< sets of texture coordinates
    bool tangents = false;
    std::size_t tangentUvs = 0; ///< the set that tangents follow
};

[[nodiscard]] MaterialNeeds needsOf(const Material &material);

/// Findings while meshes are read.
struct MeshFindings {
    PassedOver passedOver;
    std::size_t degenerateTriangles = 0; ///< without area: dropped
    std::size_t lostNormals = 0;         ///< triangles with a normal of length 0: they get the geometric one
    std::size_t uvLess = 0;              ///< triangles without texture coordinates that their material wants
};

class MeshReader {
  public:
    /// `materials` are those of the file in its order, and one more for primitives without any; `shownAs`: see Materials.
    /// All outlive the object.
    MeshReader(Buffers &buffers, const std::vector<Material> &materials,
               std::span<const std::uint32_t> shownAs);

    /// A mesh of /meshes. Indices of materials count from 1. Where the deformation has a skin, the mesh is in world
    /// space. It may have no triangle.
    [[nodiscard]] TriangleMesh read(std::size_t index, const Deformation &deformation);

    [[nodiscard]] const MeshFindings &findings() const { return findings_; }

  private:
    void append(Primitive &&primitive, TriangleMesh &mesh);
    void dropDegenerate(Primitive &primitive);
    void addNormals(const Primitive &primitive, TriangleMesh &mesh);
    void addUvs(const Primitive &primitive, const MaterialNeeds &needs, TriangleMesh &mesh);
    static void addTangents(const Primitive &primitive, const MaterialNeeds &needs, TriangleMesh &mesh);

    Buffers &buffers_;
    std::span<const std::uint32_t> shownAs_;
    std::vector<MaterialNeeds> needs_;
    MeshFindings findings_;
};

} // namespace hyalite::core::gltf
