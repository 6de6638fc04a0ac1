#include "host/import/gltf/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyalite::core::gltf {
namespace {

constexpr auto known = std::to_array<std::string_view>({
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "FB_ngon_encoding",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
});

bool isKnown(std::string_view name) { return std::ranges::find(known, name) != known.end(); }

} // namespace

std::span<const std::string_view> knownExtensions() { return known; }

void checkExtensions(const Document &document, std::vector<std::string> &warnings) {
    if (const std::optional<JsonObject> variants = extensionOf(document.top(), "KHR_materials_variants"))
        document.losses().add("variants", [&] {
            return fmt::format("{}: /extensions/KHR_materials_variants: the default ones are shown",
                               document.fileName());
        });
    std::vector<std::string> unknown;
    for (const JsonNode &node : elementsOf(document.top(), "extensionsRequired"))
        if (!isKnown(node.text()))
            node.refuse(quotedList(known));
    for (const JsonNode &node : elementsOf(document.top(), "extensionsUsed"))
        if (!isKnown(node.text()))
            unknown.push_back(node.text());
    if (unknown.empty())
        return;
    const std::vector<std::string_view> names(unknown.begin(), unknown.end());
    warnings.push_back(
        fmt::format("{}: /extensionsUsed: passed over: {}", document.fileName(), quotedList(names)));
}

} // namespace hyalite::core::gltf
