#include "host/cli/inspect_scene.h"

#include "host/base/clean_text.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/scene/instances.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

constexpr std::size_t maxRows = GltfOutline::maxRows;

template <class Vector> std::string vectorText(const Vector &v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

/// One number for grey.
template <class Vector> std::string colourText(const Vector &colour) {
    return colour.x == colour.y && colour.y == colour.z ? fmt::format("{:.6g}", colour.x)
                                                        : vectorText(colour);
}

/// Calls print(i) for the first rows, and says how many are left.
template <class Print> void printRows(std::size_t count, const std::string &what, const Print &print) {
    for (std::size_t i = 0; i < std::min(count, maxRows); ++i)
        print(i);
    if (count > maxRows)
        printResult("             and {} more {}\n", count - maxRows, what);
}

/// A point of the scene in the coordinates of its file.
std::string pointText(const Scene &scene, const glm::dvec3 &point) {
    if (scene.origin == glm::dvec3(0.0))
        return vectorText(point);
    const glm::dvec3 ofFile = point + scene.origin;
    return fmt::format("({:.12g}, {:.12g}, {:.12g})", ofFile.x, ofFile.y, ofFile.z);
}

void printBounds(const Scene &scene) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity);
    glm::dvec3 high(-infinity);
    const auto add = [&](const glm::dvec3 &point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    };
    for (const Sphere &sphere : scene.spheres) {
        add(sphere.centre - sphere.radius);
        add(sphere.centre + sphere.radius);
    }
    const auto addMesh = [&](const TriangleMesh &mesh, const auto &place) {
        for (const MeshTriangle &triangle : mesh.triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                add(glm::dvec3(place(mesh.positions[triangle.positions[corner]])));
    };
    for (const TriangleMesh &mesh : scene.meshes)
        addMesh(mesh, [](const glm::vec3 &position) { return position; });
    for (const Instance &instance : scene.instances)
        addMesh(scene.prototypes[instance.prototype],
                [&](const glm::vec3 &position) { return placedPoint(instance.toWorld, position); });
    if (low.x <= high.x)
        printResult("bounds       {} to {}\n", pointText(scene, low), pointText(scene, high));
    if (scene.origin != glm::dvec3(0.0))
        printResult("origin       {}: far from zero, so that coordinates are read relative to it\n",
                    pointText(scene, glm::dvec3(0.0)));
}

void printCamera(const Scene &scene) {
    const Camera &camera = scene.camera;
    std::string lens;
    if (camera.kind == CameraKind::Perspective)
        lens = fmt::format(", {:.6g} degrees wide", camera.horizontalFovDegrees);
    if (camera.kind == CameraKind::Orthographic)
        lens = fmt::format(", {:.6g} wide", camera.viewWidth);
    if (camera.kind == CameraKind::Perspective && camera.aperture > 0.0)
        lens += fmt::format(", aperture {:.6g} in focus at {:.6g}", camera.aperture, camera.focusDistance);
    printResult("camera       {} at {}, looks along {}, up is {}{}; {}x{} pixels\n",
                nameIn(cameraNames, camera.kind), pointText(scene, camera.position),
                vectorText(camera.direction), vectorText(camera.up), lens, camera.width, camera.height);
}

void printLight(const Scene &scene, const Light &light) {
    const std::string_view kind = nameIn(lightNames, light.kind);
    if (light.kind == LightKind::Directional)
        printResult("light        {} along {}, irradiance {}\n", kind, vectorText(light.direction),
                    colourText(light.power));
    else if (light.kind == LightKind::Spot)
        printResult("light        {} at {} along {}, {:.6g} degrees, power {}\n", kind,
                    pointText(scene, light.position), vectorText(light.direction), light.angleDegrees,
                    colourText(light.power));
    else
        printResult("light        {} at {}, power {}\n", kind, pointText(scene, light.position),
                    colourText(light.power));
}

/// Numbers of spheres and triangles of a material.
struct MaterialUse {
    std::uint64_t spheres = 0;
    std::uint64_t triangles = 0; ///< those of instances once for each place
};

std::vector<MaterialUse> countMaterialUses(const Scene &scene) {
    std::vector<MaterialUse> uses(scene.materials.size());
    std::vector<std::uint64_t> places(scene.prototypes.size(), 0);
    for (const Instance &instance : scene.instances)
        ++places[instance.prototype];
    const auto add = [&](const TriangleMesh &mesh, std::uint64_t times) {
        if (mesh.triangleMaterials.empty())
            uses[mesh.materialIndex].triangles += times * mesh.triangles.size();
        for (const std::uint32_t material : mesh.triangleMaterials)
            uses[material].triangles += times;
    };
    for (const TriangleMesh &mesh : scene.meshes)
        add(mesh, 1);
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
        add(scene.prototypes[i], places[i]);
    for (const Sphere &sphere : scene.spheres)
        ++uses[sphere.materialIndex].spheres;
    return uses;
}

