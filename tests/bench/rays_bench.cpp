#include "shaders/embedded_kernels.h"
#include "tests/bench/meshes.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace hyalite::core {

/// trace_rays.comp by each kernel.
[[nodiscard]] std::span<const EmbeddedKernel> benchKernels();

namespace bench {

namespace {

gpu::RayKernel rayKernelOf(const gpu::KernelRow &row) {
    return {
        row,
        std::ranges::find(benchKernels(), gpu::moduleName("traceRays", row), &EmbeddedKernel::name)->words};
}

constexpr int iterationsOfStacks = 3; // slow, and steady too
constexpr int iterationsOfOthers = 9;

// The rounding of two programs decides otherwise at edges of triangles, and of the whole mesh; and no more than that.
constexpr double largestShareOfDisagreements = 1e-3;

using Hits = std::vector<layout::HitRecord>;

/// Embree on a set of rays, checked against the reference.
class EmbreeRival {
  public:
    EmbreeRival(Subject &subject, const RaySet &set) : set_(set), rays_(subject.embree(), set) {}

    /// Keeps the larger share of rays that the two disagree about. Returns what is wrong, or nothing.
    [[nodiscard]] std::string check() {
        Hits hits(set_.rays.size());
        for (const bool isByEights : {false, true}) {
            run(hits, isByEights);
            const double share = static_cast<double>(countDisagreements(set_.goal, set_.hits, hits)) /
                                 static_cast<double>(hits.size());
            shareOfDisagreements_ = std::max(shareOfDisagreements_, share);
        }
        if (shareOfDisagreements_ > largestShareOfDisagreements)
            return fmt::format("Embree differs in {:.3f} % of the rays", 100.0 * shareOfDisagreements_);
        return {};
    }

    [[nodiscard]] Runner oneByOne() {
        return timed([this] { run(scratch_, false); });
    }
    [[nodiscard]] Runner byEights() {
        return timed([this] { run(scratch_, true); });
    }
    [[nodiscard]] double shareOfDisagreements() const { return shareOfDisagreements_; }

  private:
    void run(Hits &hits, bool isByEights) const {
        if (isByEights)
            rays_.traceByEights(hits);
        else
            rays_.traceOneByOne(hits);
    }

    const RaySet &set_;
    EmbreeRays rays_;
    Hits scratch_ = Hits(set_.rays.size());
    double shareOfDisagreements_ = 0.0;
};

void raceRays(benchmark::State &state, const EmbreeRival &embree, std::size_t rayCount,
              const Runner &contestant, std::span<const Rival> rivals) {
    race(state, contestant, rivals);
    state.counters["Mray/s"] = static_cast<double>(rayCount) / 1e6 / state.counters["seconds"].value;
    state.counters["Embree differs"] = embree.shareOfDisagreements();
}

void raceWithEmbree(benchmark::State &state, EmbreeRival &embree, std::size_t rayCount,
                    const Runner &contestant) {
    const std::array<Rival, 2> rivals{Rival{"of Embree 1", embree.oneByOne()},
                                      Rival{"of Embree 8", embree.byEights()}};
    raceRays(state, embree, rayCount, contestant, rivals);
}

/// Calls measure(subject, set, embree) once Embree's hits are known to be right.
template <class Measure>
void withRays(benchmark::State &state, Context &context, const std::string &mesh, RayKind kind,
              const Measure &measure) {
    Subject &subject = context.subject(mesh);
    const RaySet &set = subject.rays(kind);
    EmbreeRival embree(subject, set);
    if (const std::string fault = embree.check(); !fault.empty())
        state.SkipWithError(fault.c_str());
    else
        measure(subject, set, embree);
}

void measureKernel(benchmark::State &state, Context &context, const std::string &mesh, RayKind kind,
                   const gpu::RayKernel &kernel) {
    withRays(state, context, mesh, kind, [&](Subject &subject, const RaySet &set, EmbreeRival &embree) {
        gpu::RayTracer tracer(subject.onDevice(kernel.row), kernel, set.goal, set.rays);
        tracer.run();
        if (const std::size_t count = countDifferences(tracer.hits(), set.hits); count > 0) {
            state.SkipWithError(
                fmt::format("{} of {} hits differ from the reference's", count, set.hits.size()).c_str());
            return;
        }
        raceWithEmbree(state, embree, set.rays.size(), timed([&] { tracer.run(); }));
    });
}

void measureReference(benchmark::State &state, Context &context, const std::string &mesh, RayKind kind) {
    withRays(state, context, mesh, kind, [&](Subject &subject, const RaySet &set, EmbreeRival &embree) {
        Hits hits(set.rays.size());
        const PackedScene &scene = subject.packed();
        raceWithEmbree(state, embree, set.rays.size(),
                       timed([&] { traceByReference(scene, set.goal, set.rays, hits); }));
    });
}

void measureEmbreeOneByOne(benchmark::State &state, Context &context, const std::string &mesh, RayKind kind) {
    withRays(state, context, mesh, kind, [&](Subject &, const RaySet &set, EmbreeRival &embree) {
        raceRays(state, embree, set.rays.size(), embree.oneByOne(), {});
    });
}

void measureEmbreeByEights(benchmark::State &state, Context &context, const std::string &mesh, RayKind kind) {
    withRays(state, context, mesh, kind, [&](Subject &, const RaySet &set, EmbreeRival &embree) {
        const std::array<Rival, 1> rivals{Rival{"of Embree 1", embree.oneByOne()}};
        raceRays(state, embree, set.rays.size(), embree.byEights(), rivals);
    });
}

} // namespace

void registerRays(Context &context) {
    for (const std::string &mesh : meshNames()) {
        for (const RayKind kind : rayKinds) {
            const std::string row = fmt::format("rays/{} {}/", mesh, nameOf(kind));
            addBenchmark(row + "Embree 1", iterationsOfOthers, [=, &context](benchmark::State &state) {
                measureEmbreeOneByOne(state, context, mesh, kind);
            });
            addBenchmark(row + "Embree 8", iterationsOfOthers, [=, &context](benchmark::State &state) {
                measureEmbreeByEights(state, context, mesh, kind);
            });
            for (const gpu::KernelRow &kernel : gpu::kernelTable)
                addBenchmark(row + std::string(kernel.name),
                             kernel.hasStack ? iterationsOfStacks : iterationsOfOthers,
                             [=, &context, &kernel](benchmark::State &state) {
                                 measureKernel(state, context, mesh, kind, rayKernelOf(kernel));
                             });
            addBenchmark(row + "CPU reference", iterationsOfOthers, [=, &context](benchmark::State &state) {
                measureReference(state, context, mesh, kind);
            });
        }
    }
}

} // namespace bench
} // namespace hyalite::core
