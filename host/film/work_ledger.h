// Work ledger: the rays of a render and their tests, by stage of the path, and by what they are charged to; and what
// shading does.
//
// Each ray is charged once: a ray along the path to what it meets, a shadow ray to the surface that sends it. The
// charges of all objects, and those of all materials, add up to all rays and tests.
#pragma once

#include "host/film/shading_counts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite::core {

enum class PathStage { Primary, Further, Shadow };
inline constexpr std::array<const char *, 3> pathStageNames{"primary", "further", "shadow"};

struct ChargedWork {
    std::uint64_t rays = 0;
    std::uint64_t boxes = 0; ///< tested, as WorkCounts has them
    std::uint64_t triangles = 0;

    [[nodiscard]] std::uint64_t tests() const { return boxes + triangles; }
    ChargedWork &operator+=(const ChargedWork &other) {
        rays += other.rays;
        boxes += other.boxes;
        triangles += other.triangles;
        return *this;
    }
    bool operator==(const ChargedWork &) const = default;
};

/// By PathStage.
using WorkByStage = std::array<ChargedWork, pathStageNames.size()>;

[[nodiscard]] inline ChargedWork sumOf(const WorkByStage &work) {
    ChargedWork sum;
    for (const ChargedWork &stage : work)
        sum += stage;
    return sum;
}

struct WorkLedger {
    std::vector<WorkByStage> objects;   ///< by number (scene_names.h); 0: nothing is met
    std::vector<WorkByStage> materials; ///< likewise
    ShadingCounts shading{};            ///< of all of them

    void charge(PathStage stage, std::size_t object, std::size_t material, const ChargedWork &work) {
        charge(objects, object, stage, work);
        charge(materials, material, stage, work);
    }
    WorkLedger &operator+=(const WorkLedger &other) {
        add(objects, other.objects);
        add(materials, other.materials);
        shading += other.shading;
        return *this;
    }
    [[nodiscard]] WorkByStage totals() const {
        WorkByStage all{};
        for (const WorkByStage &object : objects)
            for (std::size_t stage = 0; stage < all.size(); ++stage)
                all[stage] += object[stage];
        return all;
    }
    bool operator==(const WorkLedger &) const = default;

  private:
    static void charge(std::vector<WorkByStage> &account, std::size_t number, PathStage stage,
                       const ChargedWork &work) {
        account.resize(std::max(account.size(), number + 1));
        account[number][static_cast<std::size_t>(stage)] += work;
    }
    static void add(std::vector<WorkByStage> &sums, const std::vector<WorkByStage> &added) {
        sums.resize(std::max(sums.size(), added.size()));
        for (std::size_t i = 0; i < added.size(); ++i)
            for (std::size_t stage = 0; stage < added[i].size(); ++stage)
                sums[i][stage] += added[i][stage];
    }
};

} // namespace hyalite::core
