#include "host/import/tangents.h"

#include "host/base/disjoint_sets.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace hyalite::core {
namespace {

enum class Orientation : std::uint8_t { Same, Mirrored, Unknown };

/// A triangle in its texture.
struct Face {
    glm::dvec3 alongU{0.0}; ///< unit length, or 0
    Orientation orientation = Orientation::Unknown;
};

using Key = std::array<std::uint32_t, 8>;

struct KeyHash {
    std::size_t operator()(const Key &key) const {
        std::uint64_t hash = 0xcbf29ce484222325u;
        for (const std::uint32_t word : key)
            hash = (hash ^ word) * 0x100000001b3u;
        return static_cast<std::size_t>(hash ^ hash >> 32);
    }
};

std::uint32_t bitsOf(float number) { return std::bit_cast<std::uint32_t>(number + 0.0f); } // -0 is 0

/// Of each position the number of its vertex: equal ones where position, normal and texture coordinates are.
std::vector<std::uint32_t> weld(const TangentInput &input) {
    std::unordered_map<Key, std::uint32_t, KeyHash> known;
    std::vector<std::uint32_t> vertices(input.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::vec3 &p = input.positions[i];
        const glm::vec3 &n = input.normals[i];
        const glm::vec2 &t = input.uvs[i];
        const Key key{bitsOf(p.x), bitsOf(p.y), bitsOf(p.z), bitsOf(n.x),
                      bitsOf(n.y), bitsOf(n.z), bitsOf(t.x), bitsOf(t.y)};
        vertices[i] = known.try_emplace(key, static_cast<std::uint32_t>(known.size())).first->second;
    }
    return vertices;
}

Face faceOf(const TangentInput &input, const glm::uvec3 &triangle) {
    const glm::dvec3 origin(input.positions[triangle.x]);
    const glm::dvec3 edge1 = glm::dvec3(input.positions[triangle.y]) - origin;
    const glm::dvec3 edge2 = glm::dvec3(input.positions[triangle.z]) - origin;
    const glm::dvec2 uvOrigin(input.uvs[triangle.x]);
    const glm::dvec2 uv1 = glm::dvec2(input.uvs[triangle.y]) - uvOrigin;
    const glm::dvec2 uv2 = glm::dvec2(input.uvs[triangle.z]) - uvOrigin;
    const double area = uv1.x * uv2.y - uv1.y * uv2.x;
    Face face;
    if (std::abs(area) <= static_cast<double>(std::numeric_limits<float>::min()))
        return face;
    face.orientation = area > 0.0 ? Orientation::Same : Orientation::Mirrored;
    const glm::dvec3 along = (area > 0.0 ? 1.0 : -1.0) * (uv2.y * edge1 - uv1.y * edge2);
    const double length = glm::length(along);
    if (length > 0.0)
        face.alongU = along / length;
    return face;
}

glm::dvec3 unitOrZero(const glm::dvec3 &vector) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : glm::dvec3(0.0);
}

glm::dvec3 projected(const glm::dvec3 &vector, const glm::dvec3 &normal) {
    return vector - normal * glm::dot(normal, vector);
}

