#include "host/import/obj.h"

#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/base/quantities.h"
#include "host/import/file_finder.h"
#include "host/import/mesh_builder.h"
#include "host/import/mtl.h"
#include "host/import/obj_lines.h"
#include "host/import/obj_statement.h"
#include "host/scene/origin.h"

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
#include <optional>
#include <set>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hyalite::core {

namespace {

/// The materials that an OBJ file names.
class ObjMaterials {
  public:
    /// `textures` may be null: then materials are ignored.
    ObjMaterials(const std::filesystem::path &file, MeshBuilder &builder, TextureLibrary *textures)
        : finder_(folderOf(file)), builder_(builder), textures_(textures) {}

    /// Reads a statement if it is about materials.
    void take(std::string_view statement) {
        if (const std::optional<std::string_view> name = argumentOf(statement, "mtllib"))
            read(*name);
        else if (const std::optional<std::string_view> used = argumentOf(statement, "usemtl"))
            use(*used);
    }

    [[nodiscard]] std::vector<Material> give() { return std::move(materials_); }

    /// Warns of what is lost, and of names of another computer.
    void warn(const std::string &mesh) const {
        MeshReport &report = builder_.report();
        if (!report.lostLibraries.empty())
            report.warnings.push_back(fmt::format(
                "{}: there is no material library {}{} in the mesh's folder: its materials are neutral", mesh,
                quoteInput(report.lostLibraries.front()),
                report.lostLibraries.size() > 1
                    ? fmt::format(" (nor {} more)", report.lostLibraries.size() - 1)
                    : ""));
        else if (report.unknownMaterialCount > 0)
            report.warnings.push_back(
                fmt::format("{}: {} use{} a material that no library has, and {} neutral", mesh,
                            countText(report.unknownMaterialCount, "usemtl statement"),
                            report.unknownMaterialCount == 1 ? "s" : "",
                            report.unknownMaterialCount == 1 ? "is" : "are"));
        if (finder_.renamedCount() > 0)
            report.warnings.push_back(fmt::format(
                "{}: {} by another name than it says, such as {}", mesh,
                finder_.renamedCount() == 1 ? "1 file was found"
                                            : fmt::format("{} files were found", finder_.renamedCount()),
                finder_.firstRenamed()));
    }

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

    /// Reads a library, or several. A missing one is not an error: many meshes have lost theirs. A library outside the
    /// folder is not read, because a mesh may come from a stranger. Each is read once, or a small file could request a
    /// large one again and again.
    void read(std::string_view list) {
        if (!names_.emplace(list).second || readOne(list))
            return;
        bool isLost = false;
        // Names may have blanks: ".mtl" ends one.
        for (std::string_view rest = list; !rest.empty();) {
            const std::string_view name = rest.substr(0, endOfName(rest));
            isLost |= !readOne(name) && !readWords(name);
            rest.remove_prefix(name.size());
            rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        }
        if (isLost)
            builder_.report().lostLibraries.emplace_back(list);
    }

    /// Behind the first ".mtl" that ends a word, or all of it.
    static std::size_t endOfName(std::string_view list) {
        constexpr std::string_view ending = ".mtl";
        for (std::size_t at = list.find(ending); at != std::string_view::npos;
             at = list.find(ending, at + 1)) {
            const std::size_t end = at + ending.size();
            if (end == list.size() || list[end] == ' ' || list[end] == '\t')
                return end;
        }
        return list.size();
    }

