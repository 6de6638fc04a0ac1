#include "host/import/formats.h"

#include "host/base/content_guess.h"
#include "host/base/input_file.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"
#include "host/import/gltf/gltf.h"
#include "host/import/obj.h"
#include "host/import/ply.h"
#include "host/import/scene_json.h"
#include "host/import/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace hyalite::core {
namespace {

std::string_view textOf(std::span<const char> bytes) {
    const std::string_view text(bytes.data(), bytes.size());
    return text.substr(std::min(text.find_first_not_of(" \t\r\n", byteOrderMarkBytes(bytes)), text.size()));
}

bool isJson(std::span<const char> bytes) { return textOf(bytes).starts_with('{'); }

/// glTF requires an "asset", which a scene of ours has not.
bool isGltf(std::span<const char> bytes) {
    return isJson(bytes) && textOf(bytes).find("\"asset\"") != std::string_view::npos;
}

bool isScene(std::span<const char> bytes) { return isJson(bytes) && !isGltf(bytes); }

bool isGlb(std::span<const char> bytes) { return textOf(bytes).starts_with("glTF"); }

bool isPly(std::span<const char> bytes) {
    return textOf(bytes).starts_with("ply\n") || textOf(bytes).starts_with("ply\r");
}

/// Any text may be an OBJ file.
bool isObj(std::span<const char> bytes) {
    return guessContent(bytes.first(std::min(bytes.size(), guessedBytes))).empty();
}

constexpr auto table = std::to_array<Format>({
    {.extension = ".json", .hasContent = isScene, .readScene = loadSceneFile},
    {.extension = ".gltf",
     .hasContent = isGltf,
     .readScene = loadGltf,
     .hasChoices = true,
     .readMeshes = readGltfMeshes},
    {.extension = ".glb",
     .hasContent = isGlb,
     .readScene = loadGltf,
     .hasChoices = true,
     .readMeshes = readGltfMeshes},
    {.extension = ".ply", .hasContent = isPly, .readMeshes = readPlyMeshes},
    {.extension = ".stl", .hasContent = isStl, .readMeshes = readStlMeshes},
    {.extension = ".obj", .hasContent = isObj, .readMeshes = readObjMeshes},
});

/// Throws Error{BadInput} for contents of no format.
const Format &formatOfStandardInput() {
    const std::span<const std::byte> input = standardInput();
    const std::span bytes(reinterpret_cast<const char *>(input.data()), input.size());
    const auto known =
        std::ranges::find_if(table, [&](const Format &format) { return format.hasContent(bytes); });
    if (known != table.end())
        return *known;
    const InputFile file("-");
    throw file.bad(foreignContent(file, fmt::format("it is no {}", listOfExtensions())));
}

} // namespace

std::span<const Format> formats() { return table; }

const Format *formatOf(const std::filesystem::path &file) {
    if (isStandardStream(file))
        return &formatOfStandardInput();
    const auto known = std::ranges::find_if(
        table, [&](const Format &format) { return hasExtension(file, format.extension); });
    return known == table.end() ? nullptr : &*known;
}

std::string listOfExtensions() {
    std::string list;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::string_view separator = i == 0 ? "" : i + 1 == table.size() ? " or " : ", ";
        list += fmt::format("{}{}", separator, table[i].extension);
    }
    return list;
}

} // namespace hyalite::core
