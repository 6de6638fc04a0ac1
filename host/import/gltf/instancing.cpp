#include "host/import/gltf/instancing.h"

#include "host/import/gltf/nodes.h"
#include "host/import/gltf/primitive.h"

#include <glm/geometric.hpp>

namespace hyalite::core::gltf {

std::vector<glm::dmat4x3> readInstancing(Buffers &buffers, const JsonObject &extension) {
    const JsonNode node = extension.at("attributes");
    const Attributes attributes = readAttributes(buffers, node);
    if (attributes.empty())
        node.refuse("TRANSLATION, ROTATION or SCALE");
    const auto accessor = [&](std::string_view name, std::string_view type) -> const Accessor * {
        const auto attribute = attributes.find(name);
        if (attribute == attributes.end())
            return nullptr;
        attribute->second.requireType(type);
        return &attribute->second;
    };
    const Accessor *const translations = accessor("TRANSLATION", "VEC3");
    const Accessor *const rotations = accessor("ROTATION", "VEC4");
    const Accessor *const scales = accessor("SCALE", "VEC3");
    const std::size_t count = attributes.begin()->second.count();
    constexpr std::size_t bytesEach = 256; // of a map and an instance
    buffers.memoryBudget().take(count * bytesEach, node);
    std::vector<glm::dmat4x3> maps;
    maps.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Trs trs;
        if (translations != nullptr)
            trs.translation = glm::dvec3(translations->vec3(i));
        if (rotations != nullptr)
            trs.rotation = glm::dvec4(rotations->vec4(i));
        if (scales != nullptr)
            trs.scale = glm::dvec3(scales->vec3(i));
        if (!(glm::length(trs.rotation) > 1e-3))
            rotations->node().fail(fmt::format("element {} is a rotation of length 0", i));
        maps.push_back(trs.toMatrix());
    }
    return maps;
}

} // namespace hyalite::core::gltf
