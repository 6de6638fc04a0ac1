// SIMD boxes for the builders' inner loops: one instruction for three axes, where the compiler would emit three. (The
// fourth lane holds whatever follows in memory.)
#pragma once

#include "host/bvh/bvh.h"

#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace hyalite::core {

/// Four floats; GCC's and Clang's arithmetic, comparison and ?: on them go lane by lane.
using Lanes = float __attribute__((vector_size(16)));

struct WideBox {
    Lanes lower;
    Lanes upper;

    WideBox() = default; ///< to be assigned
    explicit WideBox(const BuildTriangle &triangle)
        : lower(lanesAt<offsetof(BuildTriangle, box.lower)>(triangle)),
          upper(lanesAt<offsetof(BuildTriangle, box.upper)>(triangle)) {}

    /// Neutral under `extend`.
    static WideBox empty() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        WideBox box;
        box.lower = Lanes{} + infinity;
        box.upper = Lanes{} - infinity;
        return box;
    }

    /// Bit for bit the result of Box::extend, including the signs of zeros.
    void extend(const WideBox &other) {
        lower = other.lower < lower ? other.lower : lower;
        upper = other.upper > upper ? other.upper : upper;
    }
    /// With inputIndex in the fourth lane.
    [[nodiscard]] static Lanes centroidOf(const BuildTriangle &triangle) {
        return lanesAt<offsetof(BuildTriangle, centroid)>(triangle);
    }
    void extendByCentroid(const BuildTriangle &triangle) {
        const Lanes centroid = centroidOf(triangle);
        lower = centroid < lower ? centroid : lower;
        upper = centroid > upper ? centroid : upper;
    }
    [[nodiscard]] Lanes size() const { return upper - lower; }
    [[nodiscard]] Box box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }

  private:
    template <std::size_t offset> static Lanes lanesAt(const BuildTriangle &triangle) {
        static_assert(std::is_trivially_copyable_v<BuildTriangle> &&
                      offset + sizeof(Lanes) <= sizeof(BuildTriangle));
        Lanes lanes;
        std::memcpy(&lanes, reinterpret_cast<const std::byte *>(&triangle) + offset, sizeof lanes);
        return lanes;
    }
};

/// Bounds of a range of triangles and of their centroids.
struct RangeBounds {
    WideBox triangles = WideBox::empty();
    WideBox centroids = WideBox::empty();

    explicit RangeBounds(std::span<const BuildTriangle> range) {
        for (const BuildTriangle &triangle : range) {
            triangles.extend(WideBox(triangle));
            centroids.extendByCentroid(triangle);
        }
    }
};

} // namespace hyalite::core
