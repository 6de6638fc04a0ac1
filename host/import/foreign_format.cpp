#include "host/import/foreign_format.h"

#include "host/base/error.h"
#include "host/base/input_file.h"
#include "host/base/shell.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {
namespace {

using namespace std::string_view_literals;

enum class Converter { Assimp, BlenderOpens, BlenderImportsUsd, BlenderImportsAlembic };

struct ForeignFormat {
    std::string_view name;
    std::array<std::string_view, 4> extensions; ///< in lower case
    std::array<std::string_view, 2> begins;     ///< a file of the format begins with one of them
    std::string_view contains; ///< or has this near its beginning, as text or names in an archive
    Converter converter;
};

constexpr auto foreignFormats = std::to_array<ForeignFormat>({
    {"FBX", {".fbx"}, {"Kaydara FBX Binary", "; FBX "}, {}, Converter::Assimp},
    {"COLLADA", {".dae"}, {}, "<COLLADA", Converter::Assimp},
    {"3MF", {".3mf"}, {}, "3D/3dmodel.model", Converter::Assimp},
    {"3D Studio", {".3ds"}, {}, {}, Converter::Assimp},
    {"LightWave", {".lwo"}, {}, {}, Converter::Assimp},
    {"DXF", {".dxf"}, {}, {}, Converter::Assimp},
    {"IFC", {".ifc"}, {}, {}, Converter::Assimp},
    {"OFF", {".off"}, {"OFF\n", "COFF\n"}, {}, Converter::Assimp},
    {"AMF", {".amf"}, {}, "<amf", Converter::Assimp},
    {"X3D", {".x3d"}, {}, "<X3D", Converter::Assimp},
    {"USD", {".usd", ".usda", ".usdc", ".usdz"}, {"#usda ", "PXR-USDC"}, {}, Converter::BlenderImportsUsd},
    {"Alembic", {".abc"}, {"Ogawa"}, {}, Converter::BlenderImportsAlembic},
    {"a Blender file", {".blend"}, {"BLENDER"}, {}, Converter::BlenderOpens},
});

/// An archive whose first file is a layer of USD.
bool isUsdz(std::string_view head) {
    constexpr std::size_t nameOffset = 30;
    constexpr std::size_t lengthOffset = 26;
    if (!head.starts_with("PK\x03\x04"sv) || head.size() < nameOffset)
        return false;
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
    const std::string_view name =
        head.substr(nameOffset, byteAt(lengthOffset) + std::size_t{256} * byteAt(lengthOffset + 1));
    return name.ends_with(".usda") || name.ends_with(".usdc") || name.ends_with(".usd");
}

bool looksLike(const ForeignFormat &format, std::string_view head) {
    const auto isBegin = [&](std::string_view begin) { return !begin.empty() && head.starts_with(begin); };
    return std::ranges::any_of(format.begins, isBegin) ||
           (!format.contains.empty() && head.find(format.contains) != std::string_view::npos) ||
           (format.converter == Converter::BlenderImportsUsd && isUsdz(head));
}

std::string headOf(const std::filesystem::path &file) {
    try {
        constexpr std::size_t wantedBytes = 2048;
        const std::vector<std::byte> head = InputFile(file).head(wantedBytes);
        return {reinterpret_cast<const char *>(head.data()), head.size()};
    } catch (const Error &) {
        return {};
    }
}

/// Names are words of their own behind "--", so that none is taken for code.
std::string commandOf(Converter converter, const std::string &file, const std::string &glb) {
    const auto importing = [](std::string_view operation) {
        return fmt::format("import bpy, sys; bpy.ops.wm.read_factory_settings(use_empty=True); "
                           "bpy.ops.wm.{}(filepath=sys.argv[-2]); "
                           "bpy.ops.export_scene.gltf(filepath=sys.argv[-1])",
                           operation);
    };
    const auto blender = [&](const std::string &code) {
        return shellLine(std::array{"blender", "-b", "--python-expr", code.c_str(), "--", file.c_str(),
                                    glb.c_str()}) +
               " (Blender of blender.org, as Debian's reads neither USD nor Alembic)";
    };
    switch (converter) {
    case Converter::Assimp:
        return shellLine(std::array{"assimp", "export", file.c_str(), glb.c_str()}) +
               " (Debian: assimp-utils)";
    case Converter::BlenderImportsUsd:
        return blender(importing("usd_import"));
    case Converter::BlenderImportsAlembic:
        return blender(importing("alembic_import"));
    case Converter::BlenderOpens:
        break;
    }
    constexpr const char *exporting = "import bpy, sys; bpy.ops.export_scene.gltf(filepath=sys.argv[-1])";
    return shellLine(
        std::array{"blender", "-b", file.c_str(), "--python-expr", exporting, "--", glb.c_str()});
}

} // namespace

void refuseForeignFormat(const std::filesystem::path &file) {
    const std::string head = headOf(file);
    for (const ForeignFormat &format : foreignFormats) {
        const bool isNamed = std::ranges::any_of(format.extensions, [&](std::string_view extension) {
            return !extension.empty() && hasExtension(file, extension);
        });
        if (!isNamed && !looksLike(format, head))
            continue;
        std::filesystem::path glb = file;
        if (isStandardStream(file))
            throw Error(
                ErrorKind::BadInput,
                fmt::format("standard input: it is {}, which is not read; store it as a file, and render "
                            "that: the error then names the command that makes a .glb of it",
                            format.name));
        glb.replace_extension(hasExtension(file, ".glb") ? ".converted.glb" : ".glb");
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: it is {}, which is not read; this command makes a .glb of it: {}",
                                file.string(), format.name,
                                commandOf(format.converter, file.string(), glb.string())));
    }
}

} // namespace hyalite::core