std::string useText(const MaterialUse &uses) {
    std::string text;
    if (uses.spheres > 0)
        text = countText(uses.spheres, "sphere");
    if (uses.triangles > 0)
        text += (text.empty() ? "" : " and ") + countText(uses.triangles, "triangle");
    return text.empty() ? "nothing" : text;
}

void printMaterial(const Scene &scene, const Material &material, const MaterialUse &uses) {
    std::string textures;
    for (const auto &[key, slot, help] : textureSlots)
        if (const std::optional<TextureUse> &use = material.textures[slot])
            textures += fmt::format("{}{} {}", textures.empty() ? "; textures: " : ", ", key,
                                    scene.textures[use->textureIndex].name);
    printResult("material     {}\n",
                cleanText(fmt::format("\"{}\": {}, on {}{}", material.name,
                                      nameIn(materialNames, material.kind), useText(uses), textures)));
}

void printEmitters(const Scene &scene, const std::vector<MaterialUse> &uses) {
    std::vector<std::size_t> emitters;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].emission != glm::vec3(0.0f) && (uses[i].spheres > 0 || uses[i].triangles > 0))
            emitters.push_back(i);
    printRows(emitters.size(), "emitters", [&](std::size_t i) {
        const Material &material = scene.materials[emitters[i]];
        printResult("emitter      {}\n",
                    cleanText(fmt::format("\"{}\": {} of radiance {}{}", material.name,
                                          useText(uses[emitters[i]]), colourText(material.emission),
                                          material.twoSided ? ", on both sides" : "")));
    });
}

/// Shapes and meshes of files alike, by name: how many there are.
void printShapes(const Scene &scene) {
    std::map<std::string, std::size_t> shapes;
    for (const auto &entry : shapeNames) {
        const std::string_view name = entry.first;
        const auto isShape = [&](const TriangleMesh &mesh) { return mesh.name == name; };
        const auto count =
            std::ranges::count_if(scene.meshes, isShape) + std::ranges::count_if(scene.prototypes, isShape);
        if (count > 0)
            shapes.emplace(name, static_cast<std::size_t>(count));
    }
    std::string text;
    for (const auto &[name, count] : shapes)
        text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", name, count);
    if (!text.empty())
        printResult("shapes       {}\n", text);
}

} // namespace

void printScene(const PreparedScene &prepared) {
    const Scene &scene = prepared.loaded.scene;
    printBounds(scene);
    printCamera(scene);
    const std::vector<MaterialUse> uses = countMaterialUses(scene);
    printRows(scene.lights.size(), "lights", [&](std::size_t i) { printLight(scene, scene.lights[i]); });
    printEmitters(scene, uses);
    if (const Image &sky = scene.environment.radiance; !sky.pixels().empty())
        printResult("environment  {}x{} pixels, scale {:.6g}, turned {:.6g} degrees\n", sky.width(),
                    sky.height(), scene.environment.scale, scene.environment.rotateDegrees);
    else
        printResult("background   {}\n", colourText(scene.background));
    printRows(scene.materials.size(), "materials",
              [&](std::size_t i) { printMaterial(scene, scene.materials[i], uses[i]); });
    printShapes(scene);
    if (!scene.instances.empty())
        printResult("instances    {} of {}\n", countText(scene.instances.size(), "place"),
                    countText(scene.prototypes.size(), "mesh", "meshes"));
}

void printOutline(const GltfOutline &outline) {
    const auto named = [](const std::string &name) {
        return name.empty() ? "" : fmt::format(" \"{}\"", excerpt(name));
    };
    printRows(outline.cameraCount, "cameras of the file", [&](std::size_t i) {
        const GltfOutline::CameraRow &camera = outline.cameras[i];
        fmt::print("of the file  camera {}{}: {}\n", i, named(camera.name), excerpt(camera.type));
    });
    printRows(outline.nodeCount, "nodes of the file", [&](std::size_t i) {
        const GltfOutline::NodeRow &node = outline.nodes[i];
        constexpr std::size_t maxIndent = 16; // levels; a hostile tree is a million deep
        fmt::print("of the file  {:{}}node {}{}{}\n", "", 2 * std::min(node.depth, maxIndent), node.index,
                   named(node.name), node.contents.empty() ? "" : ": " + excerpt(node.contents));
    });
}

} // namespace hyalite::core
