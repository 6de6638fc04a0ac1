#include "hyalite/scene.h"

#include "host/api/contents.h"
#include "host/base/json_document.h"
#include "host/base/json_text.h"
#include "host/import/assets.h"
#include "host/import/formats.h"
#include "host/import/load.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/mat4x3.hpp>

#include <cstring>
#include <filesystem>
#include <utility>

namespace hyalite {

namespace {

constexpr std::size_t maxCorners = 65536; ///< of a polygon, as in files

using core::SceneDocument;
using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string &what, const std::string &found, const std::string &allowed) {
    throw Error(ErrorKind::Usage, fmt::format("{}: found {}; allowed: {}", what, found, allowed));
}

/// The rows of an array of numbers as vectors of `Row`.
template <class Row, class Number>
std::vector<Row> rowsOf(std::span<const Number> numbers, std::size_t rowCount, const std::string &what) {
    constexpr std::size_t width = sizeof(Row) / sizeof(Number);
    if (numbers.size() != rowCount * width)
        refuse(what, fmt::format("{} numbers", numbers.size()),
               fmt::format("{} rows of {}", rowCount, width));
    std::vector<Row> rows(rowCount);
    if (rowCount > 0)
        std::memcpy(rows.data(), numbers.data(), numbers.size_bytes());
    return rows;
}

/// The same of an array that may be empty.
template <class Row, class Number>
std::vector<Row> optionalRowsOf(std::span<const Number> numbers, std::size_t rowCount,
                                const std::string &what) {
    return numbers.empty() ? std::vector<Row>() : rowsOf<Row>(numbers, rowCount, what);
}

/// The name that is given, or the first free one of "mesh 1", "mesh 2", ...
template <class Arrays>
std::string freeName(const Arrays &arrays, const std::string &wanted, std::string_view kind) {
    if (!wanted.empty()) {
        if (arrays.contains(wanted))
            refuse(fmt::format("{} \"{}\"", kind, wanted), "a name that another one has", "another name");
        return wanted;
    }
    for (std::size_t i = arrays.size() + 1;; ++i)
        if (std::string name = fmt::format("{} {}", kind, i); !arrays.contains(name))
            return name;
}

Json parsed(const std::string &text, const std::string &what) { return core::parseJson(text, what); }

/// Row-major 4 x 4 matrices as maps.
std::vector<glm::dmat4x3> mapsOf(std::span<const double> matrices) {
    constexpr std::size_t width = 16;
    if (matrices.size() % width != 0)
        refuse("instances", fmt::format("{} numbers", matrices.size()), "16 of each instance, row by row");
    std::vector<glm::dmat4x3> maps(matrices.size() / width);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const double *matrix = matrices.data() + i * width;
        for (glm::length_t row = 0; row < 3; ++row)
            for (glm::length_t column = 0; column < 4; ++column)
                maps[i][column][row] = matrix[4 * row + column];
        if (matrix[12] != 0.0 || matrix[13] != 0.0 || matrix[14] != 0.0 || matrix[15] != 1.0)
            refuse(fmt::format("instances[{}]", i), "another last row", "0, 0, 0, 1: an affine map");
    }
    return maps;
}

std::shared_ptr<Scene::Content> documentContent(SceneDocument document) {
    auto content = std::make_shared<Scene::Content>();
    content->document = std::make_shared<SceneDocument>(std::move(document));
    return content;
}

/// The document, which this scene alone has from now on, under a new identity: no renderer and no copy has it.
SceneDocument &changed(std::shared_ptr<const Scene::Content> &given) {
    if (given->document && given.use_count() == 1 && given->document.use_count() == 1)
        return *given->document;
    SceneDocument document;
    if (given->document) {
        document = *given->document;
    } else {
        const std::filesystem::path file = core::resolveScene(given->source);
        if (!core::hasExtension(file, ".json"))
            throw Error(
                ErrorKind::Usage,
                fmt::format("{}: only a JSON scene can be changed; name this file as a mesh of a new scene: "
                            R"({{"meshes": [{{"file": "{}"}}]}})",
                            given->source, file.filename().string()));
        document = {.json = core::readJsonFile(file), .file = file};
    }
    auto content = documentContent(std::move(document));
    given = content;
    return *content->document;
}

/// A member of the document, which is `empty` without it. Throws Error{BadInput} if it is of another type.
Json &memberOf(SceneDocument &document, const char *key, Json empty) {
    Json &member = document.json.emplace(key, empty).first.value();
    if (member.type() != empty.type())
        throw Error(ErrorKind::BadInput,
                    fmt::format("scene: /{}: found {}; allowed: {}", key, core::excerpt(member.dump()),
                                empty.is_array() ? "an array" : "an object"));
    return member;
}

} // namespace

Scene::Scene() : content_(documentContent({.json = Json::object(), .file = "scene", .isFramed = true})) {}

Scene Scene::load(const std::string &source) {
    return guarded([&] {
        const std::filesystem::path file = core::resolveScene(source);
        if (!std::filesystem::is_regular_file(file))
            throw Error(ErrorKind::BadInput, fmt::format("{}: there is no such file", file.string()));
        Scene scene;
        auto content = std::make_shared<Content>();
        // A file stays the one that it is now, wherever the program goes.
        content->source =
            core::formatOf(source) != nullptr ? std::filesystem::absolute(source).string() : source;
        scene.content_ = std::move(content);
        return scene;
    });
}

Scene Scene::fromJson(const std::string &text, const std::string &folder) {
    return guarded([&] {
        SceneDocument document{.json = parsed(text, "scene"),
                               .file = (std::filesystem::absolute(folder) / "scene").lexically_normal()};
        if (!document.json.is_object())
            throw Error(ErrorKind::BadInput, "scene: the JSON text is no object");
        Scene scene;
        scene.content_ = documentContent(std::move(document));
        return scene;
    });
}

