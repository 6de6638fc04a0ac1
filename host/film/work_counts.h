// Work of the traversal: counts that do not depend on any clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace hyalite::core {

/// Work of a traversal with a stack, nearer subtree first, or by skip lists, whose nodes have one box each. For the
/// same tree the counts are the same on every device and, with a stack, on the CPU.
struct WorkCounts {
    std::uint64_t nodesVisited = 0;    ///< with a stack: inner nodes, which hold the boxes of their children
    std::uint64_t boxesTested = 0;     ///< of existing children
    std::uint64_t trianglesTested = 0; ///< including those that a ray starts on
    std::uint64_t deepestStack = 0;    ///< maximum number of waiting subtrees of a ray

    WorkCounts &operator+=(const WorkCounts &other) {
        nodesVisited += other.nodesVisited;
        boxesTested += other.boxesTested;
        trianglesTested += other.trianglesTested;
        deepestStack = std::max(deepestStack, other.deepestStack);
        return *this;
    }
    bool operator==(const WorkCounts &) const = default;
};

/// Lane utilisation of the traversal. It depends on the device and on the render config.
struct LaneCounts {
    std::uint64_t passes = 0;    ///< of subgroups through the loops of the traversal
    std::uint64_t busySlots = 0; ///< path slots with a node or a triangle to test, summed over passes
    std::uint32_t slotsPerSubgroup = 0;

    LaneCounts &operator+=(const LaneCounts &other) {
        passes += other.passes;
        busySlots += other.busySlots;
        slotsPerSubgroup = std::max(slotsPerSubgroup, other.slotsPerSubgroup);
        return *this;
    }
    /// Fraction of busy slots, over all passes; 0 without passes.
    [[nodiscard]] double busyShare() const {
        const double slots = static_cast<double>(passes) * slotsPerSubgroup;
        return slots > 0.0 ? static_cast<double>(busySlots) / slots : 0.0;
    }
};

struct WorkKind {
    const char *name;
    std::uint64_t WorkCounts::*count;
};

inline constexpr std::array<WorkKind, 4> workKinds{{{"nodesVisited", &WorkCounts::nodesVisited},
                                                    {"boxesTested", &WorkCounts::boxesTested},
                                                    {"trianglesTested", &WorkCounts::trianglesTested},
                                                    {"deepestStack", &WorkCounts::deepestStack}}};

} // namespace hyalite::core
