#include "host/import/scene_json.h"

#include "host/base/json_document.h"
#include "host/base/json_reader.h"
#include "host/import/environment_file.h"
#include "host/import/file_reach.h"
#include "host/import/transform_json.h"
#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"
#include "host/scene/shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <variant>

namespace hyalite {
namespace {

using namespace std::string_view_literals;

glm::dvec3 readDirection(const JsonObject &object, std::string_view key, const glm::dvec3 &fallback) {
    const glm::dvec3 direction = object.vector(key, limits::coordinate, fallback);
    if (!limits::directionLength.contains(glm::length(direction)))
        object.at(key).fail(fmt::format("found length {}; allowed: a length {}", glm::length(direction),
                                        limits::directionLength.text()));
    return direction;
}

Camera readCamera(const JsonObject &object) {
    Camera camera;
    camera.kind = object.choice("type", cameraNames, camera.kind);
    camera.position = object.vector("position", limits::coordinate, camera.position);
    camera.direction = readDirection(object, "direction", camera.direction);
    camera.up = readDirection(object, "up", camera.up);
    camera.horizontalFovDegrees =
        object.number("horizontalFov", limits::horizontalFovDegrees, camera.horizontalFovDegrees);
    camera.aperture = object.number("aperture", limits::aperture, camera.aperture);
    camera.viewWidth = object.number("viewWidth", limits::viewWidth, camera.viewWidth);
    camera.width = object.integer("width", limits::imageSize, camera.width);
    camera.height = object.integer("height", limits::imageSize, camera.height);
    if (const std::optional<JsonNode> target = object.find("target")) {
        if (object.find("direction"))
            target->fail("found beside \"direction\"; allowed: one of the two");
        camera.direction = target->vector(limits::coordinate) - camera.position;
        if (!limits::directionLength.contains(glm::length(camera.direction)))
            target->fail("is the camera's own position; allowed: any other point");
        camera.focusDistance = std::min(glm::length(camera.direction), limits::focusDistance.high);
    }
    camera.focusDistance = object.number("focusDistance", limits::focusDistance, camera.focusDistance);
    return camera;
}

Light readLight(const JsonNode &node) {
    const JsonObject object(node);
    Light light;
    light.kind = object.choice("type", lightNames);
    switch (light.kind) {
    case LightKind::Point:
        object.allowOnly(scene_keys::pointLight);
        light.position = object.vector("position", limits::coordinate);
        light.power = object.colour("power", limits::power);
        break;
    case LightKind::Spot:
        object.allowOnly(scene_keys::spotLight);
        light.position = object.vector("position", limits::coordinate);
        light.power = object.colour("power", limits::power);
        light.direction = readDirection(object, "direction", light.direction);
        light.angleDegrees = object.number("angle", limits::spotAngle, light.angleDegrees);
        light.blend = object.number("blend", limits::fraction, light.blend);
        break;
    case LightKind::Directional:
        object.allowOnly(scene_keys::directionalLight);
        light.power = object.colour("irradiance", limits::power);
        light.direction = readDirection(object, "direction", light.direction);
        break;
    }
    return light;
}

/// Adds the file to `inputFiles`.
Environment readEnvironment(const JsonObject &object, const FileReach &reach, LoadedScene &loaded) {
    Environment environment;
    const JsonNode file = object.at("file");
    const std::filesystem::path path = reach.resolve(file);
    loaded.inputFiles.push_back(path.string());
    EnvironmentImage image = readEnvironmentImage(path);
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
    return environment;
}

/// What is needed to read textures.
struct TextureSource {
    const FileReach &reach;
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
        use.textureIndex = source.library.load(source.reach.resolve(file));
        const Texture &texture = source.library.at(use.textureIndex);
        if (texture.isFloat() && slot != layout::slotEmission)
            file.fail("found an image of floats; allowed: a PNG or a JPEG");
        if (isNormal && isGrey(texture))
            file.fail("found a grey image, as height maps are; allowed: a normal map, which is bluish");
        material.textures[slot] = use;
    }
    const auto has = [&](std::uint32_t slot) { return material.textures[slot].has_value(); };
    if (has(layout::slotBaseColour))
        material.albedo = glm::vec3(1.0f);
    if (has(layout::slotEmission))
        material.emission = glm::vec3(1.0f);
    if (has(layout::slotRoughness))
        material.roughness = 1.0f;
    if (has(layout::slotMetallic))
        material.metallic = 1.0f;
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
void readKey(const JsonObject &object, std::string_view key, const MetalKey & /*metal*/, Material &material) {
    const Metal metal = object.choice(key, metalNames, metalNames[0].second);
    material.conductorIndex = metal.index;
    material.conductorExtinction = metal.extinction;
}

Material readMaterial(const std::string &name, const JsonObject &object, const TextureSource &source) {
    Material material;
    material.name = name;
    material.kind = object.choice("type", materialNames);
    const MaterialRow &row = rowOf(material.kind);
    object.allowOnly(scene_keys::material(row));
    material.roughness = row.defaultRoughness;
    if (row.textures != 0)
        readTextures(object, row, source, material);
    for (const MaterialKey &key : row.keys)
        std::visit([&](const auto &value) { readKey(object, key.key, value, material); }, key.value);
    return material;
}

/// The index of the material that the text names.
std::uint32_t readMaterialIndex(const JsonNode &node, const std::vector<Material> &materials) {
    const std::string name = node.text();
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material &material) { return material.name == name; });
    if (found == materials.end()) {
        std::vector<std::string_view> names;
        names.reserve(materials.size());
        for (const Material &material : materials)
            names.push_back(material.name);
        node.refuse(names.empty() ? "a name in /materials, which defines none"
                                  : "a name in /materials: " + quotedList(names) + suggestion(name, names));
    }
    return static_cast<std::uint32_t>(found - materials.begin());
}

