#include "host/import/scene_objects.h"

#include "host/import/transform_json.h"
#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/shapes.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace hyalite {
namespace {

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
ObjMesh readMesh(const JsonObject &object, const std::vector<Material> &materials, const FileReach &reach,
                 TextureLibrary &textures, const OnReading &onReading) {
    MeshTransform transform;
    transform.scale = object.number("scale", limits::meshScale, transform.scale);
    if (transform.scale == 0.0)
        object.at("scale").refuse("a number that is not 0");
    transform.rotateDegrees = object.vector("rotateDegrees", limits::rotateDegrees, transform.rotateDegrees);
    transform.translate = object.vector("translate", limits::coordinate, transform.translate);
    const bool isNamed = object.find("material").has_value();
    const std::uint32_t materialIndex = isNamed ? readMaterialIndex(object.at("material"), materials) : 0;

    ObjMesh mesh =
        loadObj(reach.resolve(object.at("file")), transform, onReading, isNamed ? nullptr : &textures);
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
    names.reserve(own.size());
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

} // namespace

void readObjects(const JsonObject &top, const FileReach &reach, TextureLibrary &textures,
                 const OnReading &onReading, LoadedScene &loaded) {
    Scene &scene = loaded.scene;
    for (const JsonNode &sphere : top.elements("spheres", limits::sphereCount))
        scene.spheres.push_back(readSphere({sphere, scene_keys::sphere}, scene.materials));
    const std::vector<JsonNode> meshes = top.elements("meshes", limits::meshCount);
    const auto onReadingMesh = [&](double share) {
        if (onReading)
            onReading((static_cast<double>(loaded.meshReports.size()) + share) /
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
        ObjMesh mesh = readMesh(object, named, reach, textures, onReadingMesh);
        if (!object.find("material"))
            addMaterialsOf(object, mesh, named, scene);
        else if (const std::optional<JsonNode> overrides = object.find("materialOverrides"))
            overrides->fail("found beside \"material\"; allowed: one of the two");
        if (const std::optional<JsonNode> transforms = object.find("instances"))
            mesh.report.instanceCount = transforms->value->size();
        addMesh(node, object, std::move(mesh.mesh));
        loaded.meshReports.push_back(std::move(mesh.report));
    }
}

} // namespace hyalite
