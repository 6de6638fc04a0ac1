#include "host/scene/light_sources.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite::core {
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

std::optional<std::string> diagnoseLight(const Scene &scene, Integrator integrator) {
    if (!rowOf(integrator).showsLight || !hasSurfaces(scene))
        return std::nullopt;
    const LightSources sources = lightSourcesOf(scene);
    const bool isWhitted = integrator == Integrator::Whitted;
    if (!sources.hasLights && !sources.hasEmitters && !sources.hasEnvironment && !sources.hasBackground)
        return "nothing lights this scene: it has no light, no material with an emission, no environment and "
               "a black background; the picture will be black";
    if (isWhitted && !sources.hasLights)
        return "whitted lights surfaces by lights without size (point, spot, directional) alone, and this "
               "scene has none: the integrator path follows the light of emitters, environments and "
               "backgrounds";
    if (isWhitted && (sources.hasEmitters || sources.hasEnvironment))
        return fmt::format("whitted shows {}, but does not light surfaces by {}: the integrator path does",
                           sources.hasEmitters && sources.hasEnvironment ? "emitters and the environment"
                           : sources.hasEmitters                         ? "emitters"
                                                                         : "the environment",
                           sources.hasEmitters ? "them" : "it");
    return std::nullopt;
}

} // namespace hyalite::core
