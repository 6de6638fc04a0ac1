#include "host/import/gltf/primitive.h"

#include "host/import/gltf/draco.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace hyalite::core::gltf {
namespace {

enum class Mode { Points = 0, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

/// Of primitives and of instances.
bool isRead(std::string_view attribute) {
    constexpr std::string_view names[] = {"POSITION", "NORMAL",      "TANGENT",  "TEXCOORD_0", "TEXCOORD_1",
                                          "COLOR_0",  "TRANSLATION", "ROTATION", "SCALE"};
    return std::ranges::find(names, attribute) != std::end(names) || attribute.starts_with("JOINTS_") ||
           attribute.starts_with("WEIGHTS_");
}

const Accessor *find(const Attributes &attributes, std::string_view name) {
    const auto attribute = attributes.find(name);
    return attribute == attributes.end() ? nullptr : &attribute->second;
}

/// The vertices of the primitive in their order.
std::vector<std::uint32_t> readIndices(Buffers &buffers, const JsonObject &object, std::size_t vertexCount) {
    const auto index = buffers.document().reference(object, "indices", "accessors");
    std::vector<std::uint32_t> indices;
    if (!index) {
        buffers.memoryBudget().take(vertexCount * sizeof(std::uint32_t), object.at("attributes"));
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    const Accessor accessor(buffers, *index);
    accessor.requireType("SCALAR");
    accessor.requireUnsigned();
    buffers.memoryBudget().take(accessor.count() * sizeof(std::uint32_t), accessor.node());
    indices.reserve(accessor.count());
    for (std::size_t i = 0; i < accessor.count(); ++i) {
        indices.push_back(accessor.whole(i));
        if (indices.back() >= vertexCount)
            accessor.node().fail(fmt::format("index {} is {}; allowed: less than {}, the number of vertices",
                                             i, indices.back(), vertexCount));
    }
    return indices;
}

/// Corners that complete no triangle are left out.
std::vector<glm::uvec3> trianglesOf(const std::vector<std::uint32_t> &indices, Mode mode) {
    std::vector<glm::uvec3> triangles;
    if (mode == Mode::Triangles) {
        triangles.reserve(indices.size() / 3);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); ++i)
        if (mode == Mode::TriangleFan)
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        else
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    return triangles;
}

/// Numbers used vertices by their first use, in the triangles too. Returns where they were.
std::vector<std::uint32_t> keepUsed(std::vector<glm::uvec3> &triangles, std::size_t vertexCount) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> sources;
    const auto renumber = [&](auto &&numberOf) {
        for (glm::uvec3 &triangle : triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner) {
                std::uint32_t &number = numberOf(triangle[corner]);
                if (number == unused) {
                    number = static_cast<std::uint32_t>(sources.size());
                    sources.push_back(triangle[corner]);
                }
                triangle[corner] = number;
            }
    };
    if (vertexCount / 16 <= triangles.size()) {
        std::vector<std::uint32_t> numbers(vertexCount, unused);
        renumber([&](std::uint32_t vertex) -> std::uint32_t & { return numbers[vertex]; });
    } else { // few of the vertices, which other primitives share
        std::unordered_map<std::uint32_t, std::uint32_t> numbers;
        renumber([&](std::uint32_t vertex) -> std::uint32_t & {
            return numbers.try_emplace(vertex, unused).first->second;
        });
    }
    return sources;
}

template <class Value, class Read>
std::vector<Value> readValues(const std::vector<std::uint32_t> &sources, const Read &read) {
    std::vector<Value> values;
    values.reserve(sources.size());
    for (const std::uint32_t source : sources)
        values.push_back(read(source));
    return values;
}

void readUvs(const Attributes &attributes, std::size_t set, Vertices &vertices) {
    const Accessor *const uvs = find(attributes, fmt::format("TEXCOORD_{}", set));
    if (uvs == nullptr)
        return;
    uvs->requireType("VEC2");
    vertices.uvs[set] = readValues<glm::vec2>(vertices.sources, [&](std::uint32_t i) {
        const glm::vec2 uv = uvs->vec2(i);
        return glm::vec2(uv.x, 1.0f - uv.y);
    });
}

void readColours(const Attributes &attributes, Vertices &vertices) {
    constexpr std::string_view allowed[] = {"VEC3", "VEC4"};
    const Accessor *const colours = find(attributes, "COLOR_0");
    if (colours == nullptr)
        return;
    colours->requireType(allowed);
    vertices.colours = readValues<glm::vec4>(vertices.sources, [&](std::uint32_t i) {
        const glm::vec4 colour =
            colours->componentCount() == 4 ? colours->vec4(i) : glm::vec4(colours->vec3(i), 1.0f);
        return glm::clamp(colour, 0.0f, 1.0f);
    });
}

Vertices readVertices(const Attributes &attributes, std::vector<std::uint32_t> sources) {
    Vertices vertices;
    vertices.sources = std::move(sources);
    const Accessor &positions = attributes.find("POSITION")->second;
    vertices.positions =
        readValues<glm::vec3>(vertices.sources, [&](std::uint32_t i) { return positions.vec3(i); });
    if (const Accessor *const normals = find(attributes, "NORMAL")) {
        normals->requireType("VEC3");
        vertices.normals =
            readValues<glm::vec3>(vertices.sources, [&](std::uint32_t i) { return normals->vec3(i); });
        if (const Accessor *const tangents =
                find(attributes, "TANGENT")) { // without normals they do not count
            tangents->requireType("VEC4");
            vertices.tangents =
                readValues<glm::vec4>(vertices.sources, [&](std::uint32_t i) { return tangents->vec4(i); });
        }
    }
    readUvs(attributes, 0, vertices);
    readUvs(attributes, 1, vertices);
    readColours(attributes, vertices);
    return vertices;
}

} // namespace