Sphere readSphere(const JsonObject &object, const std::vector<Material> &materials) {
    Sphere sphere;
    sphere.centre = object.vector("centre", limits::coordinate);
    sphere.radius = object.number("radius", limits::radius);
    sphere.materialIndex = readMaterialIndex(object.at("material"), materials);
    sphere.inwardNormal = object.boolean("inwardNormal", sphere.inwardNormal);
    return sphere;
}

/// Moves the mesh by the object's key "transform".
void applyTransform(const JsonObject &object, TriangleMesh &mesh) {
    const std::optional<JsonNode> node = object.find("transform");
    if (!node)
        return;
    const glm::dmat4x3 map = readTransform(*node);
    mesh = transformed(std::move(mesh), map);
    for (const glm::vec3 &position : mesh.positions)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (!limits::coordinate.contains(static_cast<double>(position[axis])))
                node->fail(fmt::format("moves a vertex to {}; allowed: coordinates {}", position[axis],
                                       limits::coordinate.text()));
}

/// `materials` are those of the scene file. A mesh that names none of them has its own.
ObjMesh readMesh(const JsonObject &object, const std::vector<Material> &materials,
                 const TextureSource &source, const OnReading &onReading) {
    MeshTransform transform;
    transform.scale = object.number("scale", limits::meshScale, transform.scale);
    if (transform.scale == 0.0)
        object.at("scale").refuse("a number that is not 0");
    transform.rotateDegrees = object.vector("rotateDegrees", limits::rotateDegrees, transform.rotateDegrees);
    transform.translate = object.vector("translate", limits::coordinate, transform.translate);
    const bool isNamed = object.find("material").has_value();
    const std::uint32_t materialIndex = isNamed ? readMaterialIndex(object.at("material"), materials) : 0;

    ObjMesh mesh = loadObj(source.reach.resolve(object.at("file")), transform, onReading,
                           isNamed ? nullptr : &source.library);
    mesh.mesh.materialIndex = materialIndex;
    applyTransform(object, mesh.mesh);
    return mesh;
}

constexpr int defaultSegments = 64;