    /// Whether each word is a library.
    bool readWords(std::string_view list) {
        bool areAll = true;
        for (std::string_view rest = list; !rest.empty();) {
            const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
            areAll &= end == 0 || readOne(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        return areAll;
    }

    /// False if there is no such file.
    bool readOne(std::string_view name) {
        const std::optional<std::filesystem::path> library = finder_.find(finder_.folder(), name);
        if (!library)
            return false;
        if (!libraries_.insert(*library).second)
            return true;
        builder_.report().files.push_back(*library);
        for (Material &material : loadMtl(*library, {finder_, *textures_, builder_.losses()}))
            if (indices_.emplace(material.name, static_cast<std::uint32_t>(materials_.size() + 1)).second)
                materials_.push_back(std::move(material));
        return true;
    }

    void use(std::string_view name) {
        const std::uint32_t index = indexOf(name);
        builder_.report().unknownMaterialCount += index == 0;
        builder_.setMaterial(index);
    }

    /// The index of a material, from 1; 0 if there is none.
    [[nodiscard]] std::uint32_t indexOf(std::string_view name) const {
        const auto index = indices_.find(name);
        return index == indices_.end() ? 0 : index->second;
    }

    FileFinder finder_;
    MeshBuilder &builder_;
    TextureLibrary *textures_;
    std::vector<Material> materials_;
    std::map<std::string, std::uint32_t, std::less<>> indices_; ///< of the materials, by name
    std::set<std::string, std::less<>> names_;                  ///< names of requested libraries
    std::set<std::filesystem::path> libraries_;                 ///< files of libraries that were read
};

// A filter between the file and tinyobjloader, which knows no line numbers and trusts its input. It passes on one
// checked statement at a time, so that the current line in a callback is the line of the statement. Plain statements,
// nearly all of a file, bypass tinyobjloader.
class CheckedObjSource : public std::streambuf {
  public:
    /// `materials` may be null: then materials are ignored.
    CheckedObjSource(ObjLines &lines, MeshBuilder &builder, ObjMaterials *materials,
                     const OnReading &onReading)
        : lines_(lines), builder_(builder), materials_(materials), onReading_(onReading) {}

    /// The statement that was passed on last, of which tinyobjloader knows a part.
    [[nodiscard]] const CheckedStatement &current() const { return statement_; }

  protected:
    int_type underflow() override {
        for (;;) {
            while (const char *nextBegin =
                       readPlainStatement(lines_.peek(), lines_.peekedLineNumber(), builder_))
                lines_.take(nextBegin);
            const std::optional<std::span<char>> line = lines_.next();
            if (!line)
                return traits_type::eof();
            reportProgress();
            lowerKeyword(*line);
            if (materials_ != nullptr)
                materials_->take({line->data(), line->size()});
            statement_ = checkStatement(*line, lines_, builder_);
            if (statement_.text.empty())
                continue;
            char *const begin = statement_.text.data();
            setg(begin, begin, begin + statement_.text.size());
            return traits_type::to_int_type(*begin);
        }
    }

  private:
    static constexpr std::size_t stepBytes = std::size_t{1} << 22;

    /// Some programs write keywords in capitals.
    static void lowerKeyword(std::span<char> line) {
        const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
        const auto begin = std::ranges::find_if_not(line, isBlank);
        const auto end = std::find_if(begin, line.end(), isBlank);
        std::transform(begin, end, begin, [](char c) { return lowerCase(c); });
    }

    void reportProgress() {
        if (!onReading_ || lines_.bytesRead() < nextReportBytes_)
            return;
        nextReportBytes_ = lines_.bytesRead() + stepBytes;
        onReading_(lines_.shareRead());
    }

    ObjLines &lines_;
    MeshBuilder &builder_;
    ObjMaterials *materials_;
    const OnReading &onReading_;
    CheckedStatement statement_;
    std::size_t nextReportBytes_ = stepBytes;
};

struct CallbackData {
    const ObjLines &lines;
    MeshBuilder &builder;
    const CheckedStatement &statement; ///< the current one
    std::vector<FaceCorner> corners{}; ///< of the current face
};

CallbackData &callbackData(void *userData) { return *static_cast<CallbackData *>(userData); }

tinyobj::callback_t makeCallbacks() {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void *userData, double x, double y, double z, double) {
        const CallbackData &data = callbackData(userData);
        data.builder.addPosition({x, y, z}, data.lines.lineNumber());
        if (data.statement.colour)
            data.builder.setColour(*data.statement.colour);
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

/// Throws Error{BadInput} for a file that is something else.
void requireText(const ObjLines &lines) {
    const std::string guess = guessContent(lines.head());
    if (!guess.empty())
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: this is not OBJ text; it looks like {}", lines.fileName(), guess));
}

/// assimp writes black for vertices that have no colour where others have one. Makes it white in materials of which all
/// vertices are black.
void leaveOutBlackOfAssimp(ObjMesh &loaded) {
    const std::vector<std::uint32_t> &materials = loaded.mesh.triangleMaterials;
    CornerValues<glm::vec4> &colours = loaded.mesh.colours;
    if (materials.empty() || colours.values.empty())
        return;
    std::vector<bool> isColoured(std::ranges::max(materials) + std::size_t{1});
    const auto isBlack = [&](std::uint32_t value) {
        return glm::vec3(colours.values[value]) == glm::vec3(0);
    };
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const glm::uvec3 corners = colours.corners[i];
        if (!isBlack(corners.x) || !isBlack(corners.y) || !isBlack(corners.z))
            isColoured[materials[i]] = true;
    }
    const auto white = static_cast<std::uint32_t>(colours.values.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (!isColoured[materials[i]]) {
            colours.corners[i] = glm::uvec3(white);
            ++count;
        }
    if (count == 0)
        return;
    colours.values.emplace_back(1.0f);
    loaded.report.warnings.push_back(
        fmt::format("{}: {} of materials whose vertices are all black: no colours, as assimp writes it",
                    loaded.report.name, countText(count, "triangle")));
}

ObjMesh readObj(const std::filesystem::path &file, const MeshTransform &transform, const glm::dvec3 &origin,
                const OnReading &onReading, TextureLibrary *textures) {
    ObjLines lines(file);
    requireText(lines);
    const std::span<const char> head = lines.head();
    const bool isOfAssimp = std::string_view(head.data(), head.size()).find("Open Asset Import Library") !=
                            std::string_view::npos;
    MeshBuilder builder(lines.fileName(), transform, origin);
    builder.report().files.push_back(file);
    ObjMaterials materials(file, builder, textures);
    CheckedObjSource source(lines, builder, textures != nullptr ? &materials : nullptr, onReading);
    std::istream stream(&source);
    stream.exceptions(std::ios::badbit); // so that an Error of the source passes through the stream
    CallbackData data{lines, builder, source.current()};
    tinyobj::LoadObjWithCallback(stream, makeCallbacks(), &data);
    if (textures != nullptr)
        materials.warn(lines.fileName());
    ObjMesh loaded = builder.finish();
    if (!loaded.mesh.triangleMaterials.empty())
        loaded.materials = materials.give();
    leaveOutUselessTextures(loaded);
    if (isOfAssimp)
        leaveOutBlackOfAssimp(loaded);
    if (loaded.report.undefinedNormalCount > 0)
        loaded.report.warnings.push_back(
            fmt::format("{}: {} name{} normals that the file does not have, and get{} the geometric one",
                        lines.fileName(), countText(loaded.report.undefinedNormalCount, "triangle"),
                        loaded.report.undefinedNormalCount == 1 ? "s" : "",
                        loaded.report.undefinedNormalCount == 1 ? "s" : ""));
    return loaded;
}

} // namespace

ObjMesh loadObj(const std::filesystem::path &file, const MeshTransform &transform, const OnReading &onReading,
                TextureLibrary *textures) {
    return readNear(
        [&](const glm::dvec3 &origin) { return readObj(file, transform, origin, onReading, textures); });
}

MeshFile meshFileOf(ObjMesh loaded) {
    MeshFile meshes{.materials = std::move(loaded.materials), .report = std::move(loaded.report)};
    meshes.meshes.push_back({std::move(loaded.mesh)});
    return meshes;
}

MeshFile readObjMeshes(const std::filesystem::path &file, const MeshOptions &options) {
    return meshFileOf(loadObj(file, options.transform, options.onReading, options.textures));
}

} // namespace hyalite::core
