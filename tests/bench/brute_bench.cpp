#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>

#include <array>

namespace hyalite::core::bench {

namespace {

constexpr std::size_t raysAPart = 1024; // one ray of so many goes past all triangles, which takes long

/// The reference renderer's tree against all triangles one by one, on all threads.
void measureTree(benchmark::State &state, Context &context) {
    Subject &subject = context.subject("cat_144k");
    const RaySet &set = subject.rays(RayKind::Primary);
    const PackedScene brute =
        packScene(subject.scene(), buildBvh(TreeKind::None, buildTriangles(subject.scene()), 1));
    std::vector<layout::RayRecord> someRays;
    std::vector<layout::HitRecord> someHits;
    for (std::size_t i = 0; i < set.rays.size(); i += raysAPart + 1) { // elsewhere in each block of pixels
        someRays.push_back(set.rays[i]);
        someHits.push_back(set.hits[i]);
    }
    std::vector<layout::HitRecord> hits(someRays.size());
    traceByReference(brute, set.goal, someRays, hits);
    if (const std::size_t count = countDifferences(hits, someHits); count > 0) {
        state.SkipWithError(fmt::format("{} of {} hits differ from brute force", count, hits.size()).c_str());
        return;
    }
    const double scale = static_cast<double>(set.rays.size()) / static_cast<double>(someRays.size());
    const Runner allBrute = [&] {
        return scale * timed([&] { traceByReference(brute, set.goal, someRays, hits); })();
    };
    const std::array<Rival, 1> rivals{Rival{"of brute force", allBrute}};
    std::vector<layout::HitRecord> allHits(set.rays.size());
    race(state, timed([&] { traceByReference(subject.packed(), set.goal, set.rays, allHits); }), rivals);
    state.counters["Mray/s"] = static_cast<double>(set.rays.size()) / 1e6 / state.counters["seconds"].value;
}

} // namespace

void registerBruteForce(Context &context) {
    addBenchmark("brute force/cat_144k primary/CPU reference", 3,
                 [&context](benchmark::State &state) { measureTree(state, context); });
}

} // namespace hyalite::core::bench