TriangleMesh readShape(const JsonObject &object, const std::vector<Material> &materials) {
    const ShapeKind kind = object.choice("type", shapeNames);
    const std::optional<JsonNode> segments = object.find("segments");
    if (segments && kind != ShapeKind::Disk && kind != ShapeKind::Cylinder)
        segments->fail(fmt::format("found with \"{}\"; allowed: with \"disk\" and \"cylinder\"",
                                   nameIn(shapeNames, kind)));
    TriangleMesh mesh = makeShape(kind, object.integer("segments", limits::segments, defaultSegments));
    mesh.name = nameIn(shapeNames, kind);
    mesh.materialIndex = readMaterialIndex(object.at("material"), materials);
    applyTransform(object, mesh);
    return mesh;
}

/// Gives triangles the scene's materials in place of those of the mesh that the object names. `first` is the index of the
/// mesh's first material in the scene.
void overrideMaterials(const JsonObject &object, ObjMesh &mesh, std::uint32_t first,
                       const std::vector<Material> &own, const std::vector<Material> &named) {
    const std::optional<JsonNode> overrides = object.find("materialOverrides");
    if (!overrides)
        return;
    std::vector<std::string_view> names;
    for (const Material &material : own)
        names.push_back(material.name);
    for (const auto &[name, replacement] : JsonObject(*overrides).members(limits::materialCount)) {
        const auto found = std::ranges::find(names, name);
        if (found == names.end())
            replacement.fail("the mesh has no material of this name; " +
                             (names.empty() ? "this mesh has none at all"
                                            : "it has " + quotedList(names) + suggestion(name, names)));
        std::ranges::replace(mesh.mesh.triangleMaterials,
                             first + static_cast<std::uint32_t>(found - names.begin()),
                             readMaterialIndex(replacement, named));
    }
}

/// Gives the scene the materials that a mesh has brought, behind a neutral one for triangles without any. `named` are those
/// of the scene file, which may override them.
void addMaterialsOf(const JsonObject &object, ObjMesh &mesh, const std::vector<Material> &named,
                    Scene &scene) {
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    mesh.mesh.materialIndex = first;
    for (std::uint32_t &material : mesh.mesh.triangleMaterials)
        material += first;
    overrideMaterials(object, mesh, first + 1, mesh.materials, named);
    scene.materials.push_back(neutralMaterial());
    std::ranges::move(mesh.materials, std::back_inserter(scene.materials));
}

/// Adds an instance of the mesh for each transform of the array.
void readInstances(const JsonNode &transforms, TriangleMesh &&mesh, Scene &scene) {
    if (!transforms.value->is_array() || transforms.value->empty())
        transforms.refuse("an array of transforms, at least one");
    if (scene.instances.size() + transforms.value->size() > limits::instanceCount)
        transforms.refuse(fmt::format("at most {} instances in all", limits::instanceCount));
    std::vector<Placement> placements;
    placements.reserve(transforms.value->size());
    for (std::size_t i = 0; i < transforms.value->size(); ++i) {
        const JsonNode node{&(*transforms.value)[i], transforms.fileName, transforms.path / i};
        placements.push_back(toPlacement(readTransform(node)));
    }
    addInstances(scene, std::move(mesh), placements);
}

template <class Number>
Number readValue(const JsonObject &object, std::string_view key, const NumberSetting<Number> &number,
                 Number fallback) {
    if constexpr (std::integral<Number>)
        return object.integer(key, number.allowed, fallback);
    else
        return object.number(key, number.allowed, fallback);
}

template <class Value>
Value readValue(const JsonObject &object, std::string_view key, const ChoiceSetting<Value> &choice,
                Value fallback) {
    return object.choice(key, choice.names, fallback);
}

RenderSettings readSettings(const JsonObject &object) {
    RenderSettings settings;
    const auto read = [&](std::string_view key, const auto &value) {
        settings.*value.member = readValue(object, key, value, settings.*value.member);
    };
    for (const Setting &setting : settingsTable)
        std::visit([&](const auto &value) { read(setting.key, value); }, setting.value);
    return settings;
}

} // namespace

