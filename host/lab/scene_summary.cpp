#include "host/lab/scene_summary.h"

#include "host/bvh/duplicates.h"
#include "host/scene/instances.h"
#include "host/scene/names.h"
#include "host/scene/scene_nodes.h"

#include <algorithm>
#include <map>
#include <set>

namespace hyalite::core {

namespace {

/// In the coordinates of the file.
glm::dvec3 ofFile(const Scene &scene, const glm::dvec3 &point) {
    return scene.origin == glm::dvec3(0.0) ? point : point + scene.origin; // -0 stays
}

std::optional<Bounds> ofFile(const Scene &scene, const Bounds &bounds) {
    if (!(bounds.low.x <= bounds.high.x))
        return std::nullopt;
    return Bounds{ofFile(scene, bounds.low), ofFile(scene, bounds.high)};
}

void addBounds(const Scene &scene, SceneSummary &summary) {
    const SceneBounds bounds = sceneBounds(scene);
    summary.bounds = ofFile(scene, bounds.all);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        summary.nodes.push_back({scene.nodes[i], ofFile(scene, bounds.nodes[i])});
}

void addLight(const Scene &scene, SceneSummary &summary) {
    summary.lights = scene.lights;
    for (Light &light : summary.lights)
        light.position = ofFile(scene, light.position);
    for (const LightProfile &profile : scene.profiles)
        summary.profiles.push_back(
            {profile.name, profile.gammas.size(), profile.planes.size(), profile.candela, lumensOf(profile)});
    summary.background = scene.background;
    if (const Image &sky = scene.environment.radiance; !sky.pixels().empty())
        summary.environment = EnvironmentSummary{sky.width(), sky.height(), scene.environment.scale,
                                                 scene.environment.rotateDegrees};
}

void countUses(const Scene &scene, std::vector<MaterialSummary> &materials) {
    std::vector<std::uint64_t> places(scene.prototypes.size(), 0);
    for (const Instance &instance : scene.instances)
        ++places[instance.prototype];
    const auto add = [&](const TriangleMesh &mesh, std::uint64_t times) {
        if (mesh.triangleMaterials.empty())
            materials[mesh.materialIndex].triangleCount += times * mesh.triangles.size();
        for (const std::uint32_t material : mesh.triangleMaterials)
            materials[material].triangleCount += times;
    };
    for (const TriangleMesh &mesh : scene.meshes)
        add(mesh, 1);
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
        add(scene.prototypes[i], places[i]);
    for (const Sphere &sphere : scene.spheres)
        ++materials[sphere.materialIndex].sphereCount;
}

void addMaterials(const Scene &scene, SceneSummary &summary) {
    for (const Material &material : scene.materials) {
        MaterialSummary &row = summary.materials.emplace_back();
        row.name = material.name;
        row.kind = material.kind;
        row.emission = material.emission;
        row.isTwoSided = material.twoSided;
        for (const auto &[key, slot, help] : textureSlots)
            if (const std::optional<TextureUse> &use = material.textures[slot])
                row.textures.emplace_back(key, scene.textures[use->textureIndex].name);
    }
    countUses(scene, summary.materials);
}

/// Shapes and meshes of files alike, by name.
void addShapes(const Scene &scene, SceneSummary &summary) {
    std::map<std::string_view, std::size_t> shapes;
    for (const auto &entry : shapeNames) {
        const std::string_view name = entry.first;
        const auto isShape = [&](const TriangleMesh &mesh) { return mesh.name == name; };
        const auto count =
            std::ranges::count_if(scene.meshes, isShape) + std::ranges::count_if(scene.prototypes, isShape);
        if (count > 0)
            shapes.emplace(name, static_cast<std::size_t>(count));
    }
    summary.shapes.assign(shapes.begin(), shapes.end());
}

void addTree(const PreparedScene &prepared, SceneSummary &summary) {
    if (prepared.bvh.nodes.empty())
        return;
    const Scene &scene = prepared.loaded.scene;
    std::vector<BuildTriangle> distinct = buildTriangles(scene);
    dropDuplicates(scene, distinct);
    const std::size_t droppedCount = triangleCount(scene) - distinct.size();
    summary.tree = TreeSummary{measureBvh(prepared.bvh), droppedCount,
                               findBvhFault(prepared.bvh, buildItems(scene), droppedCount)};
}

void addMemory(const PackedScene &packed, SceneSummary &summary) {
    summary.nodeBytes = packed.nodes.size() * sizeof(layout::NodePair);
    summary.triangleBytes = packed.triangles.size() * sizeof(layout::TriangleRecord);
    summary.normalBytes = packed.normals.size() * sizeof(layout::NormalRecord);
    summary.sceneBytes = packed.sizeBytes();
}

} // namespace

SceneSummary summariseScene(const PreparedScene &prepared) {
    const LoadedScene &loaded = prepared.loaded;
    const Scene &scene = loaded.scene;
    SceneSummary summary;
    summary.file = loaded.file.string();
    std::set<std::string_view> files; // a mesh is named by itself and by its report
    for (const std::string &file : loaded.inputFiles)
        if (files.insert(file).second)
            summary.inputFiles.push_back(file);
    summary.contentHash = prepared.contentHash();
    summary.triangleCount = inputOrder(scene).triangleCount;
    summary.sphereCount = scene.spheres.size();
    summary.origin = scene.origin;
    addBounds(scene, summary);
    summary.camera = scene.camera;
    summary.camera.position = ofFile(scene, scene.camera.position);
    addLight(scene, summary);
    addMaterials(scene, summary);
    addShapes(scene, summary);
    summary.arrangement = prepared.arrangement;
    summary.outline = loaded.outline;
    summary.meshes = loaded.meshReports;
    summary.settings = loaded.settings;
    addTree(prepared, summary);
    addMemory(prepared.packed, summary);
    summary.loadSeconds = prepared.loadSeconds;
    summary.buildSeconds = prepared.buildSeconds;
    return summary;
}

} // namespace hyalite::core
