#include "host/bvh/duplicates.h"

#include "host/base/hash.h"

#include <algorithm>
#include <array>
#include <bit>

namespace hyalite {

/// Triangles are identical if and only if their keys are equal, byte by byte.
struct Duplicates::Key {
    std::array<glm::vec3, 3> corners;
    std::uint32_t material;
    /// With an opacity texture, because triangles with other coordinates show through; else 0.
    std::array<glm::vec2, 3> uvs;
    /// Of triangles that rays pass by chance, or by attributes that are not in the key: no two are identical. Else 0.
    std::uint32_t number;

    [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(this, 1)); }
};

Duplicates::Duplicates(const Scene &scene) : scene_(scene) {
    std::size_t first = 0;
    for (const TriangleMesh &mesh : scene.meshes) {
        firstIndices_.push_back(static_cast<std::uint32_t>(first));
        first += mesh.triangles.size();
    }
}

Duplicates::Key Duplicates::keyOf(const BuildTriangle &triangle) const {
    const auto next = std::upper_bound(firstIndices_.begin(), firstIndices_.end(), triangle.inputIndex);
    const auto meshIndex = static_cast<std::size_t>(next - firstIndices_.begin()) - 1;
    const TriangleMesh &mesh = scene_.meshes[meshIndex];
    const std::size_t index = triangle.inputIndex - firstIndices_[meshIndex];
    const glm::uvec3 &corners = mesh.triangles[index].positions;
    Key key{{mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]},
            mesh.materialOf(index),
            {},
            0};
    const Material &material = scene_.materials[key.material];
    const bool isSheer =
        material.alphaMode != AlphaMode::Opaque &&
        (material.opacity < 1.0f || material.textures[layout::slotOpacity] || !mesh.colours.corners.empty());
    if (isSheer && (material.alphaMode == AlphaMode::Blend || !mesh.colours.corners.empty() ||
                    !mesh.secondUvs.corners.empty()))
        key.number = triangle.inputIndex + 1;
    const bool hasUvs = !mesh.triangleUvs.empty() && mesh.triangleUvs[index].x != TriangleMesh::noUv;
    if (hasUvs && material.textures[layout::slotOpacity])
        for (glm::length_t corner = 0; corner < 3; ++corner)
            key.uvs[static_cast<std::size_t>(corner)] = mesh.uvs[mesh.triangleUvs[index][corner]];
    return key;
}

bool Duplicates::areIdentical(const BuildTriangle &a, const BuildTriangle &b) const {
    if (a.centroid != b.centroid) // the usual case, decided without reading the mesh
        return false;
    const Key keyA = keyOf(a);
    const Key keyB = keyOf(b);
    return std::ranges::equal(keyA.bytes(), keyB.bytes());
}

std::size_t Duplicates::setAside(std::span<BuildTriangle> range) const {
    constexpr std::size_t few = 16; // so few are compared pairwise, which is faster than a table
    const std::size_t keptCount = range.size() <= few ? setAsideFew(range) : setAsideMany(range);
    for (BuildTriangle &triangle : range.subspan(keptCount))
        triangle.inputIndex = dropped;
    return keptCount;
}

std::size_t Duplicates::setAsideFew(std::span<BuildTriangle> range) const {
    std::size_t keptCount = 0;
    for (const BuildTriangle &triangle : range) {
        const std::span<BuildTriangle> kept = range.first(keptCount);
        const auto same = std::ranges::find_if(
            kept, [&](const BuildTriangle &other) { return areIdentical(other, triangle); });
        if (same != kept.end())
            same->inputIndex = std::min(same->inputIndex, triangle.inputIndex);
        else
            range[keptCount++] = triangle;
    }
    return keptCount;
}

/// A hash table with linear probing, at most half full, of positions in the range.
std::size_t Duplicates::setAsideMany(std::span<BuildTriangle> range) const {
    constexpr std::uint32_t free = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> table(std::bit_ceil(2 * range.size()), free);
    const std::size_t mask = table.size() - 1;
    std::size_t keptCount = 0;
    for (const BuildTriangle &triangle : range) {
        const Key key = keyOf(triangle);
        std::size_t slot = hashBytes(key.bytes()) & mask;
        while (table[slot] != free && !areIdentical(range[table[slot]], triangle))
            slot = (slot + 1) & mask;
        if (table[slot] != free) {
            BuildTriangle &same = range[table[slot]];
            same.inputIndex = std::min(same.inputIndex, triangle.inputIndex);
            continue;
        }
        table[slot] = static_cast<std::uint32_t>(keptCount);
        range[keptCount++] = triangle;
    }
    return keptCount;
}

} // namespace hyalite
