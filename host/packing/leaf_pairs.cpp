#include "host/packing/leaf_pairs.h"

#include "host/bvh/common_edge.h"

namespace hyalite::core {

std::uint32_t pairingOf(const layout::TriangleRecord &first, const layout::TriangleRecord &second) {
    // They may differ.
    constexpr std::uint32_t ownFlags = ~0u << layout::triangleEmitterShift | layout::triangleEndsLeaf;
    if (second.primitiveId != first.primitiveId + 1 || second.materialIndex != first.materialIndex ||
        ((first.flags ^ second.flags) & ~ownFlags) != 0)
        return 0;
    const auto edge = commonEdge({first.v0, first.v1, first.v2}, {second.v0, second.v1, second.v2});
    if (!edge || !edge->isOpposite)
        return 0;
    return edge->ofFirst << layout::leafFirstCorner | (edge->ofSecond + 1) << layout::leafSecondCorner;
}

} // namespace hyalite::core
