#include "host/import/mesh_builder.h"

#include "host/base/error.h"
#include "host/base/quantities.h"
#include "host/scene/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace hyalite::core {

namespace {

constexpr double maxCoordinate = 1e15;
constexpr glm::vec3 lostNormal(0.0f);
constexpr std::uint32_t undefinedNormal = MeshTriangle::noNormal - 1; ///< a normal before the first one

struct SinCos {
    double sine, cosine;
};

// Exact for multiples of 90 degrees, so that these rotations keep the bits of the coordinates.
SinCos sinCosDegrees(double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    if (turn == 0.0)
        return {0.0, 1.0};
    if (std::abs(turn) == 90.0)
        return {turn / 90.0, 0.0};
    if (std::abs(turn) == 180.0)
        return {0.0, -1.0};
    const double radians = turn * (std::numbers::pi / 180.0);
    return {std::sin(radians), std::cos(radians)};
}

// Rz Ry Rx: x turns first.
glm::dmat3 rotationMatrix(const glm::dvec3 &degrees) {
    const auto [sx, cx] = sinCosDegrees(degrees.x);
    const auto [sy, cy] = sinCosDegrees(degrees.y);
    const auto [sz, cz] = sinCosDegrees(degrees.z);
    const glm::dmat3 aboutX(1.0, 0.0, 0.0, 0.0, cx, sx, 0.0, -sx, cx); // column-major
    const glm::dmat3 aboutY(cy, 0.0, -sy, 0.0, 1.0, 0.0, sy, 0.0, cy);
    const glm::dmat3 aboutZ(cz, sz, 0.0, -sz, cz, 0.0, 0.0, 0.0, 1.0);
    return aboutZ * aboutY * aboutX;
}

constexpr double maxFloat = std::numeric_limits<float>::max();

// Written so that a NaN is not.
bool isWithin(const glm::dvec3 &v, double limit) {
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

double largestMagnitude(const glm::dvec3 &v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Shorter than std::to_string, and independent of the locale.
std::string decimal(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9).ptr};
}

std::string describe(const glm::dvec3 &v) {
    return "(" + decimal(v.x) + ", " + decimal(v.y) + ", " + decimal(v.z) + ")";
}

// Two equal corners, or corners on one line as far as double arithmetic can tell.
bool isDegenerate(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    const glm::dvec3 u = b - a;
    const glm::dvec3 v = c - a;
    return u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z && u.x * v.y == u.y * v.x;
}

} // namespace

std::string placeText(const std::string &file, PlaceUnit unit, std::size_t place) {
    const char *word = unit == PlaceUnit::Line ? ":" : unit == PlaceUnit::Byte ? ": byte " : ": row ";
    return file + word + std::to_string(place) + ": ";
}

void failAtPlace(const std::string &file, PlaceUnit unit, std::size_t place, std::string_view message) {
    throw Error(ErrorKind::BadInput, placeText(file, unit, place) + std::string(message));
}

MeshBuilder::MeshBuilder(std::string file, const MeshTransform &transform, const glm::dvec3 &origin,
                         PlaceUnit unit)
    : unit_(unit), rotation_(rotationMatrix(transform.rotateDegrees)), scale_(transform.scale),
      translate_(transform.translate) {
    assert(transform.scale != 0.0);
    result_.mesh.name = std::move(file);
    result_.mesh.origin = origin;
}

void MeshBuilder::reserve(std::size_t vertexCount, std::size_t triangleCount) {
    result_.mesh.positions.reserve(vertexCount);
    result_.mesh.triangles.reserve(triangleCount);
}

void MeshBuilder::addPosition(const glm::dvec3 &positionObject, std::size_t place) {
    const glm::dvec3 world = rotation_ * (scale_ * positionObject) + translate_;
    if (isWithin(positionObject, maxFloat) && isWithin(world, maxCoordinate)) {
        result_.mesh.positions.emplace_back(world - result_.mesh.origin);
        return;
    }
    lostPositions_.emplace(static_cast<std::uint32_t>(result_.mesh.positions.size()),
                           LostPosition{positionObject, place});
    result_.mesh.positions.emplace_back(0.0f);
}

void MeshBuilder::failLost(const LostPosition &lost) const {
    if (!isWithin(lost.object, maxFloat))
        fail(lost.place, "vertex " + describe(lost.object) +
                             " is no finite float; allowed are magnitudes up to " + decimal(maxFloat));
    fail(lost.place, "the vertex is at " + describe(rotation_ * (scale_ * lost.object) + translate_) +
                         " after the transform; allowed are magnitudes up to 1e15");
}

