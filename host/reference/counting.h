// What a traversal is asked to count: nothing, which costs nothing, or all that the kernel over a stack counts.
// Twin: the counts in shaders/traverse_stack.glsl.
#pragma once

#include "host/report/work_counts.h"
#include "shaders/layout.h"

namespace hyalite::reference {

struct NoCounter {
    void visitNode(const layout::NodePair &) {}
    void waitSubtrees(std::size_t) {}
    void testTriangle() {}
};

struct WorkCounter {
    WorkCounts counts;

    void visitNode(const layout::NodePair &node) {
        ++counts.nodesVisited;
        counts.boxesTested +=
            (node.left != layout::noNode ? 1u : 0u) + (node.right != layout::noNode ? 1u : 0u);
    }
    /// `count` subtrees wait while the ray goes into another one.
    void waitSubtrees(std::size_t count) {
        counts.deepestStack = std::max<std::uint64_t>(counts.deepestStack, count);
    }
    void testTriangle() { ++counts.trianglesTested; }
};

} // namespace hyalite::reference
