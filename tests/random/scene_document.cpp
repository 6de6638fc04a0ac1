#include "tests/random/scene_document.h"

#include "tests/fixtures/gltf_fixture.h"
#include "tests/fixtures/png_fixture.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

using nlohmann::json;

std::string objText(const json &lines) {
    std::string text;
    for (const json &line : lines)
        text += line.get<std::string>() + "\n";
    return text;
}

std::string pfmBytes(const json &image) {
    std::string bytes =
        fmt::format("PF\n{} {}\n-1.0\n", image.at("width").get<int>(), image.at("height").get<int>());
    for (const float value : image.at("floats").get<std::vector<float>>())
        bytes.append(reinterpret_cast<const char *>(&value), sizeof(value));
    return bytes;
}

std::string pngBytes(const json &image) {
    const bool hasAlpha = image.at("channels") == 4;
    return storedPng(hasAlpha ? 6 : 2, image.at("levels").get<std::vector<std::uint8_t>>(),
                     std::max(image.at("width").get<int>(), 1));
}

/// Vertices by their attributes' names. An attribute is as wide as its first vector.
std::size_t addAttribute(GltfMaker &maker, const json &vectors) {
    std::vector<double> numbers;
    for (const json &vector : vectors)
        for (const json &number : vector)
            numbers.push_back(number.get<double>());
    switch (vectors.at(0).size()) {
    case 2:
        return maker.addVec2(numbers);
    case 3:
        return maker.addVec3(numbers);
    default:
        return maker.addVec4(numbers);
    }
}

std::string glbBytes(const json &model) {
    GltfMaker maker;
    for (const auto &[key, value] : model.items())
        if (key != "primitives")
            maker.json[key] = value;
    json primitives = json::array();
    for (const json &given : model.at("primitives")) {
        json primitive;
        for (const auto &[key, value] : given.items())
            if (key == "indices")
                primitive[key] = maker.addIndices(value.get<std::vector<double>>());
            else if (value.is_array())
                primitive["attributes"][key] = addAttribute(maker, value);
            else
                primitive[key] = value;
        primitives.push_back(primitive);
    }
    maker.json["meshes"] = {{{"primitives", primitives}}};
    return maker.glb();
}

std::string contentOf(const std::string &name, const json &file) {
    const std::string extension = std::filesystem::path(name).extension().string();
    if (extension == ".obj" || extension == ".ies")
        return objText(file);
    if (extension == ".pfm")
        return pfmBytes(file);
    return extension == ".png" ? pngBytes(file) : glbBytes(file);
}

void write(const std::filesystem::path &file, const std::string &content) {
    std::ofstream stream(file, std::ios::binary);
    stream << content;
    stream.close();
    if (!stream)
        throw Error(ErrorKind::OutputNotWritten, file.string() + ": it cannot be written");
}

} // namespace

std::filesystem::path writeDocument(const json &document, const std::filesystem::path &folder) {
    std::filesystem::create_directories(folder);
    for (const auto &[name, file] : document.at("files").items())
        write(folder / name, contentOf(name, file));
    write(folder / "scene.json", document.at("scene").dump(2) + "\n");
    return folder / "scene.json";
}

} // namespace hyalite::core::testing