/// Vertices that no face uses must not change where the mesh is.
void MeshBuilder::replaceLostPositions() {
    if (lostPositions_.empty())
        return;
    const std::vector<MeshTriangle> &triangles = result_.mesh.triangles;
    const glm::vec3 known =
        triangles.empty() ? glm::vec3(0.0f) : result_.mesh.positions[triangles.front().positions.x];
    for (const auto &[index, lost] : lostPositions_)
        result_.mesh.positions[index] = known;
    const auto &first =
        *std::ranges::min_element(lostPositions_, {}, [](const auto &lost) { return lost.first; });
    result_.report.warnings.push_back(
        fmt::format("{}: {} that no face uses {} no finite place, such as {}", result_.mesh.name,
                    countText(lostPositions_.size(), "vertex", "vertices"),
                    lostPositions_.size() == 1 ? "has" : "have", describe(first.second.object)));
}

void MeshBuilder::setFaceColour(const glm::vec3 &linear) {
    if (faceColours_.empty())
        colourCorners_.assign(result_.mesh.triangles.size(), glm::uvec3(0));
    if (faceColours_.empty() || glm::vec3(faceColours_.back()) != linear)
        faceColours_.emplace_back(linear, 1.0f);
    faceColour_ = static_cast<std::uint32_t>(faceColours_.size() - 1);
}

void MeshBuilder::setColour(const glm::vec3 &colour) {
    std::vector<glm::vec4> &colours = result_.mesh.colours.values;
    if (colours.empty()) // most files have none
        colours.reserve(result_.mesh.positions.capacity());
    colours.resize(result_.mesh.positions.size(), glm::vec4(1.0f));
    colours.back() = glm::vec4(colour, 1.0f);
}

// Of a uniform scale s only the sign remains in the inverse transpose of the transform: (s R)^-T = R / s.
void MeshBuilder::addNormal(const glm::dvec3 &normalObject) {
    const double size = largestMagnitude(normalObject);
    glm::vec3 normal = lostNormal;
    if (size > 0.0 && std::isfinite(normalObject.x + normalObject.y + normalObject.z)) {
        const glm::dvec3 turned = rotation_ * (normalObject / (scale_ < 0.0 ? -size : size));
        // In [1, sqrt 3].
        const double length = std::sqrt(turned.x * turned.x + turned.y * turned.y + turned.z * turned.z);
        normal = glm::vec3(turned / length);
    }
    result_.mesh.normals.push_back(normal);
}

void MeshBuilder::addUv(const glm::dvec2 &uv) {
    const auto finite = [](double x) {
        return std::abs(x) <= double{std::numeric_limits<float>::max()} ? static_cast<float>(x) : 0.0f;
    };
    result_.mesh.uvs.emplace_back(finite(uv.x), finite(uv.y));
}

void MeshBuilder::setMaterial(std::uint32_t index) {
    material_ = index;
    if (!hasMaterials_ && index != 0) {
        hasMaterials_ = true;
        result_.mesh.triangleMaterials.assign(result_.mesh.triangles.size(), 0);
    }
}

void MeshBuilder::addFace(std::span<const FaceCorner> corners, std::size_t place) {
    if (corners.size() < 3) {
        ++result_.report.unusedStatementCount;
        dropped_.add("few corners", [&] {
            return placeText(result_.mesh.name, unit_, place) +
                   "a face with fewer than three corners is left out";
        });
        return;
    }
    ++result_.report.faceCount;
    face_.clear();
    bool isCuttable = waitingFaces_.empty();
    for (const FaceCorner &corner : corners) {
        Corner &added = face_.emplace_back(Corner{resolvePosition(corner.position, place),
                                                  resolveNormal(corner.normal), TriangleMesh::noUv});
        if (corner.uv > 0)
            added.uv = static_cast<std::uint32_t>(corner.uv) - 1;
        else if (const auto back = static_cast<std::size_t>(-std::int64_t{corner.uv});
                 back > 0 && back <= result_.mesh.uvs.size())
            added.uv = static_cast<std::uint32_t>(result_.mesh.uvs.size() - back);
        isCuttable = isCuttable && isDefined(added);
    }
    if (isCuttable) {
        cutFace(face_);
        return;
    }
    waitingFaces_.push_back({static_cast<std::uint32_t>(place),
                             static_cast<std::uint32_t>(waitingCorners_.size()), material_, faceColour_});
    waitingCorners_.insert(waitingCorners_.end(), face_.begin(), face_.end());
}