LoadedScene loadSceneFile(const std::filesystem::path &file, const LoadEvents &events,
                          std::span<const std::filesystem::path> allowedPaths) {
    const nlohmann::json document = readJsonFile(file);
    const std::string fileName = file.string();
    const JsonObject top({&document, &fileName}, scene_keys::top);
    for (const std::string_view ignored : {"$schema"sv, "description"sv})
        static_cast<void>(top.text(ignored, ""));

    LoadedScene loaded;
    loaded.file = file;
    Scene &scene = loaded.scene;
    if (const std::optional<JsonObject> settings = top.object("settings", scene_keys::settings)) {
        scene.settings = readSettings(*settings);
        scene.shadowThroughGlass = static_cast<float>(
            settings->number("shadowThroughGlass", limits::fraction, scene.shadowThroughGlass));
    }
    const std::vector<JsonNode> meshes = top.elements("meshes", limits::meshCount);
    if (events.onOutline)
        events.onOutline({!meshes.empty() || top.find("shapes"), scene.settings});

    scene.background = glm::vec3(top.colour("background", limits::radiance, glm::dvec3(scene.background)));
    const FileReach reach(file, allowedPaths);
    TextureLibrary textures;
    if (const std::optional<JsonObject> environment = top.object("environment", scene_keys::environment))
        scene.environment = readEnvironment(*environment, reach, loaded);
    if (const std::optional<JsonObject> camera = top.object("camera", scene_keys::camera))
        scene.camera = readCamera(*camera);
    for (const JsonNode &light : top.elements("lights", limits::lightCount))
        scene.lights.push_back(readLight(light));
    if (const std::optional<JsonNode> materials = top.find("materials"))
        for (const auto &[name, material] : JsonObject(*materials).members(limits::materialCount))
            scene.materials.push_back(readMaterial(name, JsonObject(material), {reach, textures}));
    for (const JsonNode &sphere : top.elements("spheres", limits::sphereCount))
        scene.spheres.push_back(readSphere({sphere, scene_keys::sphere}, scene.materials));
    const auto onReadingMesh = [&](double share) {
        if (events.onReading)
            events.onReading((static_cast<double>(loaded.meshReports.size()) + share) /
                             static_cast<double>(meshes.size()));
    };
    const std::vector<Material> named = scene.materials;
    std::size_t triangleTotal = 0;
    const auto addMesh = [&](const JsonNode &node, const JsonObject &object, TriangleMesh &&mesh) {
        triangleTotal += mesh.triangles.size();
        if (triangleTotal > limits::triangleCount) // before the next mesh takes memory
            node.fail(fmt::format("found {} triangles up to this mesh; allowed: at most {}", triangleTotal,
                                  limits::triangleCount));
        if (const std::optional<JsonNode> transforms = object.find("instances"))
            readInstances(*transforms, std::move(mesh), scene);
        else
            scene.meshes.push_back(std::move(mesh));
    };
    for (const JsonNode &node : top.elements("shapes", limits::meshCount)) {
        const JsonObject object(node, scene_keys::shape);
        addMesh(node, object, readShape(object, named));
    }
    for (const JsonNode &node : meshes) {
        const JsonObject object(node, scene_keys::mesh);
        ObjMesh mesh = readMesh(object, named, {reach, textures}, onReadingMesh);
        if (!object.find("material"))
            addMaterialsOf(object, mesh, named, scene);
        else if (const std::optional<JsonNode> overrides = object.find("materialOverrides"))
            overrides->fail("found beside \"material\"; allowed: one of the two");
        if (const std::optional<JsonNode> transforms = object.find("instances"))
            mesh.report.instanceCount = transforms->value->size();
        addMesh(node, object, std::move(mesh.mesh));
        loaded.meshReports.push_back(std::move(mesh.report));
    }
    scene.textures = textures.give();
    return loaded;
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
} // namespace hyalite
