#include "host/import/obj.h"

#include "host/import/mtl.h"
#include "host/import/obj_lines.h"
#include "host/import/obj_mesh.h"
#include "host/import/obj_plain.h"
#include "host/import/obj_statement.h"

// tinyobjloader is compiled here, in double. The library in distributions rounds each number to float before the
// transform, and converts numbers that are out of range. Rotations and large offsets would show that.
#define TINYOBJLOADER_IMPLEMENTATION
#ifndef TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_USE_DOUBLE
#endif
#include <tiny_obj_loader.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <istream>
#include <map>
#include <set>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hyalite {

namespace {

/// The materials that an OBJ file names.
class ObjMaterials {
  public:
    /// `textureLibrary` may be null: then materials are ignored.
    ObjMaterials(const std::filesystem::path &file, ObjMeshBuilder &meshBuilder,
                 TextureLibrary *textureLibrary)
        : folder(file.parent_path()), builder(meshBuilder), textures(textureLibrary) {}

    /// Reads a statement if it is about materials.
    void take(std::string_view statement) {
        if (const std::optional<std::string_view> name = argumentOf(statement, "mtllib"))
            read(*name);
        else if (const std::optional<std::string_view> used = argumentOf(statement, "usemtl"))
            use(*used);
    }

    [[nodiscard]] std::vector<Material> give() { return std::move(materials); }

  private:
    /// The text after the keyword, without blanks around it; empty for another keyword.
    static std::optional<std::string_view> argumentOf(std::string_view statement, std::string_view keyword) {
        constexpr std::string_view blanks = " \t";
        statement.remove_prefix(std::min(statement.find_first_not_of(blanks), statement.size()));
        if (!statement.starts_with(keyword) || statement.find_first_of(blanks) != keyword.size())
            return std::nullopt;
        statement.remove_prefix(
            std::min(statement.find_first_not_of(blanks, keyword.size()), statement.size()));
        return statement.substr(0, statement.find_last_not_of(blanks) + 1);
    }

    /// Reads a library. A missing one is not an error: many meshes have lost theirs. A library outside the folder is
    /// not read, because a mesh may come from a stranger. Each is read once, or a small file could request a large one
    /// again and again.
    void read(std::string_view name) {
        if (!names.emplace(name).second)
            return;
        std::error_code error;
        const std::filesystem::path base =
            std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
        const std::optional<std::filesystem::path> library = findWithin(base, base, name);
        if (error || !library) {
            builder.report().lostLibraries.emplace_back(name);
            return;
        }
        if (!libraries.insert(*library).second)
            return;
        builder.report().files.push_back(*library);
        for (Material &material : loadMtl(*library, {base, *textures, builder.report().warnings}))
            if (indices.emplace(material.name, static_cast<std::uint32_t>(materials.size() + 1)).second)
                materials.push_back(std::move(material));
    }

    void use(std::string_view name) {
        const std::uint32_t index = indexOf(name);
        builder.report().unknownMaterialCount += index == 0;
        builder.setMaterial(index);
    }

    /// The index of a material, from 1; 0 if there is none.
    [[nodiscard]] std::uint32_t indexOf(std::string_view name) const {
        const auto found = indices.find(name);
        return found == indices.end() ? 0 : found->second;
    }

    std::filesystem::path folder;
    ObjMeshBuilder &builder;
    TextureLibrary *textures;
    std::vector<Material> materials;
    std::map<std::string, std::uint32_t, std::less<>> indices; ///< of the materials, by name
    std::set<std::string, std::less<>> names;                  ///< names of requested libraries
    std::set<std::filesystem::path> libraries;                 ///< files of libraries that were read
};

// A filter between the file and tinyobjloader, which knows no line numbers and trusts its input. It passes on one
// checked statement at a time, so that the current line in a callback is the line of the statement. Plain statements,
// nearly all of a file, bypass tinyobjloader.
class CheckedObjSource : public std::streambuf {
  public:
    /// `objMaterials` may be null: then materials are ignored.
    CheckedObjSource(ObjLines &objLines, ObjMeshBuilder &meshBuilder, ObjMaterials *objMaterials,
                     std::size_t &unusedCount, const OnReading &listener)
        : lines(objLines), builder(meshBuilder), materials(objMaterials), unusedStatementCount(unusedCount),
          onReading(listener) {}