std::uint32_t MeshBuilder::resolvePosition(std::int32_t index, std::size_t place) const {
    if (index > 0)
        return static_cast<std::uint32_t>(index) - 1;
    const std::size_t count = result_.mesh.positions.size();
    const std::int64_t fromStart = static_cast<std::int64_t>(count) + index;
    if (index == 0 || fromStart < 0)
        fail(place, "the face has the vertex index " + std::to_string(index) + "; " + std::to_string(count) +
                        " are defined before it");
    return static_cast<std::uint32_t>(fromStart);
}

std::uint32_t MeshBuilder::resolveNormal(std::int32_t index) const {
    if (index == 0)
        return MeshTriangle::noNormal;
    const std::int64_t fromStart =
        index > 0 ? std::int64_t{index} - 1 : static_cast<std::int64_t>(result_.mesh.normals.size()) + index;
    return fromStart < 0 ? undefinedNormal : static_cast<std::uint32_t>(fromStart);
}

/// Whether all that the corner names is known already.
bool MeshBuilder::isDefined(const Corner &corner) const {
    return corner.position < result_.mesh.positions.size() &&
           (corner.normal == MeshTriangle::noNormal || corner.normal == undefinedNormal ||
            corner.normal < result_.mesh.normals.size()) &&
           (corner.uv == TriangleMesh::noUv || corner.uv < result_.mesh.uvs.size());
}

void MeshBuilder::requirePosition(const Corner &corner, std::size_t place) const {
    if (corner.position >= result_.mesh.positions.size())
        fail(place, "the face has the vertex index " + std::to_string(corner.position + 1) +
                        "; the file has " + std::to_string(result_.mesh.positions.size()));
}

void MeshBuilder::cutFace(std::span<const Corner> corners) {
    if (!lostPositions_.empty())
        for (const Corner &corner : corners)
            if (const auto lost = lostPositions_.find(corner.position); lost != lostPositions_.end())
                failLost(lost->second);
    FaceNormals normals{true, false};
    for (const Corner &corner : corners) {
        const bool hasNormal = corner.normal != MeshTriangle::noNormal;
        normals.all = normals.all && hasNormal;
        normals.any = normals.any || hasNormal;
    }
    if (corners.size() == 3) {
        addTriangle(corners[0], corners[1], corners[2], normals);
        return;
    }
    ++result_.report.polygonCount;
    polygon_.clear();
    for (const Corner &corner : corners)
        polygon_.push_back(result_.mesh.positions[corner.position]);
    for (const glm::uvec3 &part : triangulator_.triangulate(polygon_))
        addTriangle(corners[part.x], corners[part.y], corners[part.z], normals);
}

void MeshBuilder::addTriangle(const Corner &a, const Corner &b, const Corner &c, FaceNormals normals) {
    const std::vector<glm::vec3> &at = result_.mesh.positions;
    if (isDegenerate(at[a.position], at[b.position], at[c.position])) {
        ++result_.report.degenerateTriangleCount;
        return;
    }
    MeshTriangle triangle{{a.position, b.position, c.position}, glm::uvec3(MeshTriangle::noNormal)};
    if (normals.all)
        triangle.normals = {a.normal, b.normal, c.normal};
    bool isLost = normals.any && !normals.all;
    bool isUndefined = false;
    for (const std::uint32_t normal : {a.normal, b.normal, c.normal}) {
        isUndefined =
            isUndefined || (normal != MeshTriangle::noNormal && normal >= result_.mesh.normals.size());
        isLost =
            isLost || (normal < result_.mesh.normals.size() && result_.mesh.normals[normal] == lostNormal);
    }
    result_.report.undefinedNormalCount += isUndefined;
    isLost = isLost || isUndefined;
    if (isLost) {
        triangle.normals = glm::uvec3(MeshTriangle::noNormal);
        ++result_.report.lostNormalCount;
    }
    glm::uvec3 uvs(a.uv, b.uv, c.uv);
    if (scale_ < 0.0) { // the mesh is turned inside out: turn the winding back
        std::swap(triangle.positions.y, triangle.positions.z);
        std::swap(triangle.normals.y, triangle.normals.z);
        std::swap(uvs.y, uvs.z);
    }
    addTriangleUvs(uvs);
    result_.mesh.triangles.push_back(triangle);
    if (hasMaterials_)
        result_.mesh.triangleMaterials.push_back(material_);
    if (!faceColours_.empty())
        colourCorners_.emplace_back(faceColour_);
}

