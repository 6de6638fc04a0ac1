#include "host/packing/light_planes.h"

#include "host/base/hash.h"
#include "host/scene/light_groups.h"

#include <algorithm>
#include <array>
#include <span>

namespace hyalite::core {

namespace {

constexpr std::array<std::string_view, layout::lightClassCount> classNames{
    "emission",      "background",      "diffuse_direct",      "diffuse_indirect",
    "glossy_direct", "glossy_indirect", "transmission_direct", "transmission_indirect"};

constexpr std::string_view groupPrefix = "light_";

std::uint32_t classesOf(const PackedScene &scene) {
    constexpr std::uint32_t direct = 1u << layout::lightDiffuseDirect;
    std::uint32_t classes = 3 * direct;
    if (scene.hasEmission || (scene.scattering & layout::scattersAtUnlit) != 0)
        classes |= 1u << layout::lightEmission;
    if ((scene.lighting & layout::lightsByEnvironment) != 0 || scene.frame.background != glm::vec3(0.0f))
        classes |= 1u << layout::lightBackground;
    if (scene.hasSpecular || (scene.scattering & ~layout::scattersAtUnlit) != 0)
        classes |= 3 * (1u << layout::lightGlossyDirect);
    if (scene.hasDielectric || (scene.scattering & layout::scattersAtThin) != 0)
        classes |= 3 * (1u << layout::lightTransmissionDirect);
    return classes;
}

} // namespace

LightPlanes lightPlanesOf(const PackedScene &scene, const RenderSettings &settings) {
    if (settings.integrator != Integrator::Path || showsWork(settings))
        return {};
    return {settings.hasLightLayers ? classesOf(scene) : 0,
            settings.hasLightGroups ? static_cast<std::uint32_t>(scene.lightGroups.size()) : 0};
}

std::vector<std::string> lightPlaneNames(const PackedScene &scene, const RenderSettings &settings) {
    const LightPlanes planes = lightPlanesOf(scene, settings);
    std::vector<std::string> names;
    for (std::uint32_t lightClass = 0; lightClass < layout::lightClassCount; ++lightClass)
        if ((planes.classes >> lightClass & 1u) != 0)
            names.emplace_back(classNames[lightClass]);
    for (std::uint32_t group = 0; group < planes.groups; ++group)
        names.push_back(std::string(groupPrefix) + scene.lightGroups[group]);
    return names;
}

bool isLightPlaneName(std::string_view name) {
    return std::ranges::find(classNames, name) != classNames.end() ||
           (name.starts_with(groupPrefix) && isLightGroupName(name.substr(groupPrefix.size())));
}

std::uint64_t lightGroupsHash(const PackedScene &scene) {
    std::uint64_t hash = scene.frame.environmentGroup;
    for (const std::string &name : scene.lightGroups)
        hash = hashBytes(std::as_bytes(std::span(name)), hash + name.size());
    for (const layout::EmitterRecord &emitter : scene.emitters) {
        const std::uint32_t group = lightGroupOf(emitter);
        hash = hashBytes(std::as_bytes(std::span(&group, 1)), hash);
    }
    for (const layout::MaterialRecord &material : scene.materials)
        hash = hashBytes(std::as_bytes(std::span(&material.lightGroup, 1)), hash);
    return hash;
}

} // namespace hyalite::core
