// Ray counts of a render, by kind.
#pragma once

#include <array>
#include <cstdint>

namespace hyalite::core {

struct RayCounts {
    std::uint64_t primary = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflection = 0;
    std::uint64_t refraction = 0;
    std::uint64_t bounce = 0; ///< scattered by surfaces that are not specular

    [[nodiscard]] std::uint64_t total() const { return primary + shadow + reflection + refraction + bounce; }
    RayCounts &operator+=(const RayCounts &other) {
        primary += other.primary;
        shadow += other.shadow;
        reflection += other.reflection;
        refraction += other.refraction;
        bounce += other.bounce;
        return *this;
    }
    friend RayCounts operator+(RayCounts a, const RayCounts &b) { return a += b; }
    bool operator==(const RayCounts &) const = default;
};

struct RayKind {
    const char *name;
    std::uint64_t RayCounts::*count;
};

inline constexpr std::array<RayKind, 5> rayKinds{{{"primary", &RayCounts::primary},
                                                  {"shadow", &RayCounts::shadow},
                                                  {"reflection", &RayCounts::reflection},
                                                  {"refraction", &RayCounts::refraction},
                                                  {"bounce", &RayCounts::bounce}}};

} // namespace hyalite::core
