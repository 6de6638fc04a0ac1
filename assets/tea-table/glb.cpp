#include "assets/tea-table/glb.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <span>

namespace tea_table {

namespace {

static_assert(std::endian::native == std::endian::little, "as glTF's buffers are");

constexpr int typeUnsignedByte = 5121;
constexpr int typeUnsignedShort = 5123;
constexpr int typeFloat = 5126;
constexpr int targetNone = 0;
constexpr int targetVertices = 34962;
constexpr int targetIndices = 34963;
constexpr double lengthsPerUnit = 1048576.0;
constexpr double directionsPerUnit = 65536.0;

template <class T> std::string_view bytesOf(const std::vector<T> &values) {
    return {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T)};
}

template <class Row> std::vector<float> rounded(const std::vector<Row> &rows, double stepsPerUnit) {
    std::vector<float> values;
    for (const Row &row : rows)
        for (const double value : row)
            // Adding 0 makes 0 of -0.
            values.push_back(static_cast<float>(std::floor(value * stepsPerUnit + 0.5) / stepsPerUnit + 0.0));
    return values;
}

/// The shortest text that is read as the same number.
std::string text(float value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string join(std::span<const std::string> items) {
    std::string list;
    for (const std::string &item : items)
        list += (list.empty() ? "" : ",") + item;
    return list;
}

std::string list(std::string_view key, std::span<const std::string> items) {
    return "\"" + std::string(key) + "\":[" + join(items) + "]";
}

void pad(std::string &bytes, char filler) {
    while (bytes.size() % 4 != 0)
        bytes += filler;
}

void appendNumbers(std::string &bytes, std::initializer_list<std::size_t> numbers) {
    for (const std::size_t number : numbers)
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(number >> shift & 255u);
}

} // namespace

int Glb::addView(std::string_view bytes, int target) {
    pad(buffer_, '\0');
    views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(buffer_.size()) +
                     ",\"byteLength\":" + std::to_string(bytes.size()) +
                     (target == targetNone ? "}" : ",\"target\":" + std::to_string(target) + "}"));
    buffer_ += bytes;
    return static_cast<int>(views_.size()) - 1;
}

int Glb::addAccessor(std::string_view bytes, int target, std::size_t count, int componentType,
                     std::string_view type, std::string_view more) {
    const int view = addView(bytes, target);
    accessors_.push_back("{\"bufferView\":" + std::to_string(view) + ",\"componentType\":" +
                         std::to_string(componentType) + ",\"count\":" + std::to_string(count) +
                         ",\"type\":\"" + std::string(type) + "\"" + std::string(more) + "}");
    return static_cast<int>(accessors_.size()) - 1;
}

int Glb::addFloats(const std::vector<float> &values, std::size_t width, int target, bool hasBounds) {
    std::string more;
    if (hasBounds) {
        std::vector<std::string> low;
        std::vector<std::string> high;
        for (std::size_t part = 0; part < width; ++part) {
            float least = values[part];
            float most = values[part];
            for (std::size_t i = part; i < values.size(); i += width) {
                least = std::min(least, values[i]);
                most = std::max(most, values[i]);
            }
            low.push_back(text(least));
            high.push_back(text(most));
        }
        more = "," + list("min", low) + "," + list("max", high);
    }
    return addAccessor(bytesOf(values), target, values.size() / width, typeFloat,
                       width == 2 ? "VEC2" : "VEC3", more);
}

int Glb::addMesh(std::string_view name, const std::vector<Primitive> &primitives) {
    std::vector<std::string> parts;
    for (const auto &[material, mesh] : primitives) {
        std::string attributes =
            "\"POSITION\":" +
            std::to_string(addFloats(rounded(mesh.positions, lengthsPerUnit), 3, targetVertices, true));
        attributes += ",\"NORMAL\":" + std::to_string(addFloats(rounded(mesh.normals, directionsPerUnit), 3,
                                                                targetVertices, false));
        if (!mesh.uvs.empty())
            attributes += ",\"TEXCOORD_0\":" + std::to_string(addFloats(rounded(mesh.uvs, directionsPerUnit),
                                                                        2, targetVertices, false));
        if (!mesh.colours.empty()) {
            std::vector<std::uint8_t> levels;
            for (const Vec &colour : mesh.colours) {
                for (const double value : colour)
                    levels.push_back(static_cast<std::uint8_t>(still_life::clamp01(value) * 255.0 + 0.5));
                levels.push_back(255);
            }
            attributes += ",\"COLOR_0\":" +
                          std::to_string(addAccessor(bytesOf(levels), targetVertices, levels.size() / 4,
                                                     typeUnsignedByte, "VEC4", ",\"normalized\":true"));
        }
        const int indices = addAccessor(bytesOf(mesh.indices), targetIndices, mesh.indices.size(),
                                        typeUnsignedShort, "SCALAR", "");
        parts.push_back("{\"attributes\":{" + attributes + "},\"indices\":" + std::to_string(indices) +
                        ",\"material\":" + std::to_string(material) + "}");
    }
    meshes_.push_back("{\"name\":\"" + std::string(name) + "\"," + list("primitives", parts) + "}");
    return static_cast<int>(meshes_.size()) - 1;
}

int Glb::addTexture(std::string_view name, std::string_view png) {
    const int view = addView(png, targetNone);
    textures_.push_back("{\"source\":" + std::to_string(images_.size()) + ",\"sampler\":0}");
    images_.push_back("{\"name\":\"" + std::string(name) +
                      "\",\"mimeType\":\"image/png\",\"bufferView\":" + std::to_string(view) + "}");
    return static_cast<int>(images_.size()) - 1;
}

int Glb::addVectors(const std::vector<Vec> &vectors) {
    return addFloats(rounded(vectors, lengthsPerUnit), 3, targetNone, false);
}

bool Glb::write(const std::filesystem::path &file, std::string_view rest) const {
    std::string buffer = buffer_;
    pad(buffer, '\0');
    std::string json = "{" + std::string(rest) + list("meshes", meshes_) + "," + list("textures", textures_) +
                       "," + list("images", images_) + "," +
                       "\"samplers\":[{\"magFilter\":9729,\"minFilter\":9729}]," +
                       list("accessors", accessors_) + "," + list("bufferViews", views_) +
                       ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer.size()) + "}]}";
    pad(json, ' ');
    std::string bytes = "glTF";
    appendNumbers(bytes, {2, 12 + 8 + json.size() + 8 + buffer.size(), json.size()});
    bytes += "JSON" + json;
    appendNumbers(bytes, {buffer.size()});
    bytes += std::string("BIN\0", 4) + buffer;
    std::ofstream stream(file, std::ios::binary);
    stream << bytes;
    stream.close();
    return stream.good();
}

} // namespace tea_table
