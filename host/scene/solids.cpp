#include "host/scene/solids.h"

#include "host/base/disjoint_sets.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace hyalite::core {

namespace {

std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93u;
    return (x ^ x >> 32) * 0xd6e8feb86659fd93u;
}

/// Adds up to 0 over the edges of a closed surface, where each edge is gone along as often both ways.
std::uint64_t edgeHash(std::uint64_t a, std::uint64_t b) {
    return a < b ? mixed(a << 32 | b) : ~mixed(b << 32 | a) + 1;
}

struct PlacedCorner {
    std::uint32_t material;
    glm::vec3 position;
    bool operator==(const PlacedCorner &other) const = default;
};

struct PlacedCornerHash {
    std::size_t operator()(const PlacedCorner &corner) const {
        std::uint64_t hash = corner.material;
        for (int i = 0; i < 3; ++i) // + 0: both zeros have one hash
            hash = mixed(hash << 32 | hash >> 32) ^ std::bit_cast<std::uint32_t>(corner.position[i] + 0.0f);
        return mixed(hash);
    }
};

} // namespace

Solids solidsOf(const TriangleMesh &mesh, const std::vector<Material> &materials) {
    Solids solids;
    solids.ofTriangles.assign(mesh.triangles.size(), noSolid);
    const auto isOfGlass = [&](std::uint32_t index) { return holdsMedium(materials[index]); };
    if (mesh.triangleMaterials.empty() ? !isOfGlass(mesh.materialIndex)
                                       : std::ranges::none_of(mesh.triangleMaterials, isOfGlass))
        return solids;
    const auto forGlass = [&](const auto &use) {
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
            if (isOfGlass(mesh.materialOf(i)))
                use(i, mesh.triangles[i].positions);
    };
    // Of triangles, as one corner may have several glasses.
    DisjointSets sets(mesh.triangles.size());
    std::unordered_map<std::uint64_t, std::uint32_t> ofIndices; // a triangle at the corner
    forGlass([&](std::uint32_t i, const glm::uvec3 &corners) {
        for (int k = 0; k < 3; ++k) {
            const std::uint64_t corner = std::uint64_t{mesh.materialOf(i)} << 32 | corners[k];
            sets.join(ofIndices.try_emplace(corner, i).first->second, i);
        }
    });
    std::vector<std::uint64_t> openEdges(mesh.triangles.size(), 0);
    forGlass([&](std::uint32_t i, const glm::uvec3 &corners) {
        for (int k = 0; k < 3; ++k)
            openEdges[sets.rootOf(i)] += edgeHash(corners[k], corners[(k + 1) % 3]);
    });
    std::vector<bool> isOpen(mesh.triangles.size());
    forGlass([&](std::uint32_t i, const glm::uvec3 &) { isOpen[i] = openEdges[sets.rootOf(i)] != 0; });
    std::unordered_map<PlacedCorner, std::uint32_t, PlacedCornerHash> ofPositions;
    forGlass([&](std::uint32_t i, const glm::uvec3 &corners) {
        for (int k = 0; isOpen[i] && k < 3; ++k) {
            const PlacedCorner corner{mesh.materialOf(i), mesh.positions[corners[k]]};
            sets.join(ofPositions.try_emplace(corner, i).first->second, i);
        }
    });
    std::vector<std::uint32_t> numbers(mesh.triangles.size(), noSolid);
    forGlass([&](std::uint32_t i, const glm::uvec3 &) {
        std::uint32_t &number = numbers[sets.rootOf(i)];
        if (number == noSolid)
            number = solids.count++;
        solids.ofTriangles[i] = number;
    });
    return solids;
}

} // namespace hyalite::core
