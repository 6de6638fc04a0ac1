// What the traversal of the tree came to: counts that do not depend on any clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace hyalite {

/// Of a traversal with a stack, nearer subtree first. The same on every device and on the CPU, for the same tree.
struct WorkCounts {
    std::uint64_t nodesVisited = 0;    ///< inner nodes, each of which holds the boxes of its children
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

struct WorkKind {
    const char *name;
    std::uint64_t WorkCounts::*count;
};

inline constexpr std::array<WorkKind, 4> workKinds{{{"nodesVisited", &WorkCounts::nodesVisited},
                                                    {"boxesTested", &WorkCounts::boxesTested},
                                                    {"trianglesTested", &WorkCounts::trianglesTested},
                                                    {"deepestStack", &WorkCounts::deepestStack}}};

} // namespace hyalite
