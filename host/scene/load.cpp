#include "host/scene/load.h"

#include "host/scene/assets.h"
#include "host/scene/framing.h"
#include "host/scene/validate.h"

#include <utility>

namespace hyalite {
namespace {

LoadedScene loadBareMesh(const std::filesystem::path &file) {
    ObjMesh mesh = loadObj(file);
    LoadedScene loaded;
    loaded.scene = frameMesh(std::move(mesh.mesh));
    loaded.file = file;
    loaded.meshReports = {mesh.report};
    loaded.autoFramed = true;
    return loaded;
}

} // namespace

LoadedScene loadScene(const std::string &argument) {
    const std::filesystem::path file = resolveScene(argument);
    LoadedScene loaded = hasExtension(file, ".obj") ? loadBareMesh(file) : loadSceneFile(file);
    validateScene(loaded.scene, file.string());
    return loaded;
}

} // namespace hyalite
