#include "host/lab/coverage.h"

#include "host/reference/first_hits.h"
#include "host/scene/scene_nodes.h"

#include <algorithm>
#include <map>
#include <utility>

namespace hyalite::core {

namespace {

/// A mesh at a place, by the input indices of its triangles.
struct Entry {
    std::uint32_t firstTriangle;
    const TriangleMesh *mesh;
    std::uint32_t node;
    std::size_t instance; ///< among the places of its node
};

/// The objects of a scene: its spheres, then its meshes in the order of the input.
class Objects {
  public:
    explicit Objects(const PreparedScene &prepared)
        : scene_(prepared.loaded.scene), firstTriangleId_(prepared.packed.frame.firstTriangleId),
          placeCounts_(scene_.nodes.size() + 1, 0) {
        std::uint32_t triangleCount = 0;
        visitObjects(scene_, [&](const PlacedObject &object) {
            entries_.push_back({triangleCount, &object.mesh, object.node, placeCount(object.node)++});
            triangleCount += static_cast<std::uint32_t>(object.mesh.triangles.size());
        });
    }

    [[nodiscard]] std::size_t count() const { return scene_.spheres.size() + entries_.size(); }

    /// The object and the material of a primitive.
    [[nodiscard]] std::pair<std::size_t, std::uint32_t> at(std::uint32_t primitive) const {
        if (primitive < firstTriangleId_)
            return {primitive, scene_.spheres[primitive].materialIndex};
        const std::uint32_t triangle = primitive - firstTriangleId_;
        const auto entry = std::prev(std::ranges::upper_bound(entries_, triangle, {}, &Entry::firstTriangle));
        return {scene_.spheres.size() + static_cast<std::size_t>(entry - entries_.begin()),
                entry->mesh->materialOf(triangle - entry->firstTriangle)};
    }

    [[nodiscard]] ObjectCoverage named(std::size_t object) {
        ObjectCoverage named;
        if (object < scene_.spheres.size()) {
            named.sphere = static_cast<std::uint32_t>(object);
            named.material = scene_.materials[scene_.spheres[object].materialIndex].name;
            return named;
        }
        const Entry &entry = entries_[object - scene_.spheres.size()];
        if (placeCount(entry.node) > 1)
            named.instance = entry.instance;
        if (entry.node == noNode) {
            named.node = {.name = entry.mesh->name, .kind = NodeKind::Mesh};
            return named;
        }
        named.node = scene_.nodes[entry.node];
        for (std::uint32_t above = named.node.parent; above != noNode; above = scene_.nodes[above].parent)
            if (scene_.nodes[above].kind == NodeKind::Mesh)
                named.file = scene_.nodes[above].name;
        return named;
    }

  private:
    /// Meshes without a node have a common number.
    std::size_t &placeCount(std::uint32_t node) {
        return placeCounts_[std::min<std::size_t>(node, scene_.nodes.size())];
    }

    const Scene &scene_;
    const std::uint32_t firstTriangleId_;
    std::vector<std::size_t> placeCounts_; ///< of each node
    std::vector<Entry> entries_;
};

template <class Key> void cover(std::map<Key, CoveredPixels> &all, Key key, int x, int y) {
    const auto [known, isNew] = all.try_emplace(key, CoveredPixels{0, {x, x + 1, y, y + 1}});
    CoveredPixels &pixels = known->second;
    ++pixels.pixelCount;
    pixels.box = {std::min(pixels.box.x0, x), std::max(pixels.box.x1, x + 1), std::min(pixels.box.y0, y),
                  std::max(pixels.box.y1, y + 1)};
}

/// The rows of a map by their pixels, the largest first.
template <class Key>
std::vector<std::pair<Key, CoveredPixels>> sorted(const std::map<Key, CoveredPixels> &all) {
    std::vector<std::pair<Key, CoveredPixels>> rows(all.begin(), all.end());
    std::ranges::stable_sort(rows, std::greater(), [](const auto &row) { return row.second.pixelCount; });
    return rows;
}

} // namespace

Coverage measureCoverage(const PreparedScene &prepared) {
    Objects objects(prepared);
    const Crop &crop = prepared.crop;
    Coverage coverage{.crop = crop, .pixelCount = crop.pixelCount()};
    std::map<std::size_t, CoveredPixels> byObject;
    std::map<std::uint32_t, CoveredPixels> byMaterial;
    reference::visitFirstHits(prepared.packed, crop, [&](int y, std::span<const reference::FirstHit> hits) {
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].primitive == layout::noPrimitive) {
                ++coverage.backgroundCount;
                continue;
            }
            const auto [object, material] = objects.at(hits[i].primitive);
            cover(byObject, object, crop.x0 + static_cast<int>(i), y);
            cover(byMaterial, material, crop.x0 + static_cast<int>(i), y);
        }
    });
    coverage.unseenCount = objects.count() - byObject.size();
    for (const auto &[object, pixels] : sorted(byObject)) {
        coverage.objects.push_back(objects.named(object));
        coverage.objects.back().pixels = pixels;
    }
    for (const auto &[material, pixels] : sorted(byMaterial))
        coverage.materials.push_back({prepared.loaded.scene.materials[material].name, pixels});
    return coverage;
}

} // namespace hyalite::core
