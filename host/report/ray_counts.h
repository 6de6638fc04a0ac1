// How many rays a render traced, by kind.
#pragma once

#include <array>
#include <cstdint>

namespace hyalite {

struct RayCounts {
    std::uint64_t primary = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflection = 0;
    std::uint64_t refraction = 0;

    [[nodiscard]] std::uint64_t total() const { return primary + shadow + reflection + refraction; }
    RayCounts &operator+=(const RayCounts &other) {
        primary += other.primary;
        shadow += other.shadow;
        reflection += other.reflection;
        refraction += other.refraction;
        return *this;
    }
    bool operator==(const RayCounts &) const = default;
};

struct RayKind {
    const char *name;
    std::uint64_t RayCounts::*count;
};

inline constexpr std::array<RayKind, 4> rayKinds{{{"primary", &RayCounts::primary},
                                                  {"shadow", &RayCounts::shadow},
                                                  {"reflection", &RayCounts::reflection},
                                                  {"refraction", &RayCounts::refraction}}};

} // namespace hyalite