  protected:
    int_type underflow() override {
        for (;;) {
            while (const char *nextBegin =
                       readPlainStatement(lines.peek(), lines.peekedLineNumber(), builder))
                lines.take(nextBegin);
            const std::optional<std::span<char>> line = lines.next();
            if (!line)
                return traits_type::eof();
            reportProgress();
            if (materials != nullptr)
                materials->take({line->data(), line->size()});
            const CheckedStatement statement = checkStatement(*line, lines);
            if (statement.kind == ObjStatement::Geometry) {
                char *const begin = statement.text.data();
                setg(begin, begin, begin + statement.text.size());
                return traits_type::to_int_type(*begin);
            }
            unusedStatementCount += statement.kind == ObjStatement::Unused;
        }
    }

  private:
    static constexpr std::size_t stepBytes = std::size_t{1} << 22;

    void reportProgress() {
        if (!onReading || lines.bytesRead() < nextReportBytes)
            return;
        nextReportBytes = lines.bytesRead() + stepBytes;
        onReading(lines.shareRead());
    }

    ObjLines &lines;
    ObjMeshBuilder &builder;
    ObjMaterials *materials;
    std::size_t &unusedStatementCount;
    const OnReading &onReading;
    std::size_t nextReportBytes = stepBytes;
};

struct CallbackData {
    const ObjLines &lines;
    ObjMeshBuilder &builder;
    std::vector<ObjCorner> corners{}; ///< of the current face
};

CallbackData &callbackData(void *userData) { return *static_cast<CallbackData *>(userData); }

tinyobj::callback_t makeCallbacks() {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void *userData, double x, double y, double z, double) {
        const CallbackData &data = callbackData(userData);
        data.builder.addPosition({x, y, z}, data.lines.lineNumber());
    };
    callbacks.normal_cb = [](void *userData, double x, double y, double z) {
        callbackData(userData).builder.addNormal({x, y, z});
    };
    callbacks.texcoord_cb = [](void *userData, double u, double v, double) {
        callbackData(userData).builder.addUv({u, v});
    };
    callbacks.index_cb = [](void *userData, tinyobj::index_t *indices, int count) {
        CallbackData &data = callbackData(userData);
        data.corners.clear();
        for (int i = 0; i < count; ++i)
            data.corners.push_back(
                {indices[i].vertex_index, indices[i].normal_index, indices[i].texcoord_index});
        data.builder.addFace(data.corners, data.lines.lineNumber());
    };
    return callbacks;
}

/// Removes textures that the mesh cannot use.
void leaveOutUselessTextures(ObjMesh &loaded) {
    const auto hasTextures = [](const Material &material) {
        return std::ranges::any_of(material.textures, [](const auto &use) { return use.has_value(); });
    };
    if (std::ranges::none_of(loaded.materials, hasTextures))
        return;
    if (loaded.mesh.triangleUvs.empty()) {
        for (Material &material : loaded.materials)
            material.textures = {};
        loaded.report.warnings.push_back(loaded.mesh.name +
                                         ": its textures are ignored, as it has no texture coordinates (vt)");
    } else if (loaded.report.uvLessCount > 0) {
        loaded.report.warnings.push_back(fmt::format(
            "{}: {} triangles have no texture coordinates (vt); textures show their bottom left corner there",
            loaded.mesh.name, loaded.report.uvLessCount));
    }
}

} // namespace

ObjMesh loadObj(const std::filesystem::path &file, const MeshTransform &transform, const OnReading &onReading,
                TextureLibrary *textures) {
    ObjLines lines(file);
    ObjMeshBuilder builder(lines.fileName(), transform);
    builder.report().files.push_back(file);
    std::size_t unusedStatementCount = 0;
    ObjMaterials materials(file, builder, textures);
    CheckedObjSource source(lines, builder, textures != nullptr ? &materials : nullptr, unusedStatementCount,
                            onReading);
    std::istream stream(&source);
    stream.exceptions(std::ios::badbit); // so that an Error of the source passes through the stream
    CallbackData data{lines, builder};
    tinyobj::LoadObjWithCallback(stream, makeCallbacks(), &data);
    ObjMesh loaded = builder.finish();
    loaded.report.unusedStatementCount = unusedStatementCount;
    if (!loaded.mesh.triangleMaterials.empty())
        loaded.materials = materials.give();
    leaveOutUselessTextures(loaded);
    return loaded;
}

MeshFile readObjMeshes(const std::filesystem::path &file, const MeshOptions &options) {
    ObjMesh loaded = loadObj(file, options.transform, options.onReading, options.textures);
    MeshFile meshes{.materials = std::move(loaded.materials), .report = std::move(loaded.report)};
    meshes.meshes.push_back({std::move(loaded.mesh)});
    return meshes;
}

} // namespace hyalite
