#include "host/import/gltf/gltf.h"

#include "host/import/gltf/contents.h"
#include "host/import/neutral_environment.h"
#include "host/import/transform_json.h"
#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace hyalite::core {
namespace {

/// One place becomes a mesh in world space, more become instances.
void addMeshes(std::vector<PlacedMesh> &&meshes, Scene &scene) {
    for (PlacedMesh &placed : meshes) {
        if (placed.places.size() > 1) {
            std::vector<Placement> placements;
            std::ranges::transform(placed.places, std::back_inserter(placements), toPlacement);
            addInstances(scene, std::move(placed.mesh), placements, placed.nodes);
        } else {
            scene.meshes.push_back(placed.places.empty()
                                       ? std::move(placed.mesh)
                                       : transformed(std::move(placed.mesh), placed.places[0]));
            scene.meshes.back().node = placed.nodes.front();
        }
    }
}

void setCamera(const std::optional<gltf::PlacedCamera> &camera, LoadedScene &loaded) {
    Scene &scene = loaded.scene;
    if (camera) {
        scene.camera = camera->camera;
        loaded.verticalFovDegrees = camera->verticalFovDegrees;
        loaded.aspectRatio = camera->aspectRatio;
    } else if (scene.meshes.empty() && scene.instances.empty()) {
        loaded.warnings.push_back(fmt::format(
            "{}: the scene has no triangle and no camera: there is nothing to see", loaded.file.string()));
    } else {
        loaded.autoFramed = true;
        scene.camera = frameCamera(triangleBounds(scene, loaded.file.string()), scene.camera.width,
                                   scene.camera.height, defaultFovDegrees);
    }
}

} // namespace

LoadedScene loadGltf(const std::filesystem::path &file, const LoadOptions &options) {
    LoadedScene loaded;
    loaded.file = file;
    Scene &scene = loaded.scene;
    loaded.settings.integrator = Integrator::Path;
    loaded.settings.tree = TreeKind::Sah; // triangles of models differ in size, which midpoints do not see
    if (options.events.onOutline)
        options.events.onOutline({true, loaded.settings});
    TextureLibrary textures;
    gltf::Contents contents = gltf::readContents(file, FileAccess(file, options.allowedPaths), textures,
                                                 {.scene = options.gltfScene,
                                                  .camera = options.camera,
                                                  .timeSeconds = options.timeSeconds,
                                                  .sequence = options.sequence,
                                                  .onReading = options.events.onReading});
    // The neutral material comes first, for triangles without a material.
    scene.materials = {neutralMaterial(false)};
    std::ranges::move(contents.file.materials, std::back_inserter(scene.materials));
    scene.textures = textures.give();
    scene.lights = std::move(contents.lights);
    scene.profiles = std::move(contents.profiles);
    scene.nodes = std::move(contents.file.nodes);
    addMeshes(std::move(contents.file.meshes), scene);
    setCamera(contents.camera, loaded);
    loaded.worldUp = {0.0, 1.0, 0.0};
    loaded.cameraPath = std::move(contents.cameraPath);
    loaded.outline = std::move(contents.outline);
    loaded.movesByTime = contents.movesByTime;
    loaded.restOrigin = contents.restOrigin;
    if (contents.environment)
        scene.environment.radiance = std::move(*contents.environment);
    else if (scene.lights.empty())
        scene.environment.radiance = neutralEnvironment();
    loaded.meshReports.push_back(std::move(contents.file.report));
    return loaded;
}

MeshFile readGltfMeshes(const std::filesystem::path &file, const MeshOptions &options) {
    TextureLibrary unused;
    gltf::Contents contents =
        gltf::readContents(file, options.access, options.textures != nullptr ? *options.textures : unused,
                           {.onReading = options.onReading});
    MeshFile &meshes = contents.file;
    if (contents.camera || !contents.lights.empty() || contents.environment)
        meshes.report.warnings.push_back(
            fmt::format("{}: its cameras and lights are left out, as the scene file "
                        "has its own",
                        file.string()));
    const glm::dmat4x3 map = mapOf(options.transform);
    for (PlacedMesh &placed : meshes.meshes) {
        for (glm::dmat4x3 &place : placed.places)
            place = composed(map, place);
        if (placed.places.empty())
            placed.mesh = transformed(std::move(placed.mesh), map);
        else if (placed.places.size() == 1) {
            placed.mesh = transformed(std::move(placed.mesh), placed.places[0]);
            placed.places.clear();
        }
        if (options.textures == nullptr) {
            placed.mesh.triangleMaterials.clear();
            placed.mesh.materialIndex = 0;
        }
    }
    if (options.textures == nullptr)
        meshes.materials.clear();
    return std::move(contents.file);
}

} // namespace hyalite::core
