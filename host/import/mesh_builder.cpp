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

namespace hyalite {

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
    return file + (unit == PlaceUnit::Line ? ":" : ": byte ") + std::to_string(place) + ": ";
}

void failAtPlace(const std::string &file, PlaceUnit unit, std::size_t place, std::string_view message) {
    throw Error(ErrorKind::BadInput, placeText(file, unit, place) + std::string(message));
}

MeshBuilder::MeshBuilder(std::string file, const MeshTransform &transform, const glm::dvec3 &origin,
                         PlaceUnit placeUnit)
    : unit(placeUnit), rotation(rotationMatrix(transform.rotateDegrees)), scale(transform.scale),
      translate(transform.translate) {
    assert(transform.scale != 0.0);
    result.mesh.name = std::move(file);
    result.mesh.origin = origin;
}

void MeshBuilder::reserve(std::size_t vertexCount, std::size_t triangleCount) {
    result.mesh.positions.reserve(vertexCount);
    result.mesh.triangles.reserve(triangleCount);
}

void MeshBuilder::addPosition(const glm::dvec3 &positionObject, std::size_t place) {
    const glm::dvec3 world = rotation * (scale * positionObject) + translate;
    if (isWithin(positionObject, maxFloat) && isWithin(world, maxCoordinate)) {
        result.mesh.positions.emplace_back(world - result.mesh.origin);
        return;
    }
    lostPositions.emplace(static_cast<std::uint32_t>(result.mesh.positions.size()),
                          LostPosition{positionObject, place});
    result.mesh.positions.emplace_back(0.0f);
}

void MeshBuilder::failLost(const LostPosition &lost) const {
    if (!isWithin(lost.object, maxFloat))
        fail(lost.place, "vertex " + describe(lost.object) +
                             " is no finite float; allowed are magnitudes up to " + decimal(maxFloat));
    fail(lost.place, "the vertex is at " + describe(rotation * (scale * lost.object) + translate) +
                         " after the transform; allowed are magnitudes up to 1e15");
}

/// Vertices that no face uses must not change where the mesh is.
void MeshBuilder::replaceLostPositions() {
    if (lostPositions.empty())
        return;
    const std::vector<MeshTriangle> &triangles = result.mesh.triangles;
    const glm::vec3 known =
        triangles.empty() ? glm::vec3(0.0f) : result.mesh.positions[triangles.front().positions.x];
    for (const auto &[index, lost] : lostPositions)
        result.mesh.positions[index] = known;
    const auto &first =
        *std::ranges::min_element(lostPositions, {}, [](const auto &lost) { return lost.first; });
    result.report.warnings.push_back(
        fmt::format("{}: {} that no face uses {} no finite place, such as {}", result.mesh.name,
                    countText(lostPositions.size(), "vertex", "vertices"),
                    lostPositions.size() == 1 ? "has" : "have", describe(first.second.object)));
}

void MeshBuilder::setFaceColour(const glm::vec3 &linear) {
    if (faceColours.empty())
        colourCorners.assign(result.mesh.triangles.size(), glm::uvec3(0));
    if (faceColours.empty() || glm::vec3(faceColours.back()) != linear)
        faceColours.emplace_back(linear, 1.0f);
    faceColour = static_cast<std::uint32_t>(faceColours.size() - 1);
}

void MeshBuilder::setColour(const glm::vec3 &colour) {
    std::vector<glm::vec4> &colours = result.mesh.colours.values;
    if (colours.empty()) // most files have none
        colours.reserve(result.mesh.positions.capacity());
    colours.resize(result.mesh.positions.size(), glm::vec4(1.0f));
    colours.back() = glm::vec4(colour, 1.0f);
}

// Of a uniform scale s only the sign remains in the inverse transpose of the transform: (s R)^-T = R / s.
void MeshBuilder::addNormal(const glm::dvec3 &normalObject) {
    const double size = largestMagnitude(normalObject);
    glm::vec3 normal = lostNormal;
    if (size > 0.0 && std::isfinite(normalObject.x + normalObject.y + normalObject.z)) {
        const glm::dvec3 turned = rotation * (normalObject / (scale < 0.0 ? -size : size));
        // In [1, sqrt 3].
        const double length = std::sqrt(turned.x * turned.x + turned.y * turned.y + turned.z * turned.z);
        normal = glm::vec3(turned / length);
    }
    result.mesh.normals.push_back(normal);
}

