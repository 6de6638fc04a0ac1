#include "host/scene/scene_json.h"

#include "host/scene/file_reach.h"
#include "host/scene/json_document.h"
#include "host/scene/json_reader.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace hyalite {
namespace {

using namespace std::string_view_literals;

enum class LightKind { Point };

constexpr std::array<Name<LightKind>, 1> lightKinds{{{"point", LightKind::Point}}};

glm::dvec3 readDirection(const JsonObject &object, std::string_view key, const glm::dvec3 &fallback) {
    const glm::dvec3 direction = object.vector(key, limits::coordinate, fallback);
    if (!limits::directionLength.contains(glm::length(direction)))
        object.at(key).fail(fmt::format("found length {}; allowed: a length {}", glm::length(direction),
                                        limits::directionLength.text()));
    return direction;
}

Camera readCamera(const JsonObject &object) {
    Camera camera;
    camera.position = object.vector("position", limits::coordinate, camera.position);
    camera.direction = readDirection(object, "direction", camera.direction);
    camera.up = readDirection(object, "up", camera.up);
    camera.horizontalFovDegrees =
        object.number("horizontalFov", limits::horizontalFovDegrees, camera.horizontalFovDegrees);
    camera.width = object.integer("width", limits::imageSize, camera.width);
    camera.height = object.integer("height", limits::imageSize, camera.height);
    if (const std::optional<JsonNode> target = object.find("target")) {
        if (object.find("direction"))
            target->fail("found beside \"direction\"; allowed: one of the two");
        camera.direction = target->vector(limits::coordinate) - camera.position;
        if (!limits::directionLength.contains(glm::length(camera.direction)))
            target->fail("is the camera's own position; allowed: any other point");
    }
    return camera;
}

PointLight readLight(const JsonObject &object) {
    static_cast<void>(object.choice("type", lightKinds));
    return {object.vector("position", limits::coordinate), object.colour("power", limits::power)};
}

Material readMaterial(const std::string &name, const JsonObject &object) {
    Material material;
    material.name = name;
    material.kind = object.choice("type", materialNames);
    switch (material.kind) {
    case MaterialKind::Diffuse:
        object.allowOnly(scene_keys::diffuse);
        material.albedo = glm::vec3(object.colour("albedo", limits::fraction, glm::dvec3(material.albedo)));
        material.twoSided = object.boolean("twoSided", material.twoSided);
        material.emission =
            glm::vec3(object.colour("emission", limits::radiance, glm::dvec3(material.emission)));
        break;
    case MaterialKind::Mirror:
        object.allowOnly(scene_keys::mirror);
        break;
    case MaterialKind::Dielectric:
        object.allowOnly(scene_keys::dielectric);
        material.refractiveIndex =
            static_cast<float>(object.number("index", limits::refractiveIndex, material.refractiveIndex));
        material.segmentTint =
            glm::vec3(object.colour("segmentTint", limits::fraction, glm::dvec3(material.segmentTint)));
        material.absorption =
            glm::vec3(object.colour("absorption", limits::absorption, glm::dvec3(material.absorption)));
        material.priority = object.integer("priority", limits::priority, material.priority);
        break;
    }
    return material;
}

/// The index of the material that the object's key "material" names.
std::uint32_t readMaterialIndex(const JsonObject &object, const std::vector<Material> &materials) {
    const JsonNode node = object.at("material");
    const std::string name = node.text();
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material &material) { return material.name == name; });
    if (found == materials.end()) {
        std::vector<std::string_view> names;
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
    sphere.materialIndex = readMaterialIndex(object, materials);
    sphere.inwardNormal = object.boolean("inwardNormal", sphere.inwardNormal);
    return sphere;
}

