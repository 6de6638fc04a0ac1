#include "host/bvh/tree_statistics.h"
#include "host/import/obj.h"
#include "host/packing/skip_list.h"
#include "tests/bench/embree.h"
#include "tests/bench/meshes.h"
#include "tests/bench/parallel.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"
#include "tests/bench/tinyobj_alone.h"
#include "tests/fixtures/test_scene.h"

#include <fmt/format.h>
#include <omp.h>

#include <array>

namespace hyalite::core::bench {

namespace {

constexpr int iterations = 3;

/// What of a build is timed.
struct Build {
    const char *name;
    TreeKind tree;
    bool isOnOneThread;
    bool isPacked; ///< with all that makes of the tree what kernels read
};

const Build builds[] = {
    {"midpoint, 1 thread", TreeKind::Midpoint, true, false},
    {"midpoint", TreeKind::Midpoint, false, false},
    {"SAH, 1 thread", TreeKind::Sah, true, false},
    {"SAH", TreeKind::Sah, false, false},
    {"SAH, packed", TreeKind::Sah, false, true},
};

void buildOnce(const TestScene &scene, const Build &build) {
    Bvh bvh = buildBvh(build.tree, scene, scene.settings.leafSize);
    if (build.isPacked) {
        SkipList packed = makeSkipList(packScene(scene, bvh));
        benchmark::DoNotOptimize(packed);
    }
    benchmark::DoNotOptimize(bvh);
}

/// The threads that OpenMP uses while this object lives.
class OpenMpThreads {
  public:
    explicit OpenMpThreads(int count) : before_(omp_get_max_threads()) { omp_set_num_threads(count); }
    ~OpenMpThreads() { omp_set_num_threads(before_); }
    OpenMpThreads(const OpenMpThreads &) = delete;
    OpenMpThreads &operator=(const OpenMpThreads &) = delete;

  private:
    int before_;
};

void measureBuild(benchmark::State &state, Context &context, const std::string &mesh, const Build &build) {
    const Subject &subject = context.subject(mesh);
    const TestScene &scene = subject.scene();
    if (const std::string fault =
            findBvhFault(buildBvh(build.tree, scene, scene.settings.leafSize), buildTriangles(scene));
        !fault.empty()) {
        state.SkipWithError(fault.c_str());
        return;
    }
    EmbreeScene embree(subject.mesh(), build.isOnOneThread ? 1 : 0);
    const std::array<Rival, 1> rivals{Rival{"of Embree", timed([&] { embree.commit(); })}};
    const OpenMpThreads threads(build.isOnOneThread ? 1 : static_cast<int>(threadCount()));
    race(state, timed([&] { buildOnce(scene, build); }), rivals);
}

void measureEmbreeBuild(benchmark::State &state, Context &context, const std::string &mesh,
                        unsigned buildThreads) {
    EmbreeScene embree(context.subject(mesh).mesh(), buildThreads);
    embree.commit();
    race(state, timed([&] { embree.commit(); }), {});
}

void measureReading(benchmark::State &state, const std::string &mesh) {
    const std::filesystem::path file = meshFile(mesh);
    const std::size_t count = loadObj(file).mesh.triangles.size();
    if (const std::size_t theirs = countTrianglesByTinyObj(file); theirs != count) {
        state.SkipWithError(fmt::format("{} triangles, {} by tinyobjloader", count, theirs).c_str());
        return;
    }
    const std::array<Rival, 1> rivals{
        Rival{"of tinyobjloader", timed([&] { benchmark::DoNotOptimize(countTrianglesByTinyObj(file)); })}};
    race(state, timed([&] { benchmark::DoNotOptimize(loadObj(file)); }), rivals);
}

void measureTinyObj(benchmark::State &state, const std::string &mesh) {
    const std::filesystem::path file = meshFile(mesh);
    race(state, timed([&] { benchmark::DoNotOptimize(countTrianglesByTinyObj(file)); }), {});
}

} // namespace

void registerBuilding(Context &context) {
    for (const char *mesh : {"cat_144k", "noise_144k", "cat_1m"}) {
        const std::string row = fmt::format("trees/{}/", mesh);
        for (const Build &build : builds)
            addBenchmark(row + build.name, iterations, [=, &context](benchmark::State &state) {
                measureBuild(state, context, mesh, build);
            });
        addBenchmark(row + "Embree, 1 thread", iterations,
                     [=, &context](benchmark::State &state) { measureEmbreeBuild(state, context, mesh, 1); });
        addBenchmark(row + "Embree", iterations,
                     [=, &context](benchmark::State &state) { measureEmbreeBuild(state, context, mesh, 0); });
    }
}

void registerReading() {
    for (const char *mesh : {"cat_144k", "cat_1m"}) {
        const std::string row = fmt::format("reading/{}/", mesh);
        addBenchmark(row + "Hyalite", iterations,
                     [=](benchmark::State &state) { measureReading(state, mesh); });
        addBenchmark(row + "tinyobjloader", iterations,
                     [=](benchmark::State &state) { measureTinyObj(state, mesh); });
    }
}

} // namespace hyalite::core::bench
