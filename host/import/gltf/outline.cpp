#include "host/import/gltf/outline.h"

#include "host/import/gltf/document.h"
#include "host/import/gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace hyalite {
namespace {

std::string contentsOf(const gltf::Document &document, const JsonObject &node) {
    std::string contents;
    const auto add = [&](std::string_view what, std::string_view name, const JsonNode &index) {
        contents +=
            fmt::format("{}{} {}", contents.empty() ? "" : ", ", what, index.wholeNumber(gltf::byteCount));
        if (!name.empty())
            contents += fmt::format(" \"{}\"", name);
    };
    for (const auto &[key, array] :
         {std::pair{"mesh", "meshes"}, std::pair{"camera", "cameras"}, std::pair{"skin", "skins"}})
        if (const auto index = document.reference(node, key, array))
            add(key, gltf::nameOf(JsonObject(document.at(array, *index))), node.at(key));
    if (const auto light = gltf::extensionOf(node, "KHR_lights_punctual"))
        add("light", "", light->at("light"));
    return contents;
}

} // namespace

GltfOutline outlineGltf(const std::filesystem::path &file, const std::string &scene, std::size_t maxRows) {
    const gltf::Document document(file);
    GltfOutline outline;
    outline.cameraCount = document.count("cameras");
    for (std::size_t i = 0; i < std::min(outline.cameraCount, maxRows); ++i) {
        const JsonObject camera(document.at("cameras", i));
        outline.cameras.push_back({gltf::nameOf(camera), camera.text("type")});
    }
    const gltf::NodeTree tree(document);
    const std::vector<std::size_t> nodes = tree.nodesOfScene(document, scene);
    outline.nodeCount = nodes.size();
    for (const std::size_t index : std::span(nodes).first(std::min(nodes.size(), maxRows))) {
        const JsonObject node(document.at("nodes", index));
        outline.nodes.push_back({index, tree.depthOf(index), gltf::nameOf(node), contentsOf(document, node)});
    }
    return outline;
}

} // namespace hyalite
