#include "host/cli/inspect_scene.h"

#include "host/base/clean_text.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::size_t maxRows = GltfOutline::maxRows;

template <class Vector> std::string vectorText(const Vector &v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

/// One number for grey.
template <class Vector> std::string colourText(const Vector &colour) {
    return colour.x == colour.y && colour.y == colour.z ? fmt::format("{:.6g}", colour.x)
                                                        : vectorText(colour);
}

/// Calls print(i) for the first rows, and says how many are left.
template <class Print> void printRows(std::size_t count, const std::string &what, const Print &print) {
    for (std::size_t i = 0; i < std::min(count, maxRows); ++i)
        print(i);
    if (count > maxRows)
        printResult("             and {} more {}\n", count - maxRows, what);
}

/// A point in the coordinates of the file: of scenes far from zero with all digits that differ.
std::string pointText(const SceneSummary &summary, const glm::dvec3 &point) {
    if (summary.origin == glm::dvec3(0.0))
        return vectorText(point);
    return fmt::format("({:.12g}, {:.12g}, {:.12g})", point.x, point.y, point.z);
}

void printBounds(const SceneSummary &summary) {
    if (summary.bounds)
        printResult("bounds       {} to {}\n", pointText(summary, summary.bounds->low),
                    pointText(summary, summary.bounds->high));
    if (summary.origin != glm::dvec3(0.0))
        printResult("origin       {}: far from zero, so that coordinates are read relative to it\n",
                    pointText(summary, summary.origin));
}

void printCamera(const SceneSummary &summary) {
    const Camera &camera = summary.camera;
    std::string lens;
    if (camera.kind == CameraKind::Perspective)
        lens = fmt::format(", {:.6g} degrees wide", camera.horizontalFovDegrees);
    if (camera.kind == CameraKind::Orthographic)
        lens = fmt::format(", {:.6g} wide", camera.viewWidth);
    if (camera.kind == CameraKind::Perspective && camera.aperture > 0.0)
        lens += fmt::format(", aperture {:.6g} in focus at {:.6g}", camera.aperture, camera.focusDistance);
    printResult("camera       {} at {}, looks along {}, up is {}{}; {}x{} pixels\n",
                nameIn(cameraNames, camera.kind), pointText(summary, camera.position),
                vectorText(camera.direction), vectorText(camera.up), lens, camera.width, camera.height);
}

void printLight(const SceneSummary &summary, const Light &light) {
    const std::string_view kind = nameIn(lightNames, light.kind);
    if (light.kind == LightKind::Directional)
        printResult("light        {} along {}, irradiance {}\n", kind, vectorText(light.direction),
                    colourText(light.power));
    else if (light.kind == LightKind::Spot)
        printResult("light        {} at {} along {}, {:.6g} degrees, power {}\n", kind,
                    pointText(summary, light.position), vectorText(light.direction), light.angleDegrees,
                    colourText(light.power));
    else
        printResult("light        {} at {}{}, power {}\n", kind, pointText(summary, light.position),
                    light.profile ? " along " + vectorText(light.direction) : "", colourText(light.power));
    if (light.profile)
        printResult("             profile {}, C = 0 along {}\n",
                    cleanText(summary.profiles[*light.profile].file), vectorText(light.c0));
}

void printProfile(const ProfileSummary &profile) {
    printResult("profile      {}: {} angles gamma, {} C, {:.6g} cd at most, {:.6g} lm\n",
                cleanText(profile.file), profile.gammaCount, profile.planeCount, profile.candela,
                profile.lumens);
}

std::string useText(const MaterialSummary &material) {
    std::string text;
    if (material.sphereCount > 0)
        text = countText(material.sphereCount, "sphere");
    if (material.triangleCount > 0)
        text += (text.empty() ? "" : " and ") + countText(material.triangleCount, "triangle");
    return text.empty() ? "nothing" : text;
}

void printMaterial(const MaterialSummary &material) {
    std::string textures;
    for (const auto &[key, file] : material.textures)
        textures += fmt::format("{}{} {}", textures.empty() ? "; textures: " : ", ", key, file);
    printResult("material     {}\n",
                cleanText(fmt::format("\"{}\": {}, on {}{}", material.name,
                                      nameIn(materialNames, material.kind), useText(material), textures)));
}

void printEmitters(const std::vector<MaterialSummary> &materials) {
    std::vector<std::size_t> emitters;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (materials[i].emits())
            emitters.push_back(i);
    printRows(emitters.size(), "emitters", [&](std::size_t i) {
        const MaterialSummary &material = materials[emitters[i]];
        printResult("emitter      {}\n",
                    cleanText(fmt::format("\"{}\": {} of radiance {}{}", material.name, useText(material),
                                          colourText(material.emission),
                                          material.isTwoSided ? ", on both sides" : "")));
    });
}

void printShapes(const SceneSummary &summary) {
    std::string text;
    for (const auto &[name, count] : summary.shapes)
        text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", name, count);
    if (!text.empty())
        printResult("shapes       {}\n", text);
    const auto &[instanceCount, prototypeCount, flattenedCount] = summary.arrangement;
    if (instanceCount > 0)
        printResult("instances    {} of {}: {} flattened, to meshes of their own\n",
                    countText(instanceCount, "place"), countText(prototypeCount, "mesh", "meshes"),
                    flattenedCount == instanceCount ? "all"
                    : flattenedCount == 0           ? "none"
                                                    : fmt::to_string(flattenedCount));
}

std::string quoted(const std::string &name) {
    return name.empty() ? "" : fmt::format(" \"{}\"", excerpt(name));
}

/// The cameras and nodes of a glTF file.
void printOutline(const GltfOutline &outline) {
    printRows(outline.cameraCount, "cameras of the file", [&](std::size_t i) {
        const GltfOutline::CameraRow &camera = outline.cameras[i];
        fmt::print("of the file  camera {}{}: {}\n", i, quoted(camera.name), excerpt(camera.type));
    });
    printRows(outline.nodeCount, "nodes of the file", [&](std::size_t i) {
        const GltfOutline::NodeRow &node = outline.nodes[i];
        constexpr std::size_t maxIndent = 16; // levels; a hostile tree is a million deep
        fmt::print("of the file  {:{}}node {}{}{}\n", "", 2 * std::min(node.depth, maxIndent), node.index,
                   quoted(node.name), node.contents.empty() ? "" : ": " + excerpt(node.contents));
    });
}

void printMesh(const MeshReport &report) {
    printResult("mesh         {}: {}, {}, {}\n", report.name, countText(report.triangleCount, "triangle"),
                countText(report.vertexCount, "vertex", "vertices"), countText(report.normalCount, "normal"));
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
    printResult("  repaired   {}\n",
                countText(report.lostNormalCount, "triangle without usable normals gets the geometric one",
                          "triangles without usable normals get the geometric one"));
}

void printTree(const TreeSummary &tree, const RenderSettings &settings) {
    const BvhStatistics &statistics = tree.statistics;
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
    if (tree.droppedCount > 0)
        printResult("  dropped    {} with the corners and the material of one before\n",
                    countText(tree.droppedCount, "triangle"));
    printResult("  SAH cost   {:.2f}\n", statistics.sahCost);
    printResult("  check      {}\n", tree.fault.empty()
                                         ? "every triangle in one leaf, every box encloses its subtree"
                                         : tree.fault);
}

/// "sphere 3 of "gold"", "node 17 "Wheel" of car.glb, instance 2".
std::string objectText(const ObjectCoverage &object) {
    if (object.sphere)
        return fmt::format("sphere {} of \"{}\"", *object.sphere, object.material);
    const SceneNode &node = object.node;
    std::string text = node.kind == NodeKind::Mesh ? "mesh " + node.name
                       : node.kind == NodeKind::Shape
                           ? fmt::format("shape {} {}", node.index, node.name)
                           : fmt::format("node {}{}", node.index, quoted(node.name));
    if (!node.mesh.empty())
        text += fmt::format(", mesh{}", quoted(node.mesh));
    if (!object.file.empty())
        text += " of " + object.file;
    if (object.instance)
        text += fmt::format(", instance {}", *object.instance);
    return text;
}

} // namespace

