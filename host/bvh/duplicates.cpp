#include "host/bvh/duplicates.h"

#include "host/base/hash.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

namespace hyalite::core {

namespace {

/// Triangles are identical if and only if their keys are equal, byte by byte.
struct Key {
    std::array<glm::vec3, 3> corners;
    std::uint32_t material;
    /// With an opacity texture, because triangles with other coordinates show through; else 0.
    std::array<glm::vec2, 3> uvs;
    /// Of triangles that rays pass by chance, or by attributes that are not in the key: no two are identical. Else 0.
    std::uint32_t number;

    [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(this, 1)); }
};
static_assert(sizeof(Key) == 17 * sizeof(std::uint32_t)); // without padding

class Keys {
  public:
    explicit Keys(const Scene &scene) : scene_(scene) {
        std::size_t first = 0;
        for (const TriangleMesh &mesh : scene.meshes) {
            firstIndices_.push_back(static_cast<std::uint32_t>(first));
            first += mesh.triangles.size();
        }
    }

    [[nodiscard]] Key of(const BuildTriangle &triangle) const;

  private:
    const Scene &scene_;
    std::vector<std::uint32_t> firstIndices_; ///< of each mesh
};

Key Keys::of(const BuildTriangle &triangle) const {
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
    if (isAlphaTested(material, !mesh.colours.corners.empty()) &&
        (material.alphaMode == AlphaMode::Blend || !mesh.colours.corners.empty() ||
         !mesh.secondUvs.corners.empty()))
        key.number = triangle.inputIndex + 1;
    const bool hasUvs = !mesh.triangleUvs.empty() && mesh.triangleUvs[index].x != TriangleMesh::noUv;
    if (hasUvs && material.textures[layout::slotOpacity])
        for (glm::length_t corner = 0; corner < 3; ++corner)
            key.uvs[static_cast<std::size_t>(corner)] = mesh.uvs[mesh.triangleUvs[index][corner]];
    return key;
}

/// Tells triangles that may have a duplicate from those that have none, by a bit for each of many values of a hash of
/// the centroid. Which these are does not depend on the order in which threads come.
class CentroidFilter {
  public:
    explicit CentroidFilter(std::size_t count)
        : words_(std::bit_ceil(count * bitsEach / 32 + 1)), once_(words_), again_(words_) {}

    void add(const glm::vec3 &centroid) {
        const Place place = placeOf(centroid);
        const std::uint32_t before = std::atomic_ref(once_[place.word]).fetch_or(place.bit, relaxed);
        if ((before & place.bit) != 0)
            std::atomic_ref(again_[place.word]).fetch_or(place.bit, relaxed);
    }

    [[nodiscard]] bool mayHaveDuplicate(const glm::vec3 &centroid) const {
        const Place place = placeOf(centroid);
        return (again_[place.word] & place.bit) != 0;
    }

  private:
    static constexpr std::size_t bitsEach = 16; // one in 16 triangles at most is looked at in vain
    static constexpr auto relaxed = std::memory_order_relaxed;

    struct Place {
        std::size_t word;
        std::uint32_t bit;
    };

    [[nodiscard]] Place placeOf(const glm::vec3 &centroid) const {
        const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(centroid);
        std::uint64_t hash = (std::uint64_t{bits[0]} << 32 | bits[1]) * 0x9E3779B97F4A7C15u;
        hash = ((hash ^ hash >> 32) + bits[2]) * 0xBF58476D1CE4E5B9u;
        return {static_cast<std::size_t>(hash >> 37) & (words_ - 1), 1u << (hash >> 32 & 31u)};
    }

    std::size_t words_;
    std::vector<std::uint32_t> once_;
    std::vector<std::uint32_t> again_;
};

} // namespace

void dropDuplicates(const Scene &scene, std::vector<BuildTriangle> &items) {
    const auto count = static_cast<std::int64_t>(triangleCount(scene));
    CentroidFilter filter(triangleCount(scene));
#pragma omp parallel for schedule(static) if (count > 8192)
    for (std::int64_t i = 0; i < count; ++i)
        filter.add(items[static_cast<std::size_t>(i)].centroid);
    const std::span<const BuildTriangle> triangles = std::span(items).first(triangleCount(scene));
    const auto suspectCount = std::ranges::count_if(
        triangles, [&](const glm::vec3 &centroid) { return filter.mayHaveDuplicate(centroid); },
        &BuildTriangle::centroid);
    if (suspectCount == 0)
        return;
    // A hash table with linear probing, at most half full, of positions among the items that stay.
    constexpr std::uint32_t free = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> table(std::bit_ceil(2 * static_cast<std::size_t>(suspectCount)), free);
    const std::size_t mask = table.size() - 1;
    const Keys keys(scene);
    /// Whether it is the first of its kind; then it stays, at `position`.
    const auto isFirst = [&](const BuildTriangle &triangle, std::uint32_t position) {
        const Key key = keys.of(triangle);
        std::size_t slot = hashBytes(key.bytes()) & mask;
        while (table[slot] != free && !std::ranges::equal(keys.of(items[table[slot]]).bytes(), key.bytes()))
            slot = (slot + 1) & mask;
        if (table[slot] != free)
            return false;
        table[slot] = position;
        return true;
    };
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const bool isSuspect = i < triangles.size() && filter.mayHaveDuplicate(items[i].centroid);
        if (isSuspect && !isFirst(items[i], kept))
            continue;
        if (kept != i) // nothing moves before the first duplicate
            items[kept] = items[i];
        ++kept;
    }
    items.resize(kept);
}

} // namespace hyalite::core
