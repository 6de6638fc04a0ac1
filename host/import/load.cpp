#include "host/import/load.h"

#include "host/base/error.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"
#include "host/import/file_access.h"
#include "host/import/formats.h"
#include "host/import/scene_json.h"
#include "host/import/texture_library.h"
#include "host/scene/framing.h"
#include "host/scene/light_sources.h"
#include "host/scene/origin.h"
#include "host/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

/// Throws Error{BadInput} if there is no such file. The message suggests the shipped scene of that name, if there is
/// one.
void requireFile(const std::filesystem::path &file) {
    std::error_code error;
    if (isStandardStream(file) || std::filesystem::exists(file, error) || error)
        return; // reading it reports the fault
    const std::vector<std::string> names = availableScenes();
    const std::string stem = file.stem().string();
    const bool isName = std::find(names.begin(), names.end(), stem) != names.end();
    throw Error(ErrorKind::BadInput,
                fmt::format("{}: there is no such file{}", file.string(),
                            isName ? fmt::format("; did you mean the shipped scene {}?", stem) : ""));
}

/// One mesh of all that the file has, framed and lit.
LoadedScene loadBareMesh(const std::filesystem::path &file, const Format &format,
                         const LoadOptions &options) {
    if (options.events.onOutline)
        options.events.onOutline({true, RenderSettings{}});
    TextureLibrary textures;
    const FileAccess access(file, options.allowedPaths);
    MeshFile meshes = format.readMeshes(
        file, {.onReading = options.events.onReading, .textures = &textures, .access = access});
    LoadedScene loaded;
    loaded.scene = frameMesh(std::move(meshes.meshes.front().mesh));
    loaded.scene.nodes.push_back({.name = file.filename().string(), .kind = NodeKind::Mesh});
    loaded.scene.meshes.front().node = 0;
    // The neutral material comes first, for triangles without a material.
    std::ranges::move(meshes.materials, std::back_inserter(loaded.scene.materials));
    loaded.scene.textures = textures.give();
    loaded.file = file;
    loaded.meshReports = {std::move(meshes.report)};
    loaded.autoFramed = true;
    loaded.isAutoLit = true;
    return loaded;
}

/// Throws Error{Usage} for choices that a file or document of another format than glTF does not offer.
void requireNoChoices(const LoadOptions &options, const std::filesystem::path &file) {
    const auto refuse = [&](std::string_view what) {
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: {}; glTF files have (.gltf, .glb)", file.string(), what));
    };
    if (!options.camera.empty())
        refuse("this format has no cameras to choose from");
    if (!options.gltfScene.empty())
        refuse("this format has no scenes to choose from");
    const auto &sequence = options.sequence;
    if (options.timeSeconds || (sequence && sequence->framesPerSecond && !sequence->isOfClip))
        refuse("this format has no animations");
}

bool hasTriangles(const Scene &scene) { return triangleCount(scene) > 0 || !scene.instances.empty(); }

/// Gives the scene the camera of a bare mesh, and its lights if nothing shines.
void frame(LoadedScene &loaded) {
    Scene &scene = loaded.scene;
    moveNear(scene, loaded.cameraPath);
    const Bounds bounds = triangleBounds(scene, loaded.file.string());
    scene.camera = frameCamera(bounds, scene.camera.width, scene.camera.height, defaultFovDegrees);
    loaded.autoFramed = true;
    const LightSources sources = lightSourcesOf(scene);
    loaded.isAutoLit = !sources.hasLights && !sources.hasEmitters && !sources.hasEnvironment;
    if (loaded.isAutoLit) {
        scene.lights = frameLights(bounds, {0.0, 1.0, 0.0}, scene.camera.position);
        scene.background = frameBackground;
    }
}

/// Gives the scene its origin, and validates it.
LoadedScene finished(LoadedScene loaded) {
    for (const MeshReport &report : loaded.meshReports)
        for (const std::filesystem::path &path : report.files)
            loaded.inputFiles.push_back(path.string());
    for (const Texture &texture : loaded.scene.textures)
        loaded.inputFiles.push_back(texture.name);
    for (const LightProfile &profile : loaded.scene.profiles)
        loaded.inputFiles.push_back(profile.name);
    moveNear(loaded.scene, loaded.cameraPath, loaded.restOrigin);
    validateScene(loaded.scene, loaded.file.string());
    validateSettings(loaded.settings, loaded.scene, loaded.file.string());
    return loaded;
}

} // namespace

LoadedScene loadScene(const std::string &argument, const LoadOptions &options) {
    const std::filesystem::path file = resolveScene(argument);
    requireFile(file);
    const Format &format = *formatOf(file);
    if (!format.hasChoices)
        requireNoChoices(options, file);
    LoadedScene loaded =
        format.readScene != nullptr ? format.readScene(file, options) : loadBareMesh(file, format, options);
    loaded.inputFiles.push_back(file.string());
    return finished(std::move(loaded));
}

LoadedScene loadScene(const SceneDocument &document, const LoadOptions &options) {
    requireNoChoices(options, document.file);
    LoadedScene loaded = loadSceneDocument(document, options);
    if (document.isFramed && hasTriangles(loaded.scene))
        frame(loaded);
    return finished(std::move(loaded));
}

} // namespace hyalite::core
