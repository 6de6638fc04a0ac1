// What the traversal of the tree came to: counts that do not depend on any clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace hyalite {

/// Of a traversal with a stack, nearer subtree first, or of one by skip lists, whose nodes are one box each and which has
/// no stack. The same on every device and, with a stack, on the CPU, for the same tree.
struct WorkCounts {
    std::uint64_t nodesVisited = 0;    ///< with a stack, inner ones, which hold the boxes of their children
    std::uint64_t boxesTested = 0;     ///< of children that there are
    std::uint64_t trianglesTested = 0; ///< those that a ray starts on too
    std::uint64_t deepestStack = 0;    ///< most subtrees that waited for one ray

    WorkCounts &operator+=(const WorkCounts &other) {
        nodesVisited += other.nodesVisited;
        boxesTested += other.boxesTested;
        trianglesTested += other.trianglesTested;
        deepestStack = std::max(deepestStack, other.deepestStack);
        return *this;
    }
    bool operator==(const WorkCounts &) const = default;
};

/// How many lanes of its subgroups the traversal kept busy. It depends on the device and on how work is cut.
struct LaneCounts {
    std::uint64_t passes = 0;    ///< of subgroups through the loops of the traversal
    std::uint64_t busySlots = 0; ///< path slots that had a node or a triangle to look at, in all passes
    std::uint32_t slotsPerSubgroup = 0;

    LaneCounts &operator+=(const LaneCounts &other) {
        passes += other.passes;
        busySlots += other.busySlots;
        slotsPerSubgroup = std::max(slotsPerSubgroup, other.slotsPerSubgroup);
        return *this;
    }
    /// Of all slots in all passes; 0 without passes.
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

} // namespace hyalite
