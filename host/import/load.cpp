#include "host/import/load.h"

#include "host/base/error.h"
#include "host/import/assets.h"
#include "host/scene/framing.h"
#include "host/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hyalite {
namespace {

/// Throws Error{BadInput} if there is no such file. The message suggests the shipped scene of that name, if there is
/// one.
void requireFile(const std::filesystem::path &file) {
    std::error_code error;
    if (std::filesystem::exists(file, error) || error)
        return; // reading it reports the fault
    const std::vector<std::string> names = availableScenes();
    const std::string stem = file.stem().string();
    const bool isName = std::find(names.begin(), names.end(), stem) != names.end();
    throw Error(ErrorKind::BadInput,
                fmt::format("{}: there is no such file{}", file.string(),
                            isName ? fmt::format("; did you mean the shipped scene {}?", stem) : ""));
}

LoadedScene loadBareMesh(const std::filesystem::path &file, const LoadEvents &events) {
    if (events.onOutline)
        events.onOutline({true, RenderSettings{}});
    TextureLibrary textures;
    ObjMesh mesh = loadObj(file, {}, events.onReading, &textures);
    LoadedScene loaded;
    loaded.scene = frameMesh(std::move(mesh.mesh));
    // The neutral material comes first, for triangles without a material.
    loaded.scene.materials.insert(loaded.scene.materials.end(), mesh.materials.begin(), mesh.materials.end());
    loaded.scene.textures = textures.give();
    loaded.file = file;
    loaded.meshReports = {mesh.report};
    loaded.autoFramed = true;
    return loaded;
}

} // namespace

LoadedScene loadScene(const std::string &argument, const LoadEvents &events,
                      std::span<const std::filesystem::path> allowedPaths) {
    const std::filesystem::path file = resolveScene(argument);
    requireFile(file);
    LoadedScene loaded =
        hasExtension(file, ".obj") ? loadBareMesh(file, events) : loadSceneFile(file, events, allowedPaths);
    loaded.inputFiles.push_back(file.string());
    for (const MeshReport &report : loaded.meshReports)
        for (const std::filesystem::path &path : report.files)
            loaded.inputFiles.push_back(path.string());
    for (const Texture &texture : loaded.scene.textures)
        loaded.inputFiles.push_back(texture.name);
    validateScene(loaded.scene, file.string());
    return loaded;
}

} // namespace hyalite
