// The bounding volume hierarchy (BVH) over a scene's triangles, spheres and instances, and its two CPU builders.
#pragma once

#include "host/base/unset_vector.h"
#include "host/scene/scene.h"
#include "host/scene/settings.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hyalite::core {

/// An axis-aligned box in world space; the default one is empty and neutral under `extend`.
struct Box {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    void extend(const glm::vec3 &point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void extend(const Box &other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    [[nodiscard]] bool isEmpty() const { return lower.x > upper.x; }
    [[nodiscard]] bool contains(const Box &other) const {
        return glm::min(lower, other.lower) == lower && glm::max(upper, other.upper) == upper;
    }
    /// Half of the surface area, in double as boxes may be large; 0 when empty.
    [[nodiscard]] double halfArea() const;
};

/// A triangle, a sphere or an instance, as builders see it.
struct BuildTriangle {
    Box box;
    glm::vec3 centroid{0.0f};
    /// Among the triangles of all meshes, in order; then the spheres in the tree, then the instances.
    std::uint32_t inputIndex = 0;
};

struct BvhNode {
    Box box;
    /// Leaf: position of its first triangle in Bvh::order; inner: index of the left child.
    std::uint32_t first = 0;
    /// Leaf: number of triangles; inner: 0, and the right child follows the left one.
    std::uint32_t count = 0;

    [[nodiscard]] bool isLeaf() const { return count > 0; }
};

struct Bvh {
    UnsetVector<BvhNode> nodes; ///< the root first; empty without triangles. Children come after their parent
    std::vector<std::uint32_t> order; ///< input indices of triangles, spheres and instances, leaf by leaf
    int depth = 0;                    ///< inner nodes on the longest path to a leaf: 0 for a single leaf
    std::uint32_t firstInstance = std::numeric_limits<std::uint32_t>::max(); ///< in the order: from here on
    std::vector<std::uint32_t> spheres; ///< indices of those in the tree, in the order of the input
    std::vector<Bvh> prototypes;        ///< trees of Scene::prototypes, each in its own space

    [[nodiscard]] bool isInstance(std::uint32_t inputIndex) const { return inputIndex >= firstInstance; }
};

/// The triangles of all meshes in input order. Throws Error{LimitExceeded} beyond 2^30 - 65 triangles.
[[nodiscard]] std::vector<BuildTriangle> buildTriangles(const Scene &scene);

/// buildTriangles, and after them the spheres in the tree (tree_spheres.h) and the instances. The instances' boxes
/// enclose their triangles, and nothing that is outside the exact bounds of the scene.
[[nodiscard]] std::vector<BuildTriangle> buildItems(const Scene &scene);

/// Builds the tree of the given kind; `None` gives one leaf. No tree is deeper than layout::maxTreeDepth - 1.
/// A leaf of the others holds at most `leafSize` (>= 1) triangles. The tree depends on the arguments only.
[[nodiscard]] Bvh buildBvh(TreeKind kind, std::vector<BuildTriangle> triangles, int leafSize);

/// Builds over a scene's triangles, its spheres in the tree (tree_spheres.h) and its instances, which have leaves of
/// their own; and over each prototype. Omits duplicates
/// (duplicates.h) among the triangles of meshes from Bvh::order. The set of duplicates does not depend on the tree.
/// Throws Error{LimitExceeded} as buildTriangles does.
[[nodiscard]] Bvh buildBvh(TreeKind kind, const Scene &scene, int leafSize);

} // namespace hyalite::core
