// Work charges: a ledger (host/film/work_ledger.h) by the names of objects and materials.
#pragma once

#include "host/film/work_ledger.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace hyalite::core {

struct WorkCharge {
    std::string name; ///< empty: no surface, but what rays meet that leave the scene
    WorkByStage work;
};

struct WorkCharges {
    std::uint32_t samplesPerPixel = 0; ///< that were charged, the first ones
    WorkByStage totals{};
    ShadingCounts shading{};
    std::vector<WorkCharge> objects; ///< those with rays; most tests first, and of equal ones most rays
    std::vector<WorkCharge> materials;
};

/// `objects` and `materials` are the names by number, which counts from 1.
[[nodiscard]] WorkCharges chargesOf(const WorkLedger &ledger, std::uint32_t samplesPerPixel,
                                    const std::vector<std::string> &objects,
                                    const std::vector<std::string> &materials);

/// The three dearest objects with their shares of all tests, or of all rays where nothing is tested; for people.
[[nodiscard]] std::string dearestText(const WorkCharges &charges);

/// What was shaded, by lobes, and what it read; for people.
[[nodiscard]] std::string shadingText(const ShadingCounts &shading);

/// Of objects and of materials the first `maxRows`, and how many the others are, with the sum of theirs.
[[nodiscard]] nlohmann::ordered_json chargesToJson(const WorkCharges &charges, std::size_t maxRows = 20);

} // namespace hyalite::core
