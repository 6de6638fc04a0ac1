// Mesh builder: vertices, normals and faces of an OBJ, PLY or STL file become one triangle mesh in world space.
#pragma once

#include "host/import/losses.h"
#include "host/import/obj.h"
#include "host/import/triangulate.h"

#include <glm/mat3x3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace hyalite::core {

/// Removes textures that the mesh cannot use, as it has no texture coordinates, with a warning.
void leaveOutUselessTextures(ObjMesh &loaded);

/// How messages name a place in the file.
enum class PlaceUnit { Line, Byte, Row };

/// "FILE:LINE: ", "FILE: byte OFFSET: ", or "NAME: row INDEX: " of arrays.
[[nodiscard]] std::string placeText(const std::string &file, PlaceUnit unit, std::size_t place);

/// Throws Error{BadInput} with the message behind the place's text.
[[noreturn]] void failAtPlace(const std::string &file, PlaceUnit unit, std::size_t place,
                              std::string_view message);

/// A corner of a face with the indices of the file: from 1, or from -1 backwards; 0 means no normal or no uv.
struct FaceCorner {
    std::int32_t position;
    std::int32_t normal;
    std::int32_t uv;
};

/// Takes statements in the order of the file, at most 2^32 - 1 of each kind. Files may use vertices before they
/// define them: from the first such face on, faces are kept until the end, at 12 bytes per corner and 12 per face.
class MeshBuilder {
  public:
    /// Positions of the mesh are relative to `origin`, in world space.
    MeshBuilder(std::string file, const MeshTransform &transform, const glm::dvec3 &origin,
                PlaceUnit unit = PlaceUnit::Line);

    /// Takes memory for so many vertices and triangles, where a reader knows their number.
    void reserve(std::size_t vertexCount, std::size_t triangleCount);

    /// Adds a vertex. One that is not a finite float, or whose magnitude exceeds 1e15 in any coordinate after the
    /// transform, is kept as lost: no face may use it.
    void addPosition(const glm::dvec3 &positionObject, std::size_t place);

    /// Gives the last vertex a colour, linear, in [0, 1]. Vertices without one are white, if any has one.
    void setColour(const glm::vec3 &colour);

    /// Adds a normal. One that is zero or not finite is kept as lost.
    void addNormal(const glm::dvec3 &normalObject);

    /// Adds texture coordinates. Numbers that are not finite floats count as 0.
    void addUv(const glm::dvec2 &uv);

    [[nodiscard]] std::size_t uvCount() const { return result_.mesh.uvs.size(); }

    /// Sets the material of the following faces: an index from 1, or 0 for none.
    void setMaterial(std::uint32_t index);

    /// Sets the colour of the following faces, linear, in [0, 1]; it counts where vertices have none.
    void setFaceColour(const glm::vec3 &linear);

    [[nodiscard]] MeshReport &report() { return result_.report; }

    /// Faces that are left out; finish() puts them into the report.
    [[nodiscard]] Losses &losses() { return dropped_; }

    /// Adds a face, or leaves it out if it has fewer than three corners. Throws Error{BadInput} if a relative index
    /// points before the first vertex, and where a vertex is lost.
    void addFace(std::span<const FaceCorner> corners, std::size_t place);

    /// Moves the mesh out. Normals and texture coordinates that the file does not define are left out. Throws
    /// Error{BadInput} for indices past the last vertex of the file, for faces with a lost vertex, and if no triangle
    /// is left; not of a far mesh relative to zero (origin.h), whose triangles may be too small there.
    [[nodiscard]] ObjMesh finish();

  private:
    struct Corner {
        std::uint32_t position;
        std::uint32_t normal; ///< or MeshTriangle::noNormal
        std::uint32_t uv;     ///< or TriangleMesh::noUv
    };

    struct Face {
        std::uint32_t place;
        std::uint32_t cornerBegin;
        std::uint32_t material;
        std::uint32_t colour;
    };

    struct LostPosition {
        glm::dvec3 object;
        std::size_t place;
    };

    struct FaceNormals {
        bool all, any; ///< of its corners have a normal
    };

    [[noreturn]] void fail(std::size_t place, std::string_view message) const {
        failAtPlace(result_.mesh.name, unit_, place, message);
    }
    [[nodiscard]] std::uint32_t resolvePosition(std::int32_t index, std::size_t place) const;
    [[nodiscard]] std::uint32_t resolveNormal(std::int32_t index) const;
    [[nodiscard]] bool isDefined(const Corner &corner) const;
    void requirePosition(const Corner &corner, std::size_t place) const;
    [[noreturn]] void failLost(const LostPosition &lost) const;
    void replaceLostPositions();
    void cutFace(std::span<const Corner> corners);
    void addTriangle(const Corner &a, const Corner &b, const Corner &c, FaceNormals normals);
    void addTriangleUvs(glm::uvec3 uvs);
    void addColours();

    PlaceUnit unit_;
    glm::dmat3 rotation_;
    double scale_;
    glm::dvec3 translate_;
    std::uint32_t material_ = 0; ///< of the faces being triangulated
    bool hasMaterials_ = false;
    std::uint32_t faceColour_ = 0;          ///< of the faces being triangulated: in faceColours_
    std::vector<glm::vec4> faceColours_;    ///< empty: faces have none
    std::vector<glm::uvec3> colourCorners_; ///< of triangles, in faceColours_
    std::unordered_map<std::uint32_t, LostPosition> lostPositions_; ///< by the index of the vertex
    Losses dropped_;
    std::vector<Corner> face_; ///< the face being added
    std::vector<Corner> waitingCorners_;
    std::vector<Face> waitingFaces_;
    std::vector<glm::vec3> polygon_; ///< positions of the face being triangulated
    Triangulator triangulator_;
    ObjMesh result_;
};

} // namespace hyalite::core
