#include "host/view/scene_text.h"

#include "host/base/json_document.h"
#include "host/base/json_text.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"
#include "host/scene/names.h"

#include <array>

namespace hyalite::core {

namespace {

nlohmann::ordered_json vectorJson(const glm::dvec3 &v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json cameraJson(const Camera &camera, const glm::dvec3 &origin) {
    nlohmann::ordered_json json{{"type", nameIn(cameraNames, camera.kind)},
                                {"position", vectorJson(camera.position + origin)},
                                {"direction", vectorJson(camera.direction)},
                                {"up", vectorJson(camera.up)}};
    if (camera.kind == CameraKind::Perspective) {
        json["horizontalFov"] = camera.horizontalFovDegrees;
        json["aperture"] = camera.aperture;
        json["focusDistance"] = camera.focusDistance;
    }
    if (camera.kind == CameraKind::Orthographic)
        json["viewWidth"] = camera.viewWidth;
    json["width"] = camera.width;
    json["height"] = camera.height;
    return json;
}

/// Those by which a bare mesh is lit.
nlohmann::ordered_json lightsJson(const Scene &scene) {
    nlohmann::ordered_json lights = nlohmann::ordered_json::array();
    for (const Light &light : scene.lights)
        lights.push_back({{"type", "point"},
                          {"position", vectorJson(light.position + scene.origin)},
                          {"power", vectorJson(light.power)}});
    return lights;
}

} // namespace

std::string sceneWithCamera(const PreparedScene &scene) {
    const LoadedScene &loaded = scene.loaded;
    if (isStandardStream(loaded.file))
        throw Error(ErrorKind::BadInput,
                    "the scene came from standard input: it has no file to be stored beside");
    const nlohmann::ordered_json camera = cameraJson(loaded.scene.camera, loaded.scene.origin);
    if (hasExtension(loaded.file, ".json")) {
        nlohmann::ordered_json json = readJsonFile(loaded.file);
        json["camera"] = camera;
        return jsonText(json);
    }
    nlohmann::ordered_json json{{"camera", camera}};
    if (loaded.isAutoLit)
        json["lights"] = lightsJson(loaded.scene);
    json["background"] = vectorJson(loaded.scene.background);
    json["meshes"] = {{{"file", loaded.file.filename().string()}}};
    json["settings"] = {{"integrator", nameOf(loaded.settings.integrator)},
                        {"spp", loaded.settings.samplesPerPixel}};
    return jsonText(json);
}

} // namespace hyalite::core