void MeshBuilder::addUv(const glm::dvec2 &uv) {
    const auto finite = [](double x) {
        return std::abs(x) <= double{std::numeric_limits<float>::max()} ? static_cast<float>(x) : 0.0f;
    };
    result.mesh.uvs.emplace_back(finite(uv.x), finite(uv.y));
}

void MeshBuilder::setMaterial(std::uint32_t index) {
    material = index;
    if (!hasMaterials && index != 0) {
        hasMaterials = true;
        result.mesh.triangleMaterials.assign(result.mesh.triangles.size(), 0);
    }
}

void MeshBuilder::addFace(std::span<const FaceCorner> corners, std::size_t place) {
    if (corners.size() < 3) {
        ++result.report.unusedStatementCount;
        dropped.add("few corners", [&] {
            return placeText(result.mesh.name, unit, place) +
                   "a face with fewer than three corners is left out";
        });
        return;
    }
    ++result.report.faceCount;
    face.clear();
    bool isCuttable = waitingFaces.empty();
    for (const FaceCorner &corner : corners) {
        Corner &added = face.emplace_back(Corner{resolvePosition(corner.position, place),
                                                 resolveNormal(corner.normal), TriangleMesh::noUv});
        if (corner.uv > 0)
            added.uv = static_cast<std::uint32_t>(corner.uv) - 1;
        else if (const auto back = static_cast<std::size_t>(-std::int64_t{corner.uv});
                 back > 0 && back <= result.mesh.uvs.size())
            added.uv = static_cast<std::uint32_t>(result.mesh.uvs.size() - back);
        isCuttable = isCuttable && isDefined(added);
    }
    if (isCuttable) {
        cutFace(face);
        return;
    }
    waitingFaces.push_back({static_cast<std::uint32_t>(place),
                            static_cast<std::uint32_t>(waitingCorners.size()), material, faceColour});
    waitingCorners.insert(waitingCorners.end(), face.begin(), face.end());
}

std::uint32_t MeshBuilder::resolvePosition(std::int32_t index, std::size_t place) const {
    if (index > 0)
        return static_cast<std::uint32_t>(index) - 1;
    const std::size_t count = result.mesh.positions.size();
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
        index > 0 ? std::int64_t{index} - 1 : static_cast<std::int64_t>(result.mesh.normals.size()) + index;
    return fromStart < 0 ? undefinedNormal : static_cast<std::uint32_t>(fromStart);
}

/// Whether all that the corner names is known already.
bool MeshBuilder::isDefined(const Corner &corner) const {
    return corner.position < result.mesh.positions.size() &&
           (corner.normal == MeshTriangle::noNormal || corner.normal == undefinedNormal ||
            corner.normal < result.mesh.normals.size()) &&
           (corner.uv == TriangleMesh::noUv || corner.uv < result.mesh.uvs.size());
}

void MeshBuilder::requirePosition(const Corner &corner, std::size_t place) const {
    if (corner.position >= result.mesh.positions.size())
        fail(place, "the face has the vertex index " + std::to_string(corner.position + 1) +
                        "; the file has " + std::to_string(result.mesh.positions.size()));
}

void MeshBuilder::cutFace(std::span<const Corner> corners) {
    if (!lostPositions.empty())
        for (const Corner &corner : corners)
            if (const auto lost = lostPositions.find(corner.position); lost != lostPositions.end())
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
    ++result.report.polygonCount;
    polygon.clear();
    for (const Corner &corner : corners)
        polygon.push_back(result.mesh.positions[corner.position]);
    for (const glm::uvec3 &part : triangulator.triangulate(polygon))
        addTriangle(corners[part.x], corners[part.y], corners[part.z], normals);
}

