// OBJ mesh builder: vertices, normals and faces of a file become one triangle mesh in world space.
#pragma once

#include "host/import/obj.h"
#include "host/import/triangulate.h"

#include <glm/mat3x3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hyalite {

/// A corner of a face as the file has it: from 1, or from -1 backwards; a normal or a uv of 0 is none.
struct ObjCorner {
    std::int32_t position;
    std::int32_t normal;
    std::int32_t uv;
};

/// Fed in the order of the file, at most 2^32 - 1 of each thing. OBJ files may name vertices before they define them:
/// from the first face that does, faces wait until the end, as 12 bytes a corner and 12 a face.
class ObjMeshBuilder {
  public:
    ObjMeshBuilder(std::string file, const MeshTransform &transform);

    /// Takes a `v` of line `line`. Throws Error{BadInput} where it is no finite float, or further than 1e15
    /// from a coordinate plane after the transform.
    void addPosition(const glm::dvec3 &positionObject, std::size_t line);

    /// Takes a `vn`; one that is zero or not finite is kept as lost.
    void addNormal(const glm::dvec3 &normalObject);

    /// Takes a `vt`; what is no finite float counts as 0.
    void addUv(const glm::dvec2 &uv);

    /// Of the faces that follow: an index from 1 on, or 0 for none.
    void setMaterial(std::uint32_t index);

    [[nodiscard]] MeshReport &report() { return result.report; }

    /// Takes an `f` of three corners or more. Throws Error{BadInput} where a relative index leads before the first
    /// vertex or normal.
    void addFace(std::span<const ObjCorner> corners, std::size_t line);

    /// Gives the mesh away; texture coordinates that the file does not have are left out. Throws Error{BadInput} for
    /// indices past the end of the file's vertices or normals, and when no triangle is left.
    [[nodiscard]] ObjMesh finish();

  private:
    struct Corner {
        std::uint32_t position;
        std::uint32_t normal; ///< or MeshTriangle::noNormal
        std::uint32_t uv;     ///< or TriangleMesh::noUv
    };

    struct Face {
        std::uint32_t line;
        std::uint32_t cornerBegin;
        std::uint32_t material;
    };

    struct FaceNormals {
        bool all, any; ///< of its corners have a normal
    };

    [[nodiscard]] std::uint32_t resolve(std::int32_t index, std::size_t count, const char *what,
                                        std::size_t line) const;
    [[nodiscard]] bool isDefined(const Corner &corner) const;
    void requireDefined(const Corner &corner, std::size_t line) const;
    void cutFace(std::span<const Corner> corners);
    void addTriangle(const Corner &a, const Corner &b, const Corner &c, FaceNormals normals);
    void addTriangleUvs(glm::uvec3 uvs);

    glm::dmat3 rotation;
    double scale;
    glm::dvec3 translate;
    std::uint32_t material = 0; ///< of the faces that are being cut
    bool hasMaterials = false;
    std::vector<Corner> face; ///< the one that is being added
    std::vector<Corner> waitingCorners;
    std::vector<Face> waitingFaces;
    std::vector<glm::vec3> polygon; ///< the positions of the face that is being cut
    Triangulator triangulator;
    ObjMesh result;
};

} // namespace hyalite
