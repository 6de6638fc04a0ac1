#include "host/import/scene_json.h"

#include "host/base/json_document.h"
#include "host/base/json_reader.h"
#include "host/import/environment_file.h"
#include "host/import/file_access.h"
#include "host/import/profile_library.h"
#include "host/import/scene_objects.h"
#include "host/scene/light_groups.h"
#include "host/scene/light_sources.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>

namespace hyalite::core {
namespace {

using namespace std::string_view_literals;

glm::dvec3 readDirection(const JsonObject &object, std::string_view key, const glm::dvec3 &fallback) {
    const glm::dvec3 direction = object.vector(key, limits::coordinate, fallback);
    if (!limits::directionLength.contains(glm::length(direction)))
        object.at(key).fail(fmt::format("found length {}; allowed: a length {}", glm::length(direction),
                                        limits::directionLength.text()));
    return direction;
}

/// The pose of the camera. Missing keys leave it as it is.
void readPose(const JsonObject &object, Camera &camera) {
    camera.position = object.vector("position", limits::coordinate, camera.position);
    camera.direction = readDirection(object, "direction", camera.direction);
    camera.up = readDirection(object, "up", camera.up);
    camera.horizontalFovDegrees =
        object.number("horizontalFov", limits::horizontalFovDegrees, camera.horizontalFovDegrees);
    camera.aperture = object.number("aperture", limits::aperture, camera.aperture);
    camera.viewWidth = object.number("viewWidth", limits::viewWidth, camera.viewWidth);
    if (const std::optional<JsonNode> target = object.find("target")) {
        if (object.find("direction"))
            target->fail("found beside \"direction\"; allowed: one of the two");
        camera.direction = target->vector(limits::coordinate) - camera.position;
        if (!limits::directionLength.contains(glm::length(camera.direction)))
            target->fail("is the camera's own position; allowed: any other point");
        camera.focusDistance = std::min(glm::length(camera.direction), limits::focusDistance.high);
    }
    camera.focusDistance = object.number("focusDistance", limits::focusDistance, camera.focusDistance);
}

Camera readCamera(const JsonObject &object) {
    Camera camera;
    camera.kind = object.choice("type", cameraNames, camera.kind);
    readPose(object, camera);
    camera.width = object.integer("width", limits::imageSize, camera.width);
    camera.height = object.integer("height", limits::imageSize, camera.height);
    return camera;
}

/// `camera` is that of the object, whose values hold where a key gives none.
CameraPath readCameraPath(const JsonObject &object, const Camera &camera) {
    const std::optional<JsonObject> path = object.object("path", scene_keys::cameraPath);
    if (!path)
        return {};
    const KeyInterpolation interpolation =
        path->choice("interpolation", interpolationNames, KeyInterpolation::Smooth);
    const bool hasTarget = object.find("target").has_value();
    std::vector<CameraKey> keys;
    for (const JsonNode &node : path->elements("keys", limits::cameraKeyCount)) {
        const JsonObject key(node, scene_keys::cameraKey);
        const int frame = static_cast<int>(key.at("frame").wholeNumber(limits::frame));
        if (!keys.empty() && frame <= keys.back().frame)
            key.at("frame").refuse(
                fmt::format("a frame behind {}, that of the key before", keys.back().frame));
        Camera there = camera;
        if (hasTarget && !key.find("direction") && key.find("position")) {
            const glm::dvec3 target = camera.position + camera.direction;
            there.direction = target - key.vector("position", limits::coordinate);
            if (!object.find("focusDistance"))
                there.focusDistance = std::min(glm::length(there.direction), limits::focusDistance.high);
            if (!key.find("target") && !limits::directionLength.contains(glm::length(there.direction)))
                key.at("position").fail("is the camera's target; allowed: any other point");
        }
        readPose(key, there);
        keys.push_back({frame, poseOf(there)});
    }
    if (keys.empty())
        path->at("keys").refuse("at least one key");
    return pathThrough(keys, interpolation);
}

/// Empty without the key.
std::string readLightGroup(const JsonObject &object) {
    std::string name = object.text("lightGroup", "");
    if (object.find("lightGroup") && !isLightGroupName(name))
        object.at("lightGroup").refuse("1 to 32 letters, digits, underscores and hyphens");
    return name;
}

/// The files and the library for profiles of lights.
struct ProfileSource {
    const FileAccess &access;
    ProfileLibrary &library;
    std::vector<std::string> &warnings;
};

/// The profile of a light, and how it is turned.
void readProfile(const JsonObject &object, const ProfileSource &source, Light &light) {
    const std::optional<JsonNode> file = object.find("profile");
    if (!file) {
        for (const std::string_view key : {"c0"sv, "direction"sv})
            if (key == "c0" || light.kind == LightKind::Point)
                if (const std::optional<JsonNode> node = object.find(key))
                    node->fail("found without \"profile\"; allowed: beside one");
        return;
    }
    light.direction = readDirection(object, "direction", light.direction);
    light.c0 = readDirection(object, "c0", defaultC0(light.direction));
    if (isParallel(light.direction, light.c0))
        object.at("c0").fail("is the light's own direction; allowed: any other one");
    light.profile = source.library.load(source.access.resolve(*file), source.warnings);
}

Light readLight(const JsonNode &node, const ProfileSource &source) {
    const JsonObject object(node);
    if (const std::optional<JsonNode> type = object.find("type"); type && *type->value == "area")
        type->refuse("\"point\", \"spot\", \"directional\"; a light with a size is a sphere, shape or mesh "
                     "whose material "
                     "has \"emission\"");
    Light light;
    light.kind = object.choice("type", lightNames);
    switch (light.kind) {
    case LightKind::Point:
        object.allowOnly(scene_keys::pointLight);
        light.position = object.vector("position", limits::coordinate);
        light.power = object.colour("power", limits::power);
        readProfile(object, source, light);
        break;
    case LightKind::Spot:
        object.allowOnly(scene_keys::spotLight);
        light.position = object.vector("position", limits::coordinate);
        light.power = object.colour("power", limits::power);
        light.direction = readDirection(object, "direction", light.direction);
        light.angleDegrees = object.number("angle", limits::spotAngle, light.angleDegrees);
        light.blend = object.number("blend", limits::fraction, light.blend);
        light.fade = object.choice("fade", spotFadeNames, light.fade);
        readProfile(object, source, light);
        break;
    case LightKind::Directional:
        object.allowOnly(scene_keys::directionalLight);
        light.power = object.colour("irradiance", limits::power);
        light.direction = readDirection(object, "direction", light.direction);
        break;
    }
    light.lightGroup = readLightGroup(object);
    return light;
}

/// Adds the file to `inputFiles`.
Environment readEnvironment(const JsonObject &object, const FileAccess &access, LoadedScene &loaded) {
    Environment environment;
    const JsonNode file = object.at("file");
    EnvironmentImage image;
    if (const Image *given = access.find(&SceneArrays::environments, file.text())) {
        image = environmentImageOf(*given, file.text());
    } else {
        const std::filesystem::path path = access.resolve(file);
        loaded.inputFiles.push_back(path.string());
        image = readEnvironmentImage(path);
    }
    environment.radiance = std::move(image.radiance);
    std::ranges::move(image.warnings, std::back_inserter(loaded.warnings));
    const std::size_t count = environment.radiance.pixels().size();
    if (count > limits::environmentTexelCount)
        file.fail(fmt::format("found {} x {} pixels; allowed: at most {} in all: make the image smaller",
                              environment.radiance.width(), environment.radiance.height(),
                              limits::environmentTexelCount));
    environment.scale =
        static_cast<float>(object.number("scale", limits::environmentScale, environment.scale));
    environment.rotateDegrees =
        object.number("rotateDegrees", limits::rotateDegrees, environment.rotateDegrees);
    environment.lightGroup = readLightGroup(object);
    return environment;
}

/// The files and the library for textures.
struct TextureSource {
    const FileAccess &access;
    TextureLibrary &library;
};

/// The textures of a material. The numbers that they are factors on become 1.
void readTextures(const JsonObject &object, const MaterialRow &row, const TextureSource &source,
                  Material &material) {
    const std::optional<JsonObject> textures = object.object("textures", scene_keys::textures(row));
    if (!textures)
        return;
    for (const auto &[key, slot, help] : textureSlots) {
        const std::optional<JsonNode> node = textures->find(key);
        if (!node)
            continue;
        const bool isNormal = slot == layout::slotNormal;
        const JsonObject image(*node, isNormal ? std::span<const std::string_view>(scene_keys::normalMap)
                                               : std::span<const std::string_view>(scene_keys::texture));
        const JsonNode file = image.at("file");
        TextureUse use;
        use.scale = glm::vec2(image.pair("scale", limits::texturePlacement, glm::dvec2(use.scale)));
        use.offset = glm::vec2(image.pair("offset", limits::texturePlacement, glm::dvec2(use.offset)));
        if (isNormal)
            material.normalStrength =
                static_cast<float>(image.number("strength", limits::normalStrength, material.normalStrength));
        const Texture *given = source.access.find(&SceneArrays::textures, file.text());
        use.textureIndex = given != nullptr ? source.library.load(file.text(), *given)
                                            : source.library.load(source.access.resolve(file));
        const Texture &texture = source.library.at(use.textureIndex);
        if (texture.isFloat() && slot != layout::slotEmission)
            file.fail("found an image of floats; allowed: one of bytes, such as a PNG or a JPEG");
        if (isNormal && source.library.lookOf(use.textureIndex).isGrey)
            file.fail("found a grey image, as height maps are; allowed: a normal map, which is bluish");
        material.textures[slot] = use;
    }
    const auto makeOne = [&](std::uint32_t slot, auto &factor) {
        if (material.textures[slot])
            factor = std::remove_reference_t<decltype(factor)>(1.0f);
    };
    makeOne(layout::slotBaseColour, material.albedo);
    makeOne(layout::slotEmission, material.emission);
    makeOne(layout::slotRoughness, material.roughness);
    makeOne(layout::slotMetallic, material.metallic);
    makeOne(layout::slotTransmission, material.transmission);
    makeOne(layout::slotClearcoat, material.clearcoat);
    makeOne(layout::slotClearcoatRoughness, material.clearcoatRoughness);
    makeOne(layout::slotSheenColour, material.sheenColour);
    makeOne(layout::slotSheenRoughness, material.sheenRoughness);
    makeOne(layout::slotAnisotropy, material.anisotropy);
    makeOne(layout::slotIridescence, material.iridescence);
    makeOne(layout::slotDiffuseTransmission, material.diffuseTransmission);
}

// One function for each kind of key; without the key the member keeps its value.
void readKey(const JsonObject &object, std::string_view key, const NumberKey &number, Material &material) {
    float &value = material.*number.member;
    value = static_cast<float>(object.number(key, number.allowed, value));
}
void readKey(const JsonObject &object, std::string_view key, const ColourKey &colour, Material &material) {
    glm::vec3 &value = material.*colour.member;
    value = glm::vec3(object.colour(key, colour.allowed, glm::dvec3(value)));
}
void readKey(const JsonObject &object, std::string_view key, const WholeKey &whole, Material &material) {
    material.*whole.member = object.integer(key, whole.allowed, material.*whole.member);
}
void readKey(const JsonObject &object, std::string_view key, const FlagKey &flag, Material &material) {
    material.*flag.member = object.boolean(key, material.*flag.member);
}
void readKey(const JsonObject &object, std::string_view /*key*/, const GroupKey & /*group*/,
             Material &material) {
    material.lightGroup = readLightGroup(object);
}
void readKey(const JsonObject &object, std::string_view key, const SidesKey & /*sides*/, Material &material) {
    material.reflectsBehind = !object.find(key);
    material.twoSided = object.boolean(key, false);
}
void readKey(const JsonObject &object, std::string_view key, const MetalKey & /*metal*/, Material &material) {
    const Metal metal = object.choice(key, metalNames, metalNames[0].second);
    material.conductorIndex = metal.index;
    material.conductorExtinction = metal.extinction;
}

void readMaterial(const JsonObject &object, const TextureSource &source, JsonFaults &faults,
                  Material &material) {
    material.kind = object.choice("type", materialNames);
    const MaterialRow &row = rowOf(material.kind);
    faults.collect([&] { object.allowOnly(scene_keys::material(row)); });
    material.roughness = row.defaultRoughness;
    if (row.textures != 0)
        faults.collect([&] { readTextures(object, row, source, material); });
    for (const MaterialKey &key : row.keys)
        faults.collect([&, &name = key.key] {
            std::visit([&](const auto &value) { readKey(object, name, value, material); }, key.value);
        });
}

template <class Number>
Number readValue(const JsonObject &object, std::string_view key, const NumberSetting<Number> &number,
                 Number fallback) {
    if constexpr (std::integral<Number>)
        return object.integer(key, number.allowed, fallback);
    else
        return object.number(key, number.allowed, fallback);
}

bool readValue(const JsonObject &object, std::string_view key, const FlagSetting &, bool fallback) {
    return object.boolean(key, fallback);
}

template <class Value>
Value readValue(const JsonObject &object, std::string_view key, const ChoiceSetting<Value> &choice,
                Value fallback) {
    return object.choice(key, choice.names, fallback);
}

RenderSettings readSettings(const JsonObject &object, JsonFaults &faults) {
    RenderSettings settings;
    const auto read = [&](std::string_view key, const auto &value) {
        settings.*value.member = readValue(object, key, value, settings.*value.member);
    };
    for (const Setting &setting : settingsTable)
        faults.collect(
            [&] { std::visit([&](const auto &value) { read(setting.key, value); }, setting.value); });
    if (settings.noise > 0.0 && !object.find("spp"))
        settings.samplesPerPixel = samplesForNoise;
    return settings;
}

/// Whether the materials or the environment of the file shine. Those that meshes bring are not known yet.
bool speaksOfEmission(const nlohmann::json &document) {
    if (document.contains("environment"))
        return true;
    const auto materials = document.find("materials");
    if (materials == document.end() || !materials->is_object())
        return false;
    return std::ranges::any_of(*materials, [](const nlohmann::json &material) {
        if (!material.is_object())
            return false;
        const auto textures = material.find("textures");
        return material.contains("emission") ||
               (textures != material.end() && textures->is_object() && textures->contains("emission"));
    });
}

/// Materials stand by their names if they have faults, so that what refers to them has none.
void readMaterials(const JsonObject &materials, const TextureSource &source, JsonFaults &faults,
                   Scene &scene) {
    for (const auto &[name, node] : materials.members(limits::materialCount)) {
        Material &material = scene.materials.emplace_back();
        material.name = name;
        faults.collect([&, &place = node] { readMaterial(JsonObject(place), source, faults, material); });
    }
}

/// Returns whether the file chooses an integrator.
bool takeSettings(const JsonObject &top, JsonFaults &faults, LoadedScene &loaded) {
    bool hasIntegrator = false;
    faults.collect([&] {
        const std::optional<JsonNode> node = top.find("settings");
        if (!node)
            return;
        const JsonObject settings(*node);
        faults.collect([&] { settings.allowOnly(scene_keys::settings); });
        hasIntegrator = settings.find("integrator").has_value();
        loaded.settings = readSettings(settings, faults);
        loaded.scene.shadowThroughGlass = static_cast<float>(
            settings.number("shadowThroughGlass", limits::fraction, loaded.scene.shadowThroughGlass));
    });
    return hasIntegrator;
}

LoadedScene loadDocument(const nlohmann::json &document, const std::filesystem::path &file,
                         const SceneArrays *arrays, const LoadOptions &options) {
    const std::string fileName = file.string();
    const JsonObject top{JsonNode{&document, &fileName}};
    JsonFaults faults;
    faults.collect([&] { top.allowOnly(scene_keys::top); });
    for (const std::string_view ignored : {"$schema"sv, "description"sv})
        faults.collect([&, &key = ignored] { static_cast<void>(top.text(key, "")); });

    LoadedScene loaded;
    loaded.file = file;
    Scene &scene = loaded.scene;
    const bool hasIntegrator = takeSettings(top, faults, loaded);
    if (!hasIntegrator && speaksOfEmission(document))
        loaded.settings.integrator = Integrator::Path;
    if (options.events.onOutline)
        options.events.onOutline({!top.elements("meshes", limits::meshCount).empty() ||
                                      !top.elements("shapes", limits::meshCount).empty(),
                                  loaded.settings});

    faults.collect([&] {
        scene.background =
            glm::vec3(top.colour("background", limits::radiance, glm::dvec3(scene.background)));
    });
    const FileAccess access(file, options.allowedPaths, arrays);
    TextureLibrary textures;
    ProfileLibrary profiles;
    faults.collect([&] {
        if (const std::optional<JsonObject> environment = top.object("environment", scene_keys::environment))
            scene.environment = readEnvironment(*environment, access, loaded);
    });
    faults.collect([&] {
        if (const std::optional<JsonObject> camera = top.object("camera", scene_keys::camera)) {
            scene.camera = readCamera(*camera);
            loaded.cameraPath = readCameraPath(*camera, scene.camera);
        }
    });
    faults.collect([&] {
        for (const JsonNode &light : top.elements("lights", limits::lightCount))
            faults.collect([&] {
                scene.lights.push_back(readLight(light, {access, profiles, loaded.warnings}));
            });
    });
    if (const std::optional<JsonNode> materials = top.find("materials")) {
        faults.collect([&] { readMaterials(JsonObject(*materials), {access, textures}, faults, scene); });
        if (scene.materials.empty()) // what refers to them would have faults of its own
            faults.throwThem();
    }
    readObjects(top, access, textures, options.events.onReading, faults, loaded);
    faults.throwThem();
    scene.textures = textures.give();
    scene.profiles = profiles.give();
    if (!hasIntegrator) {
        const LightSources sources = lightSourcesOf(scene);
        loaded.settings.integrator =
            sources.hasEmitters || sources.hasEnvironment ? Integrator::Path : RenderSettings{}.integrator;
    }
    return loaded;
}

} // namespace

LoadedScene loadSceneFile(const std::filesystem::path &file, const LoadOptions &options) {
    const nlohmann::json document = readJsonFile(file);
    try {
        return loadDocument(document, file, nullptr, options);
    } catch (const JsonError &error) {
        throw withLines(error, file);
    }
}

LoadedScene loadSceneDocument(const SceneDocument &document, const LoadOptions &options) {
    return loadDocument(document.json, document.file, &document.arrays, options);
}

namespace scene_keys {

std::vector<std::string_view> material(const MaterialRow &row) {
    std::vector<std::string_view> keys{"type"};
    for (const MaterialKey &key : row.keys)
        keys.push_back(key.key);
    if (row.textures != 0)
        keys.emplace_back("textures");
    return keys;
}

std::vector<std::string_view> textures(const MaterialRow &row) {
    std::vector<std::string_view> keys;
    for (const auto &[key, slot, help] : textureSlots)
        if ((row.textures >> slot & 1u) != 0)
            keys.push_back(key);
    return keys;
}

} // namespace scene_keys
} // namespace hyalite::core
