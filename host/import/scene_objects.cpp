#include "host/import/scene_objects.h"

#include "host/import/foreign_format.h"
#include "host/import/formats.h"
#include "host/import/mesh_arrays.h"
#include "host/import/obj.h"
#include "host/import/transform_json.h"
#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/shapes.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace hyalite::core {
namespace {

/// The index of the material that the text names.
std::uint32_t readMaterialIndex(const JsonNode &node, const std::vector<Material> &materials) {
    const std::string name = node.text();
    const auto named = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material &material) { return material.name == name; });
    if (named == materials.end()) {
        std::vector<std::string_view> names;
        names.reserve(materials.size());
        for (const Material &material : materials)
            names.push_back(material.name);
        node.refuse(names.empty() ? "a name in /materials, which defines none"
                                  : "a name in /materials: " + quotedList(names) + suggestion(name, names));
    }
    return static_cast<std::uint32_t>(named - materials.begin());
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
void applyTransform(const JsonObject &object, PlacedMesh &placed) {
    const std::optional<JsonNode> node = object.find("transform");
    if (!node)
        return;
    const glm::dmat4x3 map = readTransform(*node);
    for (glm::dmat4x3 &place : placed.places)
        place = composed(map, place);
    if (!placed.places.empty())
        return;
    placed.mesh = transformed(std::move(placed.mesh), map);
    for (const glm::vec3 &position : placed.mesh.positions)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (const double coordinate = static_cast<double>(position[axis]) + placed.mesh.origin[axis];
                !limits::coordinate.contains(coordinate))
                node->fail(fmt::format("moves a vertex to {}; allowed: coordinates {}", coordinate,
                                       limits::coordinate.text()));
}

/// How files of meshes are read for a scene file.
struct MeshSource {
    const FileAccess &access;
    TextureLibrary &textures;
    const OnReading &onReading;
};

/// The arrays, or else the file, that `node` names.
MeshFile readMeshFile(const JsonNode &node, const MeshOptions &options) {
    if (const MeshArrays *arrays = options.access.find(&SceneArrays::meshes, node.text()))
        return readMeshArrays(node.text(), *arrays, options.transform);
    const std::filesystem::path path = options.access.resolve(node);
    const Format *const format = formatOf(path);
    if (format == nullptr)
        refuseForeignFormat(path);
    else if (format->readMeshes == nullptr)
        node.refuse("a file of meshes");
    // A file of another extension is OBJ by tradition.
    const auto read = format != nullptr ? format->readMeshes : readObjMeshes;
    return read(path, options);
}

/// `materials` are those of the scene file. A mesh that names none of them has its own.
MeshFile readMeshes(const JsonObject &object, const std::vector<Material> &materials,
                    const MeshSource &source) {
    MeshTransform transform;
    transform.scale = object.number("scale", limits::meshScale, transform.scale);
    if (transform.scale == 0.0)
        object.at("scale").refuse("a number that is not 0");
    transform.rotateDegrees = object.vector("rotateDegrees", limits::rotateDegrees, transform.rotateDegrees);
    transform.translate = object.vector("translate", limits::coordinate, transform.translate);
    const bool isNamed = object.find("material").has_value();
    const std::uint32_t materialIndex = isNamed ? readMaterialIndex(object.at("material"), materials) : 0;

    MeshFile file = readMeshFile(object.at("file"), {.transform = transform,
                                                     .onReading = source.onReading,
                                                     .textures = isNamed ? nullptr : &source.textures,
                                                     .access = source.access});
    for (PlacedMesh &placed : file.meshes) {
        if (isNamed)
            placed.mesh.materialIndex = materialIndex;
        applyTransform(object, placed);
    }
    return file;
}

constexpr int defaultSegments = 64;

PlacedMesh readShape(const JsonObject &object, const std::vector<Material> &materials) {
    const ShapeKind kind = object.choice("type", shapeNames);
    const std::optional<JsonNode> segments = object.find("segments");
    if (segments && kind != ShapeKind::Disk && kind != ShapeKind::Cylinder)
        segments->fail(fmt::format("found with \"{}\"; allowed: with \"disk\" and \"cylinder\"",
                                   nameIn(shapeNames, kind)));
    PlacedMesh shape{makeShape(kind, object.integer("segments", limits::segments, defaultSegments))};
    shape.mesh.name = nameIn(shapeNames, kind);
    shape.mesh.materialIndex = readMaterialIndex(object.at("material"), materials);
    applyTransform(object, shape);
    return shape;
}

