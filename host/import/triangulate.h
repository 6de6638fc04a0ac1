// Polygon triangulation by ear clipping in the plane that the polygon faces most.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// Triangulates polygons one after the other, and keeps its working memory (about 75 bytes a corner).
///
/// Ear clipping after G. H. Meisters, "Polygons Have Ears", American Mathematical Monthly 82 (1975). Only reflex
/// corners can lie in an ear (D. Eberly, "Triangulation by Ear Clipping" (2002)); they are looked up in a tree of
/// boxes, which makes it nearly linear in the number of corners where a list takes seconds for a hostile polygon. The
/// plane's normal is the sum of I. E. Sutherland, R. F. Sproull and R. A. Schumacker's "Newell" terms (A
/// Characterization of Ten Hidden-Surface Algorithms, ACM Computing Surveys 6 (1974)).
class Triangulator {
  public:
    /// Splits a polygon of n >= 3 corners into exactly n - 2 triangles of corner numbers in [0, n), each wound
    /// as the polygon is. A quad that is convex is split between its corners 0 and 2.
    ///
    /// A simple polygon, convex or concave, in any plane, with collinear corners, is covered once, and no
    /// triangle has zero area unless all corners are collinear. Polygons that touch themselves (holes on a
    /// bridge) are covered once too. Self-crossing, folded or non-finite ones give n - 2 triangles of no
    /// promised shape. The span is valid until the next call. Throws nothing but std::bad_alloc.
    [[nodiscard]] std::span<const glm::uvec3> triangulate(std::span<const glm::vec3> corners);

  private:
    /// Kinds of ears. A simple polygon always has a strict one; when no corner of a kind is left, the next kind is used
    /// for the rest.
    enum class Ear {
        Strict,   ///< convex, and its closed triangle holds no other reflex corner
        Touching, ///< convex, and no reflex corner lies inside the triangle or on the tip
        Convex,   ///< convex, whatever lies inside
        Any,      ///< every corner
    };

    void project(std::span<const glm::vec3> corners);
    void linkCorners();
    void clipEars(Ear kind);
    void clip(std::uint32_t corner);
    void queueForNextRound(std::uint32_t corner);
    void buildTree();
    void updateReflex(std::uint32_t corner);
    void setReflex(std::uint32_t corner, bool isReflex);
    [[nodiscard]] double turn(std::uint32_t corner) const;
    [[nodiscard]] bool isEar(std::uint32_t corner, Ear kind) const;
    /// Whether a reflex corner, other than those of the ear, prevents clipping it.
    [[nodiscard]] bool isBlocked(std::uint32_t corner, Ear kind) const;

    std::vector<glm::dvec2> points_; ///< corners in the plane, counter-clockwise
    std::vector<std::uint32_t> previous_, next_;
    // A complete binary tree as in a heap: node i has the children 2 i and 2 i + 1, and the leaves come last.
    struct TreeNode {
        glm::dvec2 low, high;          ///< bounds of all its corners
        std::uint32_t begin, end;      ///< in treeOrder_
        std::uint32_t reflexCount = 0; ///< number of its remaining corners that are not strictly convex
    };
    std::vector<TreeNode> tree_;           ///< 0 is not used, 1 is the root
    std::vector<std::uint32_t> treeOrder_; ///< corners, leaf by leaf
    std::vector<std::uint32_t> leafOf_;    ///< corner -> node
    std::vector<std::uint8_t> state_;      ///< of each corner: bits of CornerState
    std::vector<std::uint32_t> thisRound_, nextRound_;
    std::vector<glm::uvec3> triangles_;
    std::size_t remaining_ = 0;
};

} // namespace hyalite::core
