// The BVH with up to eight children a node, for shaders/trace/wide_node.glsl, made of the node pairs. Ylitie, Karras and
// Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017: nodes take the children of
// their children of the largest area first (section 2.1), and children are put into slots by the octant in which they lie
// (section 3.1). Unlike there, a node has a word for each child, so that leaves keep the order of their triangles.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite::core {

struct WideTree {
    std::vector<layout::WideNode> nodes;
    /// In place of those of the scene: with the roots of their trees among `nodes`.
    std::vector<layout::InstanceRecord> instances;
};

/// The root of the scene's own tree is node 0. Every box of the tree encloses the box from which it was made, by the sums
/// of floats by which kernels unpack it. Throws Error{LimitExceeded} beyond layout::maxWideNodes.
[[nodiscard]] WideTree makeWideTree(const PackedScene &scene);

} // namespace hyalite::core