/// Gives triangles the scene's materials instead of those of the mesh that the object names. `first` is the index of
/// the mesh's first material in the scene.
void overrideMaterials(const JsonObject &object, MeshFile &file, std::uint32_t first,
                       const std::vector<Material> &named) {
    const std::optional<JsonNode> overrides = object.find("materialOverrides");
    if (!overrides)
        return;
    std::vector<std::string_view> names;
    names.reserve(file.materials.size());
    for (const Material &material : file.materials)
        names.push_back(material.name);
    for (const auto &[name, replacement] : JsonObject(*overrides).members(limits::materialCount)) {
        const auto place = std::ranges::find(names, name);
        if (place == names.end())
            replacement.fail("the mesh has no material of this name; " +
                             (names.empty() ? "this mesh has none at all"
                                            : "it has " + quotedList(names) + suggestion(name, names)));
        const std::uint32_t replaced = first + static_cast<std::uint32_t>(place - names.begin());
        const std::uint32_t index = readMaterialIndex(replacement, named);
        for (PlacedMesh &placed : file.meshes) {
            std::ranges::replace(placed.mesh.triangleMaterials, replaced, index);
            if (placed.mesh.materialIndex == replaced)
                placed.mesh.materialIndex = index;
        }
    }
}

/// Gives the scene the materials that a file has brought, behind a neutral one for triangles without any. `named` are
/// those of the scene file, which may override them.
void addMaterialsOf(const JsonObject &object, MeshFile &file, const std::vector<Material> &named,
                    Scene &scene) {
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    for (PlacedMesh &placed : file.meshes) {
        placed.mesh.materialIndex += first;
        for (std::uint32_t &material : placed.mesh.triangleMaterials)
            material += first;
    }
    overrideMaterials(object, file, first + 1, named);
    scene.materials.push_back(neutralMaterial(std::ranges::any_of(
        file.meshes, [](const PlacedMesh &placed) { return !placed.mesh.colours.corners.empty(); })));
    std::ranges::move(file.materials, std::back_inserter(scene.materials));
}

/// The key "instances": an array of transforms.
std::vector<glm::dmat4x3> readInstances(const JsonNode &transforms) {
    if (!transforms.value->is_array() || transforms.value->empty())
        transforms.refuse("an array of transforms, at least one");
    if (transforms.value->size() > limits::instanceCount)
        transforms.refuse(fmt::format("at most {} instances in all", limits::instanceCount));
    std::vector<glm::dmat4x3> maps;
    maps.reserve(transforms.value->size());
    for (std::size_t i = 0; i < transforms.value->size(); ++i)
        maps.push_back(readTransform({&(*transforms.value)[i], transforms.fileName, transforms.path / i}));
    return maps;
}

/// Adds the object's node to the scene, and those of its file below it. Returns its index.
std::uint32_t addNodes(SceneNode object, const std::vector<SceneNode> &ofFile, Scene &scene) {
    const auto first = static_cast<std::uint32_t>(scene.nodes.size());
    scene.nodes.push_back(std::move(object));
    for (const SceneNode &node : ofFile) {
        scene.nodes.push_back(node);
        scene.nodes.back().parent = node.parent == noNode ? first : first + 1 + node.parent;
    }
    return first;
}

