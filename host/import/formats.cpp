#include "host/import/formats.h"

#include "host/import/assets.h"
#include "host/import/gltf/gltf.h"
#include "host/import/obj.h"
#include "host/import/ply.h"
#include "host/import/scene_json.h"
#include "host/import/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyalite {
namespace {

constexpr auto table = std::to_array<Format>({
    {.extension = ".json", .readScene = loadSceneFile},
    {.extension = ".obj", .readMeshes = readObjMeshes},
    {.extension = ".gltf", .readScene = loadGltf, .hasChoices = true, .readMeshes = readGltfMeshes},
    {.extension = ".glb", .readScene = loadGltf, .hasChoices = true, .readMeshes = readGltfMeshes},
    {.extension = ".ply", .readMeshes = readPlyMeshes},
    {.extension = ".stl", .readMeshes = readStlMeshes},
});

} // namespace

std::span<const Format> formats() { return table; }

const Format *formatOf(const std::filesystem::path &file) {
    const auto found = std::ranges::find_if(
        table, [&](const Format &format) { return hasExtension(file, format.extension); });
    return found == table.end() ? nullptr : &*found;
}

std::string listOfExtensions() {
    std::string list;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::string_view separator = i == 0 ? "" : i + 1 == table.size() ? " or " : ", ";
        list += fmt::format("{}{}", separator, table[i].extension);
    }
    return list;
}

} // namespace hyalite
