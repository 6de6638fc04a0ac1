#include "host/import/gltf/meshes.h"

#include "host/import/tangents.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hyalite::core::gltf {
namespace {

bool isDegenerate(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    return a == b || b == c || c == a || glm::cross(b - a, c - a) == glm::dvec3(0.0);
}

/// Of unit length; 0 for one that has no direction.
glm::vec3 normalised(const glm::vec3 &vector) {
    const glm::dvec3 wide(vector);
    const double length = glm::length(wide);
    return length > 1e-30 ? glm::vec3(wide / length) : glm::vec3(0.0f);
}

std::uint32_t countOf(const auto &values) { return static_cast<std::uint32_t>(values.size()); }

/// Fills up to the mesh's triangles before those of a primitive.
template <class Value>
void fillCorners(std::vector<Value> &corners, std::size_t count, const Value &nothing) {
    if (corners.size() < count)
        corners.resize(count, nothing);
}

/// Adds values, one for each vertex, with the triangles' indices.
template <class Value>
void addCorners(CornerValues<Value> &corners, const std::vector<Value> &values,
                const std::vector<glm::uvec3> &triangles, std::size_t triangleCountBefore) {
    fillCorners(corners.corners, triangleCountBefore, glm::uvec3(CornerValues<Value>::none));
    const std::uint32_t first = countOf(corners.values);
    corners.values.insert(corners.values.end(), values.begin(), values.end());
    for (const glm::uvec3 &triangle : triangles)
        corners.corners.push_back(triangle + first);
}

/// The value of missing texture coordinates: glTF's (0, 0), which is at the top.
constexpr glm::vec2 origin{0.0f, 1.0f};

/// Positions with the triangles' own normals, three corners a triangle: for meshes without normals.
struct FlatCorners {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
};

FlatCorners flatCorners(const Primitive &primitive, const std::vector<glm::vec2> &uvs) {
    FlatCorners flat;
    for (const glm::uvec3 &triangle : primitive.triangles) {
        const auto &positions = primitive.vertices.positions;
        const glm::dvec3 a(positions[triangle.x]);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(positions[triangle.y]) - a, glm::dvec3(positions[triangle.z]) - a);
        flat.triangles.emplace_back(glm::uvec3(0, 1, 2) + countOf(flat.positions));
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            flat.positions.push_back(positions[triangle[corner]]);
            flat.normals.emplace_back(glm::normalize(normal));
            flat.uvs.push_back(uvs[triangle[corner]]);
        }
    }
    return flat;
}

Tangents computedTangents(const Primitive &primitive, const std::vector<glm::vec2> &uvs) {
    if (primitive.vertices.normals.empty()) {
        const FlatCorners flat = flatCorners(primitive, uvs);
        return mikkTangents({flat.positions, flat.normals, flat.uvs, flat.triangles});
    }
    return mikkTangents({primitive.vertices.positions, primitive.vertices.normals, uvs, primitive.triangles});
}