/// The angle of a triangle at one of its corners, seen along the normal.
double angleAt(const TangentInput &input, const glm::uvec3 &triangle, glm::length_t corner,
               const glm::dvec3 &normal) {
    const glm::dvec3 at(input.positions[triangle[corner]]);
    const glm::dvec3 next(input.positions[triangle[(corner + 1) % 3]]);
    const glm::dvec3 previous(input.positions[triangle[(corner + 2) % 3]]);
    const double cosine =
        glm::dot(unitOrZero(projected(next - at, normal)), unitOrZero(projected(previous - at, normal)));
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Any unit vector at right angles to the normal.
glm::dvec3 anyTangent(const glm::dvec3 &normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return unitOrZero(projected(axis, normal));
}

/// A corner of a triangle.
struct Corner {
    std::uint32_t triangle;
    std::uint32_t corner;
};

class TangentBuilder {
  public:
    explicit TangentBuilder(const TangentInput &input) : input_(input), vertices_(weld(input)) {
        for (const glm::uvec3 &triangle : input.triangles)
            faces_.push_back(faceOf(input, triangle));
        tangents_.corners.resize(input.triangles.size());
    }

    Tangents build() {
        for (const std::vector<Corner> &star : stars())
            addStar(star);
        return std::move(tangents_);
    }

  private:
    /// Of each vertex the corners that meet there.
    [[nodiscard]] std::vector<std::vector<Corner>> stars() const {
        std::uint32_t vertexCount = 0;
        for (const std::uint32_t vertex : vertices_)
            vertexCount = std::max(vertexCount, vertex + 1);
        std::vector<std::vector<Corner>> stars(vertexCount);
        for (std::uint32_t i = 0; i < input_.triangles.size(); ++i)
            for (std::uint32_t corner = 0; corner < 3; ++corner)
                stars[vertices_[input_.triangles[i][static_cast<glm::length_t>(corner)]]].push_back(
                    {i, corner});
        return stars;
    }

    [[nodiscard]] Orientation orientationOf(const Corner &corner) const {
        return faces_[corner.triangle].orientation;
    }

    /// The vertex at the other end of an edge from a corner; `step` is 1 or 2.
    [[nodiscard]] std::uint32_t endOf(const Corner &corner, std::uint32_t step) const {
        return vertices_[input_.triangles[corner.triangle]
                                         [static_cast<glm::length_t>((corner.corner + step) % 3)]];
    }

    void addStar(const std::vector<Corner> &star) {
        DisjointSets groups(star.size());
        /// Of each edge, by its other end, the first triangle of each orientation.
        std::unordered_map<std::uint32_t, std::array<std::optional<std::size_t>, 2>> edges;
        for (std::size_t i = 0; i < star.size(); ++i)
            for (const std::uint32_t step : {1u, 2u}) {
                if (orientationOf(star[i]) == Orientation::Unknown)
                    continue;
                std::optional<std::size_t> &first =
                    edges[endOf(star[i], step)][orientationOf(star[i]) == Orientation::Same ? 0 : 1];
                if (first)
                    groups.join(*first, i);
                else
                    first = i;
            }
        for (std::size_t i = 0; i < star.size(); ++i)
            if (orientationOf(star[i]) == Orientation::Unknown)
                adopt(star[i], i, edges, groups);
        addTangents(star, groups);
    }

    /// Puts a triangle without area in the texture into the group of a neighbour.
    template <class Edges>
    void adopt(const Corner &corner, std::size_t place, const Edges &edges, DisjointSets &groups) const {
        for (const std::uint32_t step : {1u, 2u})
            if (const auto edge = edges.find(endOf(corner, step)); edge != edges.end()) {
                groups.join(edge->second[0] ? *edge->second[0] : *edge->second[1], place);
                return;
            }
    }

    void addTangents(const std::vector<Corner> &star, DisjointSets &groups) {
        std::unordered_map<std::size_t, std::vector<std::size_t>> members; // by the group's root
        for (std::size_t i = 0; i < star.size(); ++i)
            members[groups.rootOf(i)].push_back(i);
        for (std::size_t i = 0; i < star.size(); ++i) {
            const auto group = members.find(groups.rootOf(i));
            if (group == members.end())
                continue; // done with an earlier member
            const auto index = static_cast<std::uint32_t>(tangents_.values.size());
            tangents_.values.push_back(tangentOf(star, group->second));
            for (const std::size_t member : group->second)
                tangents_.corners[star[member].triangle][static_cast<glm::length_t>(star[member].corner)] =
                    index;
            members.erase(group);
        }
    }

    [[nodiscard]] glm::vec4 tangentOf(const std::vector<Corner> &star,
                                      const std::vector<std::size_t> &members) const {
        const Corner &first = star[members.front()];
        const glm::dvec3 normal(
            input_.normals[input_.triangles[first.triangle][static_cast<glm::length_t>(first.corner)]]);
        glm::dvec3 sum(0.0);
        bool isMirrored = false;
        for (const std::size_t member : members) {
            const Corner &corner = star[member];
            const Face &face = faces_[corner.triangle];
            if (face.orientation == Orientation::Unknown)
                continue;
            isMirrored = face.orientation == Orientation::Mirrored;
            sum += angleAt(input_, input_.triangles[corner.triangle],
                           static_cast<glm::length_t>(corner.corner), normal) *
                   unitOrZero(projected(face.alongU, normal));
        }
        glm::dvec3 tangent = unitOrZero(sum);
        if (tangent == glm::dvec3(0.0))
            tangent = anyTangent(normal);
        return {glm::vec3(tangent), isMirrored ? -1.0f : 1.0f};
    }

    const TangentInput &input_;
    std::vector<std::uint32_t> vertices_; ///< of each position
    std::vector<Face> faces_;             ///< of each triangle
    Tangents tangents_;
};

} // namespace

Tangents mikkTangents(const TangentInput &input) { return TangentBuilder(input).build(); }

} // namespace hyalite::core