ObjMesh readMesh(const JsonObject &object, const std::vector<Material> &materials, const FileReach &reach,
                 const OnReading &onReading) {
    MeshTransform transform;
    transform.scale = object.number("scale", limits::meshScale, transform.scale);
    if (transform.scale == 0.0)
        object.at("scale").refuse("a number that is not 0");
    transform.rotateDegrees = object.vector("rotateDegrees", limits::rotateDegrees, transform.rotateDegrees);
    transform.translate = object.vector("translate", limits::coordinate, transform.translate);
    const std::uint32_t materialIndex = readMaterialIndex(object, materials);

    ObjMesh mesh = loadObj(reach.resolve(object.at("file")), transform, onReading);
    mesh.mesh.materialIndex = materialIndex;
    return mesh;
}

RenderSettings readSettings(const JsonObject &object) {
    RenderSettings settings;
    settings.integrator = object.choice("integrator", integratorNames, settings.integrator);
    settings.samplesPerPixel = object.integer("spp", limits::samplesPerPixel, settings.samplesPerPixel);
    settings.maxDepth = object.integer("maxDepth", limits::maxDepth, settings.maxDepth);
    settings.occlusionDistance =
        object.number("occlusionDistance", limits::occlusionDistance, settings.occlusionDistance);
    settings.tree = object.choice("bvh", treeNames, settings.tree);
    settings.leafSize = object.integer("leafSize", limits::leafSize, settings.leafSize);
    settings.sampler = object.choice("sampler", samplerNames, settings.sampler);
    settings.seed = object.integer("seed", limits::seed, settings.seed);
    settings.exposureStops = object.number("exposure", limits::exposureStops, settings.exposureStops);
    return settings;
}

} // namespace

LoadedScene loadSceneFile(const std::filesystem::path &file, const OnReading &onReading,
                          std::span<const std::filesystem::path> allowedPaths) {
    const nlohmann::json document = readJsonFile(file);
    const std::string fileName = file.string();
    const JsonObject top({&document, &fileName}, scene_keys::top);
    for (const std::string_view ignored : {"$schema"sv, "description"sv})
        static_cast<void>(top.text(ignored, ""));

    LoadedScene loaded;
    loaded.file = file;
    Scene &scene = loaded.scene;
    scene.background = glm::vec3(top.colour("background", limits::radiance, glm::dvec3(scene.background)));
    if (const std::optional<JsonObject> camera = top.object("camera", scene_keys::camera))
        scene.camera = readCamera(*camera);
    for (const JsonNode &light : top.elements("lights", limits::lightCount))
        scene.lights.push_back(readLight({light, scene_keys::light}));
    if (const std::optional<JsonNode> materials = top.find("materials"))
        for (const auto &[name, material] : JsonObject(*materials).members(limits::materialCount))
            scene.materials.push_back(readMaterial(name, JsonObject(material)));
    for (const JsonNode &sphere : top.elements("spheres", limits::sphereCount))
        scene.spheres.push_back(readSphere({sphere, scene_keys::sphere}, scene.materials));
    if (const std::optional<JsonObject> settings = top.object("settings", scene_keys::settings)) {
        scene.settings = readSettings(*settings);
        scene.shadowThroughGlass = static_cast<float>(
            settings->number("shadowThroughGlass", limits::fraction, scene.shadowThroughGlass));
    }
    const std::vector<JsonNode> meshes = top.elements("meshes", limits::meshCount);
    const auto onReadingMesh = [&](double share) {
        if (onReading)
            onReading((static_cast<double>(scene.meshes.size()) + share) /
                      static_cast<double>(meshes.size()));
    };
    const FileReach reach(file, allowedPaths);
    std::size_t triangleTotal = 0;
    for (const JsonNode &node : meshes) {
        ObjMesh mesh = readMesh({node, scene_keys::mesh}, scene.materials, reach, onReadingMesh);
        scene.meshes.push_back(std::move(mesh.mesh));
        loaded.meshReports.push_back(mesh.report);
        triangleTotal += scene.meshes.back().triangles.size();
        if (triangleTotal > limits::triangleCount) // before the next mesh takes memory
            node.fail(fmt::format("found {} triangles up to this mesh; allowed: at most {}", triangleTotal,
                                  limits::triangleCount));
    }
    return loaded;
}

} // namespace hyalite