Attributes readAttributes(Buffers &buffers, const JsonNode &node) {
    Attributes attributes;
    for (const auto &[name, member] : JsonObject(node).members(1024)) {
        // Of programs' own, whose names begin with _, nobody else knows the meaning.
        if (!isRead(name) && !name.starts_with('_'))
            buffers.document().losses().add("attribute", [&, &unread = member] {
                return fmt::format("{}: {}: left out", *unread.fileName, unread.path.to_string());
            });
        attributes.emplace(name, Accessor(buffers, buffers.document().reference(member, "accessors")));
    }
    for (const auto &[name, accessor] : attributes)
        accessor.requireCount(attributes.begin()->second.count());
    return attributes;
}

std::optional<Primitive> readPrimitive(Buffers &buffers, const JsonNode &node, PassedOver &passedOver) {
    const JsonObject object(node);
    const auto mode = static_cast<Mode>(object.integer<int>("mode", {0, 6}, 4));
    if (mode < Mode::Triangles) {
        ++(mode == Mode::Points ? passedOver.points : passedOver.lines);
        return std::nullopt;
    }
    Primitive primitive;
    primitive.material = buffers.document().reference(object, "material", "materials");
    std::optional<DracoMesh> draco;
    if (const std::optional<JsonObject> extension = extensionOf(object, "KHR_draco_mesh_compression")) {
        draco = decodeDraco(buffers, object, *extension);
        primitive.attributes = std::move(draco->attributes);
    } else {
        primitive.attributes = readAttributes(buffers, object.at("attributes"));
    }
    const Accessor *const positions = find(primitive.attributes, "POSITION");
    if (positions == nullptr) {
        ++passedOver.empty;
        return std::nullopt;
    }
    positions->requireType("VEC3");
    const std::size_t vertexCount = positions->count();
    primitive.triangles =
        trianglesOf(draco ? draco->indices : readIndices(buffers, object, vertexCount), mode);
    constexpr std::size_t bytesEach = 200; // of a triangle, with its vertices, here and in the mesh
    buffers.memoryBudget().take(primitive.triangles.size() * bytesEach, node);
    std::vector<std::uint32_t> sources = keepUsed(primitive.triangles, vertexCount);
    primitive.vertices = readVertices(primitive.attributes, std::move(sources));
    return primitive;
}

} // namespace hyalite::core::gltf