void printSummary(const SceneSummary &summary) {
    printResult("scene        {}\n", summary.file);
    printResult("contents     {} in {}, {}, {}, {}\n", countText(summary.triangleCount, "triangle"),
                countText(summary.meshes.size(), "mesh", "meshes"), countText(summary.sphereCount, "sphere"),
                countText(summary.lights.size(), "light"), countText(summary.materials.size(), "material"));
    printBounds(summary);
    printCamera(summary);
    printRows(summary.lights.size(), "lights",
              [&](std::size_t i) { printLight(summary, summary.lights[i]); });
    printRows(summary.profiles.size(), "profiles", [&](std::size_t i) { printProfile(summary.profiles[i]); });
    printEmitters(summary.materials);
    if (const std::optional<EnvironmentSummary> &sky = summary.environment)
        printResult("environment  {}x{} pixels, scale {:.6g}, turned {:.6g} degrees\n", sky->width,
                    sky->height, sky->scale, sky->rotateDegrees);
    else
        printResult("background   {}\n", colourText(summary.background));
    printRows(summary.materials.size(), "materials",
              [&](std::size_t i) { printMaterial(summary.materials[i]); });
    printShapes(summary);
    if (summary.outline)
        printOutline(*summary.outline);
    for (const MeshReport &report : summary.meshes)
        printMesh(report);
    if (summary.tree)
        printTree(*summary.tree, summary.settings);
    printResult("memory       {} bytes of nodes, {} of triangles, {} of normals, {} of the scene in all\n",
                summary.nodeBytes, summary.triangleBytes, summary.normalBytes, summary.sceneBytes);
    printResult("time         {:.3f} s to load, {:.3f} s to build and pack\n", summary.loadSeconds,
                summary.buildSeconds);
}

