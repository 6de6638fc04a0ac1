#include "host/base/error.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/bvh/duplicates.h"
#include "host/bvh/tree_statistics.h"
#include "host/cli/commands.h"
#include "host/cli/inspect_scene.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/cli/terminal_observer.h"
#include "host/reference/closest_hit.h"
#include "host/scene/instances.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace hyalite::core {

namespace {

struct InspectOptions {
    SceneOptions scene;
    int rayCount = 0;
};

using Clock = std::chrono::steady_clock;

void printMeshes(const PreparedScene &prepared) {
    for (const MeshReport &report : prepared.loaded.meshReports) {
        printResult("mesh         {}: {}, {}, {}\n", report.name, countText(report.triangleCount, "triangle"),
                    countText(report.vertexCount, "vertex", "vertices"),
                    countText(report.normalCount, "normal"));
        if (report.instanceCount > 0)
            printResult("  placed     {}\n", countText(report.instanceCount, "time"));
        printResult("  faces      {}, {} of them polygons of more than three corners\n", report.faceCount,
                    report.polygonCount);
        printResult("  dropped    {}, {}\n", countText(report.degenerateTriangleCount, "degenerate triangle"),
                    countText(report.unusedStatementCount, "statement that is not geometry",
                              "statements that are not geometry"));
        for (const std::string &library : report.lostLibraries)
            printResult("  not read   {}: no such material library in the mesh's folder\n", library);
        if (report.unknownMaterialCount > 0)
            printResult("  neutral    {}\n",
                        countText(report.unknownMaterialCount, "material that no library has",
                                  "materials that no library has"));
        printResult("  repaired   {}\n", countText(report.lostNormalCount,
                                                   "triangle without usable normals gets the geometric one",
                                                   "triangles without usable normals get the geometric one"));
    }
}

void printTree(const PreparedScene &prepared, std::size_t droppedCount, const std::string &fault) {
    const RenderSettings &settings = prepared.loaded.settings;
    const BvhStatistics statistics = measureBvh(prepared.bvh);
    printResult("tree         {}, leaf size {}\n", nameOf(settings.tree), settings.leafSize);
    printResult("  nodes      {} inner, {}, depth {}\n", statistics.innerCount,
                countText(statistics.leafCount, "leaf", "leaves"), statistics.depth);
    printResult("  leaves     mean {:.2f}, largest {}\n", statistics.meanLeaf,
                countText(statistics.largestLeaf, "triangle"));
    std::string histogram;
    for (std::size_t i = 0; i < statistics.leafHistogram.size(); ++i) {
        const bool isLast = i + 1 == statistics.leafHistogram.size();
        if (statistics.leafHistogram[i] > 0)
            histogram += fmt::format("  {}{}: {}", isLast ? ">" : "<=", 1u << (isLast ? i - 1 : i),
                                     statistics.leafHistogram[i]);
    }
    printResult("  histogram{}\n", histogram);
    if (droppedCount > 0)
        printResult("  dropped    {} with the corners and the material of one before\n",
                    countText(droppedCount, "triangle"));
    printResult("  SAH cost   {:.2f}\n", statistics.sahCost);
    printResult("  check      {}\n",
                fault.empty() ? "every triangle in one leaf, every box encloses its subtree" : fault);
}

void printCosts(const PreparedScene &prepared) {
    printResult("memory       {} bytes of nodes, {} of triangles, {} of normals, {} of the scene in all\n",
                prepared.packed.nodes.size() * sizeof(layout::NodePair),
                prepared.packed.triangles.size() * sizeof(layout::TriangleRecord),
                prepared.packed.normals.size() * sizeof(layout::NormalRecord), prepared.packed.sizeBytes());
    printResult("time         {:.3f} s to load, {:.3f} s to build and pack\n", prepared.loadSeconds,
                prepared.buildSeconds);
}

/// Traces primary rays spread over the image. Returns the hits; `seconds` gets the time.
std::vector<reference::Hit<float>> traceRays(const PackedScene &scene, int count, double &seconds) {
    std::vector<reference::Hit<float>> hits;
    const reference::SceneView<float> view(scene, layout::samplerCentre);
    hits.reserve(static_cast<std::size_t>(count));
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < count; ++i) {
        const std::uint32_t index = static_cast<std::uint32_t>(i);
        // The golden ratio's low-discrepancy sequence spreads any number of rays evenly.
        const std::uint64_t pixelCount = std::uint64_t{scene.frame.imageWidth} * scene.frame.imageHeight;
        const std::uint64_t position = (std::uint64_t{index * 2654435769u} * pixelCount) >> 32;
        const glm::uvec2 pixel(static_cast<std::uint32_t>(position % scene.frame.imageWidth),
                               static_cast<std::uint32_t>(position / scene.frame.imageWidth));
        const auto primary = reference::primaryRay(view, pixel, 0);
        hits.push_back(
            reference::closestHit(scene, reference::Ray<float>{primary.origin, primary.direction}));
    }
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return hits;
}