void MeshBuilder::addTriangleUvs(glm::uvec3 uvs) {
    const bool hasAll =
        uvs.x < result_.mesh.uvs.size() && uvs.y < result_.mesh.uvs.size() && uvs.z < result_.mesh.uvs.size();
    if (hasAll && result_.mesh.triangleUvs.empty())
        result_.mesh.triangleUvs.assign(result_.mesh.triangles.size(), glm::uvec3(TriangleMesh::noUv));
    result_.report.uvLessCount += hasAll ? 0 : 1;
    if (hasAll || !result_.mesh.triangleUvs.empty())
        result_.mesh.triangleUvs.push_back(hasAll ? uvs : glm::uvec3(TriangleMesh::noUv));
}

void MeshBuilder::addColours() {
    CornerValues<glm::vec4> &colours = result_.mesh.colours;
    if (colours.values.empty()) {
        colours = {std::move(faceColours_), std::move(colourCorners_)};
        return;
    }
    if (!faceColours_.empty())
        dropped_.add("colours of faces", [&] {
            return result_.mesh.name + ": colours of faces are left out, as vertices have some, too";
        });
    colours.values.resize(result_.mesh.positions.size(), glm::vec4(1.0f));
    colours.corners.reserve(result_.mesh.triangles.size());
    for (const MeshTriangle &triangle : result_.mesh.triangles)
        colours.corners.push_back(triangle.positions);
}

ObjMesh MeshBuilder::finish() {
    MeshReport &report = result_.report;
    for (std::size_t i = 0; i < waitingFaces_.size(); ++i) {
        const std::size_t begin = waitingFaces_[i].cornerBegin;
        const std::size_t end =
            i + 1 < waitingFaces_.size() ? waitingFaces_[i + 1].cornerBegin : waitingCorners_.size();
        const std::span<const Corner> corners(waitingCorners_.data() + begin, end - begin);
        for (const Corner &corner : corners)
            requirePosition(corner, waitingFaces_[i].place);
        material_ = waitingFaces_[i].material;
        faceColour_ = waitingFaces_[i].colour;
        cutFace(corners);
    }
    const auto mayBeTooSmall = [this] {
        return result_.mesh.origin == glm::dvec3(0.0) && originOf(result_.mesh) != glm::dvec3(0.0);
    };
    if (result_.mesh.triangles.empty() && !mayBeTooSmall())
        throw Error(ErrorKind::BadInput, result_.mesh.name + ": no triangle in " +
                                             std::to_string(report.faceCount) + " faces (" +
                                             std::to_string(report.degenerateTriangleCount) +
                                             " dropped for having no area); at least one is needed" +
                                             (report.faceCount == 0 && !result_.mesh.positions.empty()
                                                  ? ": points and lines alone are no surface"
                                                  : ""));
    replaceLostPositions();
    addColours();
    std::ranges::move(dropped_.warnings(), std::back_inserter(report.warnings));
    // No triangle uses a lost normal, but its place must hold a unit vector.
    std::replace(result_.mesh.normals.begin(), result_.mesh.normals.end(), lostNormal,
                 glm::vec3(0.0f, 0.0f, 1.0f));
    report.name = result_.mesh.name;
    report.triangleCount = result_.mesh.triangles.size();
    report.vertexCount = result_.mesh.positions.size();
    report.normalCount = result_.mesh.normals.size();
    return std::move(result_);
}

void leaveOutUselessTextures(ObjMesh &loaded) {
    const auto hasTextures = [](const Material &material) {
        return std::ranges::any_of(material.textures, [](const auto &use) { return use.has_value(); });
    };
    if (std::ranges::none_of(loaded.materials, hasTextures))
        return;
    if (loaded.mesh.triangleUvs.empty()) {
        for (Material &material : loaded.materials)
            material.textures = {};
        loaded.report.warnings.push_back(loaded.mesh.name +
                                         ": its textures are ignored, as it has no texture coordinates");
        return;
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < loaded.mesh.triangleMaterials.size(); ++i) {
        const std::uint32_t material = loaded.mesh.triangleMaterials[i]; // 0: none
        count += loaded.mesh.triangleUvs[i].x == TriangleMesh::noUv && material > 0 &&
                 hasTextures(loaded.materials[material - 1]);
    }
    if (count > 0)
        loaded.report.warnings.push_back(
            fmt::format("{}: {} triangles have no texture coordinates that their "
                        "material wants; textures show their bottom left corner "
                        "there",
                        loaded.mesh.name, count));
}

} // namespace hyalite::core