/// Adds the mesh at each of its places, under each of the object's instances. `objectNode` is that of the object; those
/// of its file follow.
void addMesh(const JsonNode &node, std::uint32_t objectNode, const std::vector<glm::dmat4x3> &instances,
             PlacedMesh &&placed, Scene &scene) {
    const auto nodeOf = [&](std::size_t place) {
        return placed.nodes.empty() ? objectNode : objectNode + 1 + placed.nodes[place];
    };
    if (instances.empty() && placed.places.empty()) {
        scene.meshes.push_back(std::move(placed.mesh));
        scene.meshes.back().node = nodeOf(0);
        return;
    }
    const std::size_t innerCount = std::max<std::size_t>(placed.places.size(), 1);
    const std::size_t outerCount = std::max<std::size_t>(instances.size(), 1);
    if (outerCount > (limits::instanceCount - scene.instances.size()) / innerCount)
        node.fail(fmt::format("it has more instances than {}, with those before it", limits::instanceCount));
    const glm::dvec3 origin = std::exchange(placed.mesh.origin, glm::dvec3(0.0));
    const auto placementOf = [&](glm::dmat4x3 map) {
        map[3] += glm::dmat3(map) * origin;
        return toPlacement(map);
    };
    std::vector<Placement> placements;
    placements.reserve(outerCount * innerCount);
    std::vector<std::uint32_t> nodes;
    nodes.reserve(outerCount * innerCount);
    for (std::size_t i = 0; i < outerCount; ++i)
        for (std::size_t j = 0; j < innerCount; ++j) {
            placements.push_back(placementOf(placed.places.empty() ? instances[i]
                                             : instances.empty()   ? placed.places[j]
                                                                 : composed(instances[i], placed.places[j])));
            nodes.push_back(nodeOf(j));
        }
    addInstances(scene, std::move(placed.mesh), placements, nodes);
}

} // namespace

void readObjects(const JsonObject &top, const FileAccess &access, TextureLibrary &textures,
                 const OnReading &onReading, JsonFaults &faults, LoadedScene &loaded) {
    Scene &scene = loaded.scene;
    const auto forEach = [&](std::string_view key, std::size_t maxCount, const auto &read) {
        faults.collect([&] {
            for (const JsonNode &node : top.elements(key, maxCount))
                faults.collect([&] { read(node); });
        });
    };
    forEach("spheres", limits::sphereCount, [&](const JsonNode &sphere) {
        scene.spheres.push_back(readSphere({sphere, scene_keys::sphere}, scene.materials));
    });
    const OnReading onReadingMesh = [&](double share) {
        if (onReading)
            onReading((static_cast<double>(loaded.meshReports.size()) + share) /
                      static_cast<double>(top.find("meshes")->value->size()));
    };
    const std::vector<Material> named = scene.materials;
    std::size_t triangleTotal = 0;
    std::uint32_t shapeCount = 0;
    const auto add = [&](const JsonNode &node, const JsonObject &object, std::uint32_t objectNode,
                         std::vector<PlacedMesh> &&placed) {
        const std::optional<JsonNode> transforms = object.find("instances");
        const auto instances = transforms ? readInstances(*transforms) : std::vector<glm::dmat4x3>();
        for (PlacedMesh &mesh : placed) {
            triangleTotal += mesh.mesh.triangles.size();
            if (triangleTotal > limits::triangleCount) // before the next mesh takes memory
                node.fail(fmt::format("found {} triangles up to this mesh; allowed: at most {}",
                                      triangleTotal, limits::triangleCount));
            addMesh(node, objectNode, instances, std::move(mesh), scene);
        }
        return instances.size();
    };
    forEach("shapes", limits::meshCount, [&](const JsonNode &node) {
        const JsonObject object(node, scene_keys::shape);
        std::vector<PlacedMesh> shape;
        shape.push_back(readShape(object, named));
        const std::uint32_t objectNode = addNodes(
            {.name = shape.front().mesh.name, .kind = NodeKind::Shape, .index = shapeCount++}, {}, scene);
        add(node, object, objectNode, std::move(shape));
    });
    forEach("meshes", limits::meshCount, [&](const JsonNode &node) {
        const JsonObject object(node, scene_keys::mesh);
        MeshFile file = readMeshes(object, named, {access, textures, onReadingMesh});
        if (!object.find("material"))
            addMaterialsOf(object, file, named, scene);
        else if (const std::optional<JsonNode> overrides = object.find("materialOverrides"))
            overrides->fail("found beside \"material\"; allowed: one of the two");
        const std::uint32_t objectNode =
            addNodes({.name = object.at("file").text(),
                      .kind = NodeKind::Mesh,
                      .index = static_cast<std::uint32_t>(loaded.meshReports.size())},
                     file.nodes, scene);
        file.report.instanceCount = add(node, object, objectNode, std::move(file.meshes));
        loaded.meshReports.push_back(std::move(file.report));
    });
}

} // namespace hyalite::core
