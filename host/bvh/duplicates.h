// Duplicate triangles. No tree can separate them, so a ray that reaches one would test them all.
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
/// Triangles are identical if they have the same material and the same corners, bit for bit and in the same order. With
/// an opacity texture their texture coordinates must be equal too. A ray that hits one hits all at the same distance,
/// and the smallest index wins. Dropping the others therefore changes no hit. (As emitters, duplicates would be sampled
/// by shadow rays and add their light again.)
class Duplicates {
  public:
    /// The input index that setAside gives to dropped triangles.
    static constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();

    explicit Duplicates(const Scene &scene);

    /// Moves one triangle of each set of identical ones, the one with the smallest index, to the front of the range, in
    /// the original order. The rest is dropped. Returns the number kept.
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
