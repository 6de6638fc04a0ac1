#include "host/farm/audit.h"

#include "host/base/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace hyalite::core {

namespace {

struct Candidate {
    std::uint64_t rank;
    std::uint32_t part;
    Crop tile;
};

/// The tiles of the parts that are there, in the order in which they are to be drawn.
std::vector<Candidate> candidatesOf(const Merger &merged, std::uint64_t seed) {
    std::vector<Candidate> candidates;
    for (std::uint32_t part = 1; part <= merged.partition().partCount(); ++part)
        if (merged.has(part))
            for (const Crop &tile : merged.partition().squaresOf(part)) {
                const std::array<int, 2> corner{tile.x0, tile.y0};
                candidates.push_back({hashBytes(std::as_bytes(std::span(corner)), seed), part, tile});
            }
    std::ranges::sort(candidates, {}, [](const Candidate &candidate) {
        return std::tuple(candidate.rank, candidate.tile.y0, candidate.tile.x0);
    });
    return candidates;
}

std::optional<AuditFinding> compareTile(const Candidate &candidate, const Film &merged, const Film &again) {
    const FilmRecords there = recordsIn(merged, std::span(&candidate.tile, 1));
    const FilmRecords here = recordsIn(again, std::span(&candidate.tile, 1));
    AuditFinding finding{candidate.part, candidate.tile, 0, 0, 0};
    for (std::size_t i = 0; i < there.pixels.size(); ++i) {
        if (haveEqualBits(there, here, i))
            continue;
        if (finding.differingPixels++ == 0) {
            const auto width = static_cast<std::size_t>(candidate.tile.width());
            finding.x = candidate.tile.x0 + static_cast<int>(i % width);
            finding.y = candidate.tile.y0 + static_cast<int>(i / width);
        }
    }
    return finding.differingPixels > 0 ? std::optional(finding) : std::nullopt;
}

} // namespace

std::uint64_t auditSeed(const Merger &merged) {
    return hashBytes(std::as_bytes(std::span(merged.film().pixels)));
}

AuditResult audit(const Merger &merged, Backend &backend, const PreparedScene &scene, double share,
                  std::uint64_t seed, Observer &observer) {
    std::vector<Candidate> chosen = candidatesOf(merged, seed);
    const double wanted = std::ceil(share * static_cast<double>(chosen.size()));
    chosen.resize(std::clamp<std::size_t>(static_cast<std::size_t>(wanted),
                                          std::min<std::size_t>(1, chosen.size()), chosen.size()));
    std::vector<Crop> tiles;
    tiles.reserve(chosen.size());
    for (const Candidate &candidate : chosen)
        tiles.push_back(candidate.tile);
    const BackendResult again = unlessFailed(
        render(backend, scene.packed, scene.loaded.settings,
               filmOfSquares(scene.crop, tiles, merged.samplesPerPixel()), observer,
               {.name = "audit", .shareOfOthers = shareOutside(scene.crop, tiles), .keepsFirst = true}));
    AuditResult result{chosen.size(), {}};
    for (const Candidate &candidate : chosen)
        if (const std::optional<AuditFinding> finding = compareTile(candidate, merged.film(), again.film))
            result.findings.push_back(*finding);
    return result;
}

} // namespace hyalite::core
