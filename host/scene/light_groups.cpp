#include "host/scene/light_groups.h"

#include <algorithm>

namespace hyalite::core {

namespace {

constexpr std::size_t longestName = 32;

std::string groupOf(const std::string &name) { return name.empty() ? std::string(defaultLightGroup) : name; }

} // namespace

bool isLightGroupName(std::string_view name) {
    return !name.empty() && name.size() <= longestName && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

std::vector<std::string> lightGroupsOf(const Scene &scene) {
    std::vector<std::string> groups;
    const auto add = [&](const std::string &name) {
        if (std::string group = groupOf(name); std::ranges::find(groups, group) == groups.end())
            groups.push_back(std::move(group));
    };
    for (const Light &light : scene.lights)
        add(light.lightGroup);
    for (const Material &material : scene.materials)
        if (material.emission != glm::vec3(0.0f) || material.isUnlit)
            add(material.lightGroup);
    if (!scene.environment.radiance.pixels().empty())
        add(scene.environment.lightGroup);
    else if (scene.background != glm::vec3(0.0f))
        add({});
    return groups;
}

std::uint32_t numberOfGroup(const std::vector<std::string> &groups, const std::string &name) {
    const auto found = std::ranges::find(groups, groupOf(name));
    return found == groups.end() ? 0 : static_cast<std::uint32_t>(found - groups.begin());
}

} // namespace hyalite::core
