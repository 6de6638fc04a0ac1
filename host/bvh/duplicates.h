// Triangles that a scene has more than once. No tree can separate them, so every ray that meets one would test them all.
#pragma once

#include "host/bvh/bvh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hyalite {

/// Knows the triangles of a scene, which must outlive it and stay as it is.
///
/// Identical are triangles of one material whose corners are the same in every bit, and in the same order; and, where the
/// material is cut out, their texture coordinates. A ray that meets
/// one of them meets all, at one distance, and the nearest hit is that of the smallest index: the others are never
/// seen, and without them no hit changes. (As emitters they would be chosen for shadow rays, and give their light again
/// and again.)
class Duplicates {
  public:
    /// The input index that setAside gives to what is dropped.
    static constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();

    explicit Duplicates(const Scene &scene);

    /// Leaves one of each set of identical triangles, that of the smallest index, in front of the range and in the
    /// order in which they were; the rest of it is dropped. Returns how many there are in front.
    [[nodiscard]] std::size_t setAside(std::span<BuildTriangle> range) const;

  private:
    struct Key;

    [[nodiscard]] Key keyOf(const BuildTriangle &triangle) const;
    [[nodiscard]] bool areIdentical(const BuildTriangle &a, const BuildTriangle &b) const;
    [[nodiscard]] std::size_t setAsideFew(std::span<BuildTriangle> range) const;
    [[nodiscard]] std::size_t setAsideMany(std::span<BuildTriangle> range) const;

    const Scene &scene_;
    std::vector<std::uint32_t> firstIndices_; ///< of each mesh
};

} // namespace hyalite
