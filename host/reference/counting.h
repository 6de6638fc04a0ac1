// Counters for traversal: none, at no cost, or all counts of the kernel with a stack. A third one charges each ray
// (ledger_counter.h): integrators say where rays arrive, and what they shade.
// Twin: the counts in shaders/trace/stack.glsl.
#pragma once

#include "host/film/shading_counts.h"
#include "host/film/work_counts.h"
#include "shaders/layout/layout.h"

namespace hyalite::core::reference {

struct NoCounter {
    void visitNode(const layout::NodePair &) {}
    void waitSubtrees(std::size_t) {}
    void testTriangle() {}
    template <class Scene> void arrive(const Scene &, std::uint32_t, std::uint32_t, std::uint32_t) {}
    void followShadowRay() {}
    void lookAtLight() {}
    void scatter(Lobe) {}
    [[nodiscard]] static ShadingCounts *readsOf() { return nullptr; }
};

struct WorkCounter {
    WorkCounts counts;
    glm::vec3 sample{0.0f}; ///< nodes, boxes and triangles since the last reset, added as the kernel does

    void visitNode(const layout::NodePair &node) {
        const unsigned boxes =
            (node.left != layout::noNode ? 1u : 0u) + (node.right != layout::noNode ? 1u : 0u);
        ++counts.nodesVisited;
        counts.boxesTested += boxes;
        sample += glm::vec3(1.0f, static_cast<float>(boxes), 0.0f);
    }
    /// `count` subtrees wait while the ray goes into another one.
    void waitSubtrees(std::size_t count) {
        counts.deepestStack = std::max<std::uint64_t>(counts.deepestStack, count);
    }
    void testTriangle() {
        ++counts.trianglesTested;
        sample.z += 1.0f;
    }
    template <class Scene> void arrive(const Scene &, std::uint32_t, std::uint32_t, std::uint32_t) {}
    void followShadowRay() {}
    void lookAtLight() {}
    void scatter(Lobe) {}
    [[nodiscard]] static ShadingCounts *readsOf() { return nullptr; }
};

} // namespace hyalite::core::reference
