// Audits: tiles of a merged picture, rendered again, to find parts whose makers computed otherwise.
#pragma once

#include "host/engine/backend.h"
#include "host/farm/merge.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

struct AuditFinding {
    std::uint32_t part;
    Crop tile;
    int x; ///< its first pixel that differs
    int y;
    std::size_t differingPixels;
};

struct AuditResult {
    std::size_t tileCount = 0; ///< that were rendered
    std::vector<AuditFinding> findings;
};

/// The seed by which tiles are chosen unless the user has one: a hash of the picture, which no maker of a part knows.
[[nodiscard]] std::uint64_t auditSeed(const Merger &merged);

/// Renders `share` of the tiles of the parts that are there, in (0, 1] and one at least, and compares the pixels bit
/// for bit; layers are not compared. `scene` is that of the parts.
[[nodiscard]] AuditResult audit(const Merger &merged, Backend &backend, const PreparedScene &scene,
                                double share, std::uint64_t seed, Observer &observer);

} // namespace hyalite::core