/// Tangents of the file, of unit length; nothing if one has no direction.
std::optional<Tangents> givenTangents(const Primitive &primitive) {
    if (primitive.vertices.tangents.empty())
        return std::nullopt;
    Tangents tangents{{}, primitive.triangles};
    for (const glm::vec4 &tangent : primitive.vertices.tangents) {
        const glm::vec3 direction = normalised(glm::vec3(tangent));
        if (direction == glm::vec3(0.0f))
            return std::nullopt;
        tangents.values.emplace_back(direction, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    return tangents;
}

} // namespace

MaterialNeeds needsOf(const Material &material) {
    MaterialNeeds needs;
    for (const std::optional<TextureUse> &use : material.textures)
        if (use)
            needs.uvs[use->uvSet] = true;
    needs.tangents = material.anisotropy > 0.0f;
    for (const std::uint32_t slot : {layout::slotAnisotropy, layout::slotClearcoatNormal, layout::slotNormal})
        if (const std::optional<TextureUse> &use = material.textures[slot]) {
            needs.tangents = true;
            needs.tangentUvs = use->uvSet;
        }
    return needs;
}

MeshReader::MeshReader(Buffers &buffers, const std::vector<Material> &materials,
                       std::span<const std::uint32_t> shownAs)
    : buffers_(buffers), shownAs_(shownAs) {
    std::ranges::transform(materials, std::back_inserter(needs_), needsOf);
}

TriangleMesh MeshReader::read(std::size_t index, const Deformation &deformation) {
    const JsonObject object(buffers_.document().at("meshes", index));
    TriangleMesh mesh;
    const std::string name = nameOf(object);
    mesh.name = fmt::format("{}#/meshes/{}{}{}", buffers_.document().fileName(), index,
                            name.empty() ? "" : " ", name);
    mesh.origin = deformation.origin;
    Deformation whole = deformation;
    if (const std::optional<JsonNode> weights = object.find("weights"); weights && whole.weights.empty())
        whole.weights = numbersOf(*weights, weights->value->size());
    for (const JsonNode &node : elementsOf(object, "primitives"))
        if (std::optional<Primitive> primitive = readPrimitive(buffers_, node, findings_.passedOver)) {
            deform(buffers_, node, whole, *primitive);
            append(std::move(*primitive), mesh);
        }
    return mesh;
}

void MeshReader::append(Primitive &&primitive, TriangleMesh &mesh) {
    dropDegenerate(primitive);
    if (primitive.triangles.empty())
        return;
    for (glm::vec3 &normal : primitive.vertices.normals)
        normal = normalised(normal);
    const std::uint32_t material = shownAs_[primitive.material.value_or(needs_.size() - 1)];
    const MaterialNeeds &needs = needs_[material];
    // Triangles themselves come last: the others fill up to what is there.
    addUvs(primitive, needs, mesh);
    if (!primitive.vertices.colours.empty())
        addCorners(mesh.colours, primitive.vertices.colours, primitive.triangles, mesh.triangles.size());
    if (needs.tangents)
        addTangents(primitive, needs, mesh);
    addNormals(primitive, mesh);
    mesh.positions.insert(mesh.positions.end(), primitive.vertices.positions.begin(),
                          primitive.vertices.positions.end());
    mesh.triangleMaterials.resize(mesh.triangles.size(), material + 1);
    const glm::uvec3 nothing(TriangleMesh::noUv);
    for (std::vector<glm::uvec3> *corners :
         {&mesh.triangleUvs, &mesh.secondUvs.corners, &mesh.colours.corners, &mesh.tangents.corners})
        if (!corners->empty())
            fillCorners(*corners, mesh.triangles.size(), nothing);
}

void MeshReader::dropDegenerate(Primitive &primitive) {
    const auto &positions = primitive.vertices.positions;
    const std::size_t before = primitive.triangles.size();
    std::erase_if(primitive.triangles, [&](const glm::uvec3 &t) {
        return isDegenerate(glm::dvec3(positions[t.x]), glm::dvec3(positions[t.y]),
                            glm::dvec3(positions[t.z]));
    });
    findings_.degenerateTriangles += before - primitive.triangles.size();
}

/// Adds the triangles, too.
void MeshReader::addNormals(const Primitive &primitive, TriangleMesh &mesh) {
    const std::uint32_t firstPosition = countOf(mesh.positions);
    const std::uint32_t firstNormal = countOf(mesh.normals);
    const std::vector<glm::vec3> &normals = primitive.vertices.normals;
    for (const glm::uvec3 &corners : primitive.triangles) {
        MeshTriangle triangle{corners + firstPosition};
        const auto isLost = [&](std::uint32_t corner) { return normals[corner] == glm::vec3(0.0f); };
        if (!normals.empty() && (isLost(corners.x) || isLost(corners.y) || isLost(corners.z)))
            ++findings_.lostNormals;
        else if (!normals.empty())
            triangle.normals = corners + firstNormal;
        mesh.triangles.push_back(triangle);
    }
    // A normal of length 0 is nobody's.
    for (const glm::vec3 &normal : normals)
        mesh.normals.push_back(normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, 1.0f) : normal);
}

void MeshReader::addUvs(const Primitive &primitive, const MaterialNeeds &needs, TriangleMesh &mesh) {
    const auto uvsOf = [&](std::size_t set) {
        std::vector<glm::vec2> uvs = primitive.vertices.uvs[set];
        if (uvs.empty() && needs.uvs[set]) {
            findings_.uvLess += primitive.triangles.size();
            uvs.assign(primitive.vertices.positions.size(), origin);
        }
        return uvs;
    };
    std::vector<glm::vec2> first = uvsOf(0);
    const std::vector<glm::vec2> second = needs.uvs[1] ? uvsOf(1) : std::vector<glm::vec2>();
    if (first.empty() && !second.empty())
        first.assign(primitive.vertices.positions.size(), origin);
    if (!first.empty()) {
        fillCorners(mesh.triangleUvs, mesh.triangles.size(), glm::uvec3(TriangleMesh::noUv));
        const std::uint32_t before = countOf(mesh.uvs);
        mesh.uvs.insert(mesh.uvs.end(), first.begin(), first.end());
        for (const glm::uvec3 &triangle : primitive.triangles)
            mesh.triangleUvs.push_back(triangle + before);
    }
    if (!second.empty())
        addCorners(mesh.secondUvs, second, primitive.triangles, mesh.triangles.size());
}

void MeshReader::addTangents(const Primitive &primitive, const MaterialNeeds &needs, TriangleMesh &mesh) {
    const std::vector<glm::vec2> &uvs = primitive.vertices.uvs[needs.tangentUvs];
    std::optional<Tangents> tangents = givenTangents(primitive);
    if (!tangents && !uvs.empty())
        tangents = computedTangents(primitive, uvs);
    if (!tangents)
        return;
    fillCorners(mesh.tangents.corners, mesh.triangles.size(), glm::uvec3(CornerValues<glm::vec4>::none));
    const std::uint32_t first = countOf(mesh.tangents.values);
    mesh.tangents.values.insert(mesh.tangents.values.end(), tangents->values.begin(), tangents->values.end());
    for (const glm::uvec3 &corners : tangents->corners)
        mesh.tangents.corners.push_back(corners + first);
}

} // namespace hyalite::core::gltf
