#include "host/scene/scene_names.h"

#include "host/base/clean_text.h"
#include "host/scene/scene_nodes.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::string_view spherePrefix = "sphere ";

/// Numbers names as they come, after those of spheres.
class Numbering {
  public:
    Numbering(std::vector<std::string> &names, std::uint32_t sphereCount)
        : names_(names), sphereCount_(sphereCount) {}

    std::uint32_t operator()(std::string name) {
        if (const std::uint32_t sphere = sphereNamed(name); sphere != 0)
            return sphere;
        const auto [entry, isNew] = numbers_.try_emplace(
            std::move(name), sphereCount_ + static_cast<std::uint32_t>(names_.size() + 1));
        if (isNew)
            names_.push_back(entry->first);
        return entry->second;
    }

  private:
    /// The number of the sphere that has this name, or 0.
    [[nodiscard]] std::uint32_t sphereNamed(const std::string &name) const {
        std::uint32_t index = 0;
        if (!name.starts_with(spherePrefix))
            return 0;
        const char *const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + spherePrefix.size(), end, index);
        const bool isSphere = read.ec == std::errc{} && read.ptr == end && index < sphereCount_ &&
                              name == fmt::format("{}{}", spherePrefix, index);
        return isSphere ? index + 1 : 0;
    }

    std::vector<std::string> &names_;
    std::uint32_t sphereCount_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

std::string nameOr(const std::string &name, std::string_view kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : cleanText(name);
}

std::string nameOf(const SceneNode &node) {
    if (node.kind == NodeKind::Shape) // its name is its type
        return fmt::format("{} {}", node.name, node.index);
    return nameOr(node.name.empty() ? node.mesh : node.name, node.kind == NodeKind::Mesh ? "mesh" : "node",
                  node.index);
}

/// Of each node, its object's number and its asset's.
std::vector<std::pair<std::uint32_t, std::uint32_t>> numberNodes(const std::vector<SceneNode> &nodes,
                                                                 const std::vector<bool> &isUsed,
                                                                 Numbering &objects, Numbering &assets) {
    std::vector<std::uint32_t> outermost(nodes.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers(nodes.size());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        outermost[i] = nodes[i].parent == noNode ? i : outermost[nodes[i].parent];
        if (isUsed[i])
            numbers[i] = {objects(nameOf(nodes[i])), assets(nameOf(nodes[outermost[i]]))};
    }
    return numbers;
}

} // namespace

std::vector<std::string> SceneNames::withSpheres(const std::vector<std::string> &names) const {
    std::vector<std::string> all;
    all.reserve(sphereCount + names.size());
    for (std::uint32_t i = 0; i < sphereCount; ++i)
        all.push_back(fmt::format("{}{}", spherePrefix, i));
    all.insert(all.end(), names.begin(), names.end());
    return all;
}

NumberedScene numberScene(const Scene &scene, std::uint32_t firstTriangleId) {
    NumberedScene numbered;
    const auto sphereCount = static_cast<std::uint32_t>(scene.spheres.size());
    numbered.names.sphereCount = sphereCount;
    Numbering objects(numbered.names.objects, sphereCount);
    Numbering assets(numbered.names.assets, sphereCount);
    Numbering materials(numbered.names.materials, 0);
    numbered.places.reserve(scene.spheres.size() + scene.meshes.size() + scene.instances.size());
    for (std::uint32_t i = 0; i < sphereCount; ++i)
        numbered.places.push_back({i, i + 1, i + 1, 0});
    std::vector<bool> isUsed(scene.nodes.size(), false);
    visitObjects(scene, [&](const PlacedObject &object) {
        if (object.node != noNode)
            isUsed[object.node] = true;
    });
    const auto ofNodes = numberNodes(scene.nodes, isUsed, objects, assets);
    std::uint32_t firstPrimitive = firstTriangleId;
    visitObjects(scene, [&](const PlacedObject &object) {
        if (object.node != noNode) {
            const auto [number, asset] = ofNodes[object.node];
            numbered.places.push_back({firstPrimitive, number, asset, 0});
        } else { // only a program makes such a mesh
            const std::string name = nameOr(object.mesh.name, "mesh", numbered.places.size());
            numbered.places.push_back({firstPrimitive, objects(name), assets(name), 0});
        }
        firstPrimitive += static_cast<std::uint32_t>(object.mesh.triangles.size());
    });
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        numbered.materials.push_back(materials(nameOr(scene.materials[i].name, "material", i)));
    return numbered;
}

} // namespace hyalite::core
