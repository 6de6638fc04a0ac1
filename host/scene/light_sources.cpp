#include "host/scene/light_sources.h"

#include <algorithm>

namespace hyalite {
namespace {

bool hasEmitters(const Scene &scene) {
    const auto shines = [&](std::uint32_t index) {
        return scene.materials[index].emission != glm::vec3(0.0f);
    };
    if (std::ranges::none_of(scene.materials,
                             [](const Material &material) { return material.emission != glm::vec3(0.0f); }))
        return false; // without a look at millions of triangles
    const auto wearsOne = [&](const TriangleMesh &mesh) {
        return mesh.triangleMaterials.empty() ? shines(mesh.materialIndex)
                                              : std::ranges::any_of(mesh.triangleMaterials, shines);
    };
    return std::ranges::any_of(scene.spheres, shines, &Sphere::materialIndex) ||
           std::ranges::any_of(scene.meshes, wearsOne) || std::ranges::any_of(scene.prototypes, wearsOne);
}

} // namespace

LightSources lightSourcesOf(const Scene &scene) {
    LightSources sources;
    sources.hasLights =
        std::ranges::any_of(scene.lights, [](const Light &light) { return light.power != glm::dvec3(0.0); });
    sources.hasEmitters = hasEmitters(scene);
    sources.hasEnvironment = !scene.environment.radiance.pixels().empty() && scene.environment.scale > 0.0f;
    sources.hasBackground = !sources.hasEnvironment && scene.background != glm::vec3(0.0f);
    return sources;
}

bool hasSurfaces(const Scene &scene) {
    return !scene.spheres.empty() || !scene.meshes.empty() || !scene.instances.empty();
}

} // namespace hyalite
