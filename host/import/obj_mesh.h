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

/// A corner of a face with the indices of the file: from 1, or from -1 backwards; 0 means no normal or no uv.
struct ObjCorner {
    std::int32_t position;
    std::int32_t normal;
    std::int32_t uv;
};

/// Takes statements in the order of the file, at most 2^32 - 1 of each kind. OBJ files may use vertices before they
/// define them: from the first such face on, faces are kept until the end, at 12 bytes per corner and 12 per face.
class ObjMeshBuilder {
  public:
    ObjMeshBuilder(std::string file, const MeshTransform &transform);

    /// Adds the `v` of line `line`. Throws Error{BadInput} if it is not a finite float, or if its magnitude exceeds
    /// 1e15 in any coordinate after the transform.
    void addPosition(const glm::dvec3 &positionObject, std::size_t line);

    /// Adds a `vn`. One that is zero or not finite is kept as lost.
    void addNormal(const glm::dvec3 &normalObject);

    /// Adds a `vt`. Numbers that are not finite floats count as 0.
    void addUv(const glm::dvec2 &uv);

    /// Sets the material of the following faces: an index from 1, or 0 for none.
    void setMaterial(std::uint32_t index);

    [[nodiscard]] MeshReport &report() { return result.report; }

    /// Adds an `f` of three corners or more. Throws Error{BadInput} if a relative index points before the first vertex
    /// or normal.
    void addFace(std::span<const ObjCorner> corners, std::size_t line);

    /// Moves the mesh out. Texture coordinates that the file does not define are left out. Throws Error{BadInput} for
    /// indices past the last vertex or normal of the file, and if no triangle is left.
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
    std::uint32_t material = 0; ///< of the faces being triangulated
    bool hasMaterials = false;
    std::vector<Corner> face; ///< the face being added
    std::vector<Corner> waitingCorners;
    std::vector<Face> waitingFaces;
    std::vector<glm::vec3> polygon; ///< positions of the face being triangulated
    Triangulator triangulator;
    ObjMesh result;
};

} // namespace hyalite