void printCoverage(const Coverage &coverage) {
    printResult("coverage     {:.2f} % of {} see the background\n",
                100.0 * coverage.shareOf(coverage.backgroundCount), countText(coverage.pixelCount, "pixel"));
    const auto printRow = [&](std::string_view what, const std::string &name, const CoveredPixels &pixels) {
        printResult("  {:<9}{:6.2f} % {}, at x {} to {}, y {} to {}\n", what,
                    100.0 * coverage.shareOf(pixels.pixelCount), name, pixels.box.x0, pixels.box.x1,
                    pixels.box.y0, pixels.box.y1);
    };
    printRows(coverage.objects.size(), "objects", [&](std::size_t i) {
        printRow("object", objectText(coverage.objects[i]), coverage.objects[i].pixels);
    });
    printRows(coverage.materials.size(), "materials", [&](std::size_t i) {
        printRow("material", fmt::format("\"{}\"", coverage.materials[i].name), coverage.materials[i].pixels);
    });
    if (coverage.unseenCount > 0)
        printResult("  unseen     {}\n", countText(coverage.unseenCount, "object"));
}

void printTreeCheck(const TreeCheck &check) {
    const double rays = check.rayCount;
    printResult("rays         {} on one thread of the reference renderer\n",
                countText(static_cast<std::uint64_t>(check.rayCount), "primary ray"));
    if (check.hasTree)
        printResult("  tree       {:.3f} us a ray\n", check.treeSeconds / rays * 1e6);
    printResult("  brute      {:.3f} us a ray{}\n", check.bruteSeconds / rays * 1e6,
                check.hasTree ? fmt::format(": the tree is {:.1f} times as fast",
                                            check.bruteSeconds / check.treeSeconds)
                              : "");
    printResult("  hits       {} of {} differ\n", check.differenceCount, check.rayCount);
}

} // namespace hyalite::core
