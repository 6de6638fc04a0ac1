#include "host/scene/scene_nodes.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/json_reader.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

namespace hyalite::core {

namespace {

bool isEmpty(const Bounds &bounds) { return !(bounds.low.x <= bounds.high.x); }

void extend(Bounds &bounds, const Bounds &other) {
    bounds.low = glm::min(bounds.low, other.low);
    bounds.high = glm::max(bounds.high, other.high);
}

Bounds boundsOf(const PlacedObject &object) {
    Bounds bounds = noBounds;
    for (const MeshTriangle &triangle : object.mesh.triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 point(object.point(triangle.positions[corner]));
            extend(bounds, {point, point});
        }
    return bounds;
}

/// The words by which a node is known; some may be empty.
std::array<std::string, 4> namesOf(const SceneNode &node) {
    if (node.kind != NodeKind::Mesh)
        return {node.name, node.mesh};
    const std::filesystem::path file(node.name);
    return {node.name, file.filename().string(), (file.parent_path() / file.stem()).string(),
            file.stem().string()};
}

bool isNamed(const SceneNode &node, const std::string &name) {
    return !name.empty() && std::ranges::count(namesOf(node), name) > 0;
}

} // namespace

SceneBounds sceneBounds(const Scene &scene) {
    SceneBounds bounds;
    bounds.nodes.resize(scene.nodes.size(), noBounds);
    for (const Sphere &sphere : scene.spheres)
        extend(bounds.all, {sphere.centre - sphere.radius, sphere.centre + sphere.radius});
    visitObjects(scene, [&](const PlacedObject &object) {
        const Bounds box = boundsOf(object);
        extend(bounds.all, box);
        if (object.node != noNode)
            extend(bounds.nodes[object.node], box);
    });
    for (std::size_t i = scene.nodes.size(); i-- > 0;)
        if (const std::uint32_t parent = scene.nodes[i].parent; parent != noNode)
            extend(bounds.nodes[parent], bounds.nodes[i]);
    return bounds;
}

Bounds boundsNamed(const Scene &scene, const SceneBounds &bounds, const std::string &name) {
    Bounds found = noBounds;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (isNamed(scene.nodes[i], name))
            extend(found, bounds.nodes[i]);
    for (std::size_t i = 0; i < scene.nodes.size() && isEmpty(found); ++i)
        if (scene.nodes[i].kind == NodeKind::Gltf && fmt::format("{}", scene.nodes[i].index) == name)
            extend(found, bounds.nodes[i]);
    if (!isEmpty(found))
        return found;
    std::set<std::string> names;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (!isEmpty(bounds.nodes[i]))
            for (const std::string &word : {scene.nodes[i].name, scene.nodes[i].mesh})
                if (!word.empty())
                    names.insert(word);
    const std::vector<std::string_view> words(names.begin(), names.end());
    throw Error(ErrorKind::Usage, fmt::format("found no object \"{}\"; allowed: {}", excerpt(name),
                                              words.empty() ? "none: nothing in the scene has a name"
                                                            : quotedList(words) + suggestion(name, words)));
}

} // namespace hyalite::core