Scene &Scene::set(const std::string &key, const std::string &json) {
    guarded([&] {
        Json value = parsed(json, key);
        SceneDocument &document = changed(content_);
        document.isFramed = document.isFramed && key != "camera";
        document.json[key] = std::move(value);
        return 0;
    });
    return *this;
}

Scene &Scene::addMaterial(const std::string &name, const std::string &json) {
    guarded([&] {
        Json value = parsed(json, name);
        memberOf(changed(content_), "materials", Json::object())[name] = std::move(value);
        return 0;
    });
    return *this;
}

std::string Scene::addMesh(const MeshArrays &arrays, const std::string &material,
                           std::span<const double> instances, const std::string &name) {
    return guarded([&] {
        if (arrays.cornersPerFace < 3 || arrays.cornersPerFace > maxCorners)
            refuse("faces", fmt::format("{} corners", arrays.cornersPerFace),
                   fmt::format("from 3 to {}", maxCorners));
        if (arrays.faces.size() % arrays.cornersPerFace != 0)
            refuse("faces", fmt::format("{} indices", arrays.faces.size()),
                   fmt::format("{} of each face", arrays.cornersPerFace));
        if (arrays.vertices.size() % 3 != 0)
            refuse("vertices", fmt::format("{} numbers", arrays.vertices.size()), "3 of each vertex");
        const std::size_t count = arrays.vertices.size() / 3;
        auto mesh = std::make_shared<core::MeshArrays>();
        mesh->positions = rowsOf<glm::dvec3>(arrays.vertices, count, "vertices");
        mesh->corners.assign(arrays.faces.begin(), arrays.faces.end());
        mesh->cornersPerFace = arrays.cornersPerFace;
        mesh->normals = optionalRowsOf<glm::dvec3>(arrays.normals, count, "normals");
        mesh->uvs = optionalRowsOf<glm::dvec2>(arrays.uvs, count, "uvs");
        mesh->colours = optionalRowsOf<glm::vec3>(arrays.colours, count, "colours");
        mesh->places = mapsOf(instances);
        for (const glm::vec3 &colour : mesh->colours)
            for (glm::length_t channel = 0; channel < 3; ++channel)
                if (!core::limits::fraction.contains(colour[channel]))
                    refuse("colours", fmt::format("{}", colour[channel]),
                           "numbers " + core::limits::fraction.text());
        Json object = Json::object();
        if (!material.empty())
            object["material"] = material;
        SceneDocument &document = changed(content_);
        std::string given = freeName(document.arrays.meshes, name, "mesh");
        object["file"] = given;
        memberOf(document, "meshes", Json::array()).push_back(std::move(object));
        document.arrays.meshes.emplace(given, std::move(mesh));
        return given;
    });
}

Scene &Scene::addTexture(const std::string &name, int width, int height, int channels,
                         std::span<const std::uint8_t> levels) {
    guarded([&] {
        if (width < 1 || height < 1 || width > core::imageSideMax || height > core::imageSideMax)
            refuse("texture", fmt::format("{} x {} pixels", width, height),
                   fmt::format("from 1 to {} a side", core::imageSideMax));
        if (channels != 1 && channels != 3 && channels != 4)
            refuse("texture", fmt::format("{} channels", channels), "1, 3 or 4");
        auto texture = std::make_shared<core::Texture>();
        texture->name = name;
        texture->width = width;
        texture->height = height;
        texture->hasAlpha = channels == 4;
        const auto step = static_cast<std::size_t>(channels);
        if (levels.size() != texture->pixelCount() * step)
            refuse("texture", fmt::format("{} levels", levels.size()),
                   fmt::format("{}", texture->pixelCount() * step));
        texture->levels.reserve(texture->pixelCount());
        for (std::size_t i = 0; i < levels.size(); i += step) {
            const std::uint32_t red = levels[i];
            const std::uint32_t green = step == 1 ? red : levels[i + 1];
            const std::uint32_t blue = step == 1 ? red : levels[i + 2];
            const std::uint32_t alpha = step == 4 ? levels[i + 3] : 255u;
            texture->levels.push_back(red | green << 8u | blue << 16u | alpha << 24u);
        }
        SceneDocument &document = changed(content_);
        document.arrays.textures.emplace(freeName(document.arrays.textures, name, "texture"),
                                         std::move(texture));
        return 0;
    });
    return *this;
}

Scene &Scene::setEnvironment(int width, int height, std::span<const float> radiance, double scale,
                             double rotateDegrees) {
    guarded([&] {
        if (width < 1 || height < 1 || width > core::imageSideMax || height > core::imageSideMax)
            refuse("environment", fmt::format("{} x {} pixels", width, height),
                   fmt::format("from 1 to {} a side", core::imageSideMax));
        auto image = std::make_shared<core::Image>(width, height);
        image->pixels() = rowsOf<glm::vec3>(radiance, image->pixels().size(), "environment");
        SceneDocument &document = changed(content_);
        const std::string name = "environment";
        document.arrays.environments[name] = std::move(image);
        document.json["environment"] = {{"file", name}, {"scale", scale}, {"rotateDegrees", rotateDegrees}};
        return 0;
    });
    return *this;
}

std::string Scene::json() const {
    return guarded([&] {
        return content_->document ? core::jsonText(content_->document->json)
                                  : core::jsonText(Json::object({{"file", content_->source}}));
    });
}

void Scene::check() const {
    guarded([&] {
        static_cast<void>(content_->document ? core::loadScene(*content_->document)
                                             : core::loadScene(content_->source));
        return 0;
    });
}

} // namespace hyalite
