#include "host/view/scene_text.h"

#include "host/base/json_document.h"
#include "host/base/json_text.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"
#include "host/lab/scene_summary_json.h"
#include "host/scene/names.h"

namespace hyalite::core {

std::string sceneWithCamera(const PreparedScene &scene) {
    const LoadedScene &loaded = scene.loaded;
    if (isStandardStream(loaded.file))
        throw Error(ErrorKind::BadInput,
                    "the scene came from standard input: it has no file to be stored beside");
    Camera moved = loaded.scene.camera;
    moved.position += loaded.scene.origin;
    const nlohmann::ordered_json camera = cameraToJson(moved);
    if (hasExtension(loaded.file, ".json")) {
        nlohmann::ordered_json json = readJsonFile(loaded.file);
        json["camera"] = camera;
        return jsonText(json);
    }
    nlohmann::ordered_json json{{"camera", camera}};
    if (loaded.isAutoLit)
        for (Light light : loaded.scene.lights) {
            light.position += loaded.scene.origin;
            json["lights"].push_back(lightToJson(light));
        }
    const glm::vec3 &background = loaded.scene.background;
    json["background"] = {background.x, background.y, background.z};
    json["meshes"] = {{{"file", loaded.file.filename().string()}}};
    json["settings"] = {{"integrator", nameOf(loaded.settings.integrator)},
                        {"spp", loaded.settings.samplesPerPixel}};
    return jsonText(json);
}

} // namespace hyalite::core