void MeshBuilder::addTriangle(const Corner &a, const Corner &b, const Corner &c, FaceNormals normals) {
    const std::vector<glm::vec3> &at = result.mesh.positions;
    if (isDegenerate(at[a.position], at[b.position], at[c.position])) {
        ++result.report.degenerateTriangleCount;
        return;
    }
    MeshTriangle triangle{{a.position, b.position, c.position}, glm::uvec3(MeshTriangle::noNormal)};
    if (normals.all)
        triangle.normals = {a.normal, b.normal, c.normal};
    bool isLost = normals.any && !normals.all;
    bool isUndefined = false;
    for (const std::uint32_t normal : {a.normal, b.normal, c.normal}) {
        isUndefined =
            isUndefined || (normal != MeshTriangle::noNormal && normal >= result.mesh.normals.size());
        isLost = isLost || (normal < result.mesh.normals.size() && result.mesh.normals[normal] == lostNormal);
    }
    result.report.undefinedNormalCount += isUndefined;
    isLost = isLost || isUndefined;
    if (isLost) {
        triangle.normals = glm::uvec3(MeshTriangle::noNormal);
        ++result.report.lostNormalCount;
    }
    glm::uvec3 uvs(a.uv, b.uv, c.uv);
    if (scale < 0.0) { // the mesh is turned inside out: turn the winding back
        std::swap(triangle.positions.y, triangle.positions.z);
        std::swap(triangle.normals.y, triangle.normals.z);
        std::swap(uvs.y, uvs.z);
    }
    addTriangleUvs(uvs);
    result.mesh.triangles.push_back(triangle);
    if (hasMaterials)
        result.mesh.triangleMaterials.push_back(material);
    if (!faceColours.empty())
        colourCorners.emplace_back(faceColour);
}

void MeshBuilder::addTriangleUvs(glm::uvec3 uvs) {
    const bool hasAll =
        uvs.x < result.mesh.uvs.size() && uvs.y < result.mesh.uvs.size() && uvs.z < result.mesh.uvs.size();
    if (hasAll && result.mesh.triangleUvs.empty())
        result.mesh.triangleUvs.assign(result.mesh.triangles.size(), glm::uvec3(TriangleMesh::noUv));
    result.report.uvLessCount += hasAll ? 0 : 1;
    if (hasAll || !result.mesh.triangleUvs.empty())
        result.mesh.triangleUvs.push_back(hasAll ? uvs : glm::uvec3(TriangleMesh::noUv));
}

void MeshBuilder::addColours() {
    CornerValues<glm::vec4> &colours = result.mesh.colours;
    if (colours.values.empty()) {
        colours = {std::move(faceColours), std::move(colourCorners)};
        return;
    }
    if (!faceColours.empty())
        dropped.add("colours of faces", [&] {
            return result.mesh.name + ": colours of faces are left out, as vertices have some, too";
        });
    colours.values.resize(result.mesh.positions.size(), glm::vec4(1.0f));
    colours.corners.reserve(result.mesh.triangles.size());
    for (const MeshTriangle &triangle : result.mesh.triangles)
        colours.corners.push_back(triangle.positions);
}

ObjMesh MeshBuilder::finish() {
    MeshReport &report = result.report;
    for (std::size_t i = 0; i < waitingFaces.size(); ++i) {
        const std::size_t begin = waitingFaces[i].cornerBegin;
        const std::size_t end =
            i + 1 < waitingFaces.size() ? waitingFaces[i + 1].cornerBegin : waitingCorners.size();
        const std::span<const Corner> corners(waitingCorners.data() + begin, end - begin);
        for (const Corner &corner : corners)
            requirePosition(corner, waitingFaces[i].place);
        material = waitingFaces[i].material;
        faceColour = waitingFaces[i].colour;
        cutFace(corners);
    }
    const auto mayBeTooSmall = [this] {
        return result.mesh.origin == glm::dvec3(0.0) && originOf(result.mesh) != glm::dvec3(0.0);
    };
    if (result.mesh.triangles.empty() && !mayBeTooSmall())
        throw Error(ErrorKind::BadInput, result.mesh.name + ": no triangle in " +
                                             std::to_string(report.faceCount) + " faces (" +
                                             std::to_string(report.degenerateTriangleCount) +
                                             " dropped for having no area); at least one is needed" +
                                             (report.faceCount == 0 && !result.mesh.positions.empty()
                                                  ? ": points and lines alone are no surface"
                                                  : ""));
    replaceLostPositions();
    addColours();
    std::ranges::move(dropped.warnings(), std::back_inserter(report.warnings));
    // No triangle uses a lost normal, but its place must hold a unit vector.
    std::replace(result.mesh.normals.begin(), result.mesh.normals.end(), lostNormal,
                 glm::vec3(0.0f, 0.0f, 1.0f));
    report.name = result.mesh.name;
    report.triangleCount = result.mesh.triangles.size();
    report.vertexCount = result.mesh.positions.size();
    report.normalCount = result.mesh.normals.size();
    return std::move(result);
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

} // namespace hyalite