/// Compares the tree with a test of all triangles, with the same rays on one thread of the reference renderer.
bool compareWithBruteForce(const PreparedScene &prepared, int rayCount) {
    const Scene &scene = prepared.loaded.scene;
    Scene flattened = scene;
    arrangeInstances(flattened, Flattening::All);
    const PackedScene brute = packScene(flattened, buildBvh(TreeKind::None, buildTriangles(flattened), 1));
    double treeSeconds = 0.0;
    double bruteSeconds = 0.0;
    const auto treeHits = traceRays(prepared.packed, rayCount, treeSeconds);
    const auto bruteHits = traceRays(brute, rayCount, bruteSeconds);
    const auto isSame = [](const reference::Hit<float> &a, const reference::Hit<float> &b) {
        return a.primitive == b.primitive && a.distance == b.distance && a.u == b.u && a.v == b.v;
    };
    std::size_t differenceCount = 0;
    for (std::size_t i = 0; i < treeHits.size(); ++i)
        differenceCount += isSame(treeHits[i], bruteHits[i]) ? 0u : 1u;
    const double rays = rayCount;
    printResult("rays         {} on one thread of the reference renderer\n",
                countText(static_cast<std::uint64_t>(rayCount), "primary ray"));
    const bool hasTree = prepared.bvh.depth > 0; // without a tree both are the same
    if (hasTree)
        printResult("  tree       {:.3f} us a ray\n", treeSeconds / rays * 1e6);
    printResult("  brute      {:.3f} us a ray{}\n", bruteSeconds / rays * 1e6,
                hasTree ? fmt::format(": the tree is {:.1f} times as fast", bruteSeconds / treeSeconds) : "");
    printResult("  hits       {} of {} differ\n", differenceCount, rayCount);
    return differenceCount == 0;
}

ExitCode runInspect(const InspectOptions &options) {
    TerminalObserver observer(false);
    const PreparedScene prepared = prepareScene(options.scene, Source::Kept, observer);
    const Scene &scene = prepared.loaded.scene;
    printResult("scene        {}\n", prepared.loaded.file.string());
    printResult("contents     {} in {}, {}, {}, {}\n", countText(inputOrder(scene).triangleCount, "triangle"),
                countText(prepared.loaded.meshReports.size(), "mesh", "meshes"),
                countText(scene.spheres.size(), "sphere"), countText(scene.lights.size(), "light"),
                countText(scene.materials.size(), "material"));
    printScene(prepared);
    if (prepared.loaded.outline)
        printOutline(*prepared.loaded.outline);
    printMeshes(prepared);
    std::vector<BuildTriangle> distinct = buildTriangles(scene);
    dropDuplicates(scene, distinct);
    const std::size_t droppedCount = triangleCount(scene) - distinct.size();
    const std::string fault = findBvhFault(prepared.bvh, buildItems(scene), droppedCount);
    if (!prepared.bvh.nodes.empty())
        printTree(prepared, droppedCount, fault);
    printCosts(prepared);
    const bool isSame = options.rayCount == 0 || compareWithBruteForce(prepared, options.rayCount);
    return fault.empty() && isSame ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace

void addInspectCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("inspect", "print the contents of a scene or mesh, and its tree");
    const auto options = std::make_shared<InspectOptions>();
    addSceneOptions(*command, options->scene);
    addNumber(*command, "--rays", options->rayCount, limits::inspectedRays,
              "trace this many primary rays through the tree and by brute force; compare hits and times");
    command->callback([options, &context] { context.exitCode = runInspect(*options); });
}

} // namespace hyalite::core
