// The BVH as skip lists for shaders/trace/skip_list.glsl, packed from the node pairs.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite::core {

/// The grid of a tree's box planes: plane q, in [-32768, 32767], is at middle + scale * q.
struct SkipGrid {
    glm::vec3 middle{0.0f};
    glm::vec3 scale{1.0f}; ///< > 0
};

/// Where a tree is in each of the two lists, and its grid.
struct SkipTree {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    SkipGrid grid;
};

struct SkipList {
    /// Two lists of `length`, and a node for rays that have reached the end.
    UnsetVector<layout::SkipNode> nodes;
    std::uint32_t length = 0;    ///< of one list
    std::vector<SkipTree> trees; ///< in the order of PackedScene::trees
    /// In place of those of the scene: with where their trees are in the lists, and the maps from the grids.
    std::vector<layout::InstanceRecord> instances;

    /// Sets the fields of a frame that the lists decide.
    void describe(layout::FrameRecord &frame) const;
};

/// Empty without triangles. Every box of the list encloses the box from which it was made.
///
/// In the first list lower siblings come first, for rays with a positive largest direction component; in the second
/// list upper siblings do. A list for each octant of directions would save diffuse rays 3 % of their steps, but costs
/// more than that, because less of eight lists fits into caches.
[[nodiscard]] SkipList makeSkipList(const PackedScene &scene);

/// Maximum size of both lists for this many node pairs, in bytes.
[[nodiscard]] std::uint64_t maxSkipListBytes(std::size_t pairCount);
/// Size of the temporary memory for making them, in bytes.
[[nodiscard]] std::uint64_t skipListWorkBytes(std::size_t pairCount);

} // namespace hyalite::core
