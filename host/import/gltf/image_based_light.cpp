#include "host/import/gltf/image_based_light.h"

#include "host/image/tone_curve.h"
#include "host/import/gltf/nodes.h"
#include "host/import/gltf/textures.h"
#include "host/import/texture_library.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace hyalite::core::gltf {
namespace {

constexpr std::size_t faceCount = 6;
constexpr int maxWidth = 4096; ///< of the environment

/// A face of a cube: where it looks, and where its columns and rows lead. Faces are those of cube maps, mirrored left to
/// right as the extension wants it, so that each is a photograph from the middle.
struct CubeFace {
    glm::dvec3 forward;
    glm::dvec3 right;
    glm::dvec3 down;
};
constexpr std::array<CubeFace, faceCount> cubeFaces{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                                     {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                     {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                                     {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                                     {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                                                     {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}}};

/// Linear radiance of an image of RGBD: sRGB over alpha. Images without alpha have radiance up to 1.
Image decoded(const Texture &texture) {
    std::array<float, 256> linear{};
    for (std::size_t level = 0; level < linear.size(); ++level)
        linear[level] = static_cast<float>(srgbDecoded(static_cast<double>(level) / 255.0));
    Image image(texture.width, texture.height);
    for (std::size_t i = 0; i < texture.levels.size(); ++i) {
        const std::uint32_t levels = texture.levels[i];
        const auto divisor = static_cast<float>(std::max(levels >> 24u, 1u)) / 255.0f;
        image.pixels()[i] =
            glm::vec3(linear[levels & 255u], linear[levels >> 8u & 255u], linear[levels >> 16u & 255u]) /
            divisor;
    }
    return image;
}

using Cube = std::array<Image, faceCount>;

/// Between four pixels of a face; `x` and `y` from 0 to 1. At the rim of a face the last pixels hold.
glm::dvec3 bilinear(const Image &face, double x, double y) {
    const auto at = [&](int column, int row) {
        column = std::clamp(column, 0, face.width() - 1);
        row = std::clamp(row, 0, face.height() - 1);
        return glm::dvec3(face.pixels()[static_cast<std::size_t>(row) * face.width() + column]);
    };
    const double u = x * face.width() - 0.5;
    const double v = y * face.height() - 0.5;
    const int column = static_cast<int>(std::floor(u));
    const int row = static_cast<int>(std::floor(v));
    return glm::mix(glm::mix(at(column, row), at(column + 1, row), u - column),
                    glm::mix(at(column, row + 1), at(column + 1, row + 1), u - column), v - row);
}

glm::dvec3 radianceFrom(const Cube &cube, const glm::dvec3 &direction) {
    const auto along = [&](const CubeFace &face) { return glm::dot(face.forward, direction); };
    const auto face = std::ranges::max_element(cubeFaces, {}, along);
    return bilinear(cube[static_cast<std::size_t>(face - cubeFaces.begin())],
                    0.5 + 0.5 * glm::dot(face->right, direction) / along(*face),
                    0.5 + 0.5 * glm::dot(face->down, direction) / along(*face));
}

/// By longitude and latitude: four directions a pixel, of which the cube has about one pixel each.
Image unrolled(const Cube &cube, const glm::dmat3 &rotation, double scale) {
    int width = maxWidth;
    for (const Image &face : cube)
        width = std::min(width, 4 * face.width());
    const int height = width / 2;
    const glm::dmat3 fromWorld = glm::transpose(rotation);
    Image image(width, height);
    auto pixel = image.pixels().begin();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++pixel) {
            glm::dvec3 sum(0.0);
            for (const auto &[dx, dy] : {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
                const double polar = std::numbers::pi * (y + dy) / height;
                const double azimuth = -2.0 * std::numbers::pi * (x + dx) / width; // from +z towards +x
                sum += radianceFrom(cube, fromWorld * glm::dvec3(std::sin(polar) * std::sin(azimuth),
                                                                 std::cos(polar),
                                                                 std::sin(polar) * std::cos(azimuth)));
            }
            *pixel = glm::vec3(sum * (scale / 4.0));
        }
    return image;
}

/// Nothing, with a warning, where an image of the first cube map cannot be read.
std::optional<Cube> readCube(Buffers &buffers, const FileAccess &access, const JsonObject &light) {
    const JsonNode levels = light.at("specularImages");
    const Elements cubes = elementsOf(light, "specularImages");
    if (cubes.empty())
        levels.refuse("an array of cube maps");
    const JsonNode faces = cubes[0];
    if (!faces.value->is_array() || faces.value->size() != faceCount)
        faces.refuse("the six images of a cube");
    TextureLibrary library; // of no scene: they are no textures
    TextureReader reader(buffers, access, library);
    Cube cube;
    const Elements images{faces};
    for (std::size_t i = 0; i < faceCount; ++i) {
        const std::optional<std::uint32_t> image = reader.readImage(images[i]);
        if (!image)
            return std::nullopt;
        cube[i] = decoded(library.at(*image));
        if (cube[i].width() != cube[i].height())
            images[i].fail(fmt::format("the image has {}x{} pixels; allowed: a square", cube[i].width(),
                                       cube[i].height()));
    }
    return cube;
}

} // namespace

std::optional<Image> readImageBasedLight(Buffers &buffers, const FileAccess &access,
                                         const JsonObject &scene) {
    constexpr std::string_view name = "EXT_lights_image_based";
    const std::optional<JsonObject> use = extensionOf(scene, name);
    if (!use)
        return std::nullopt;
    const Document &document = buffers.document();
    const JsonNode index = use->at("light");
    const std::optional<JsonObject> extension = extensionOf(document.top(), name);
    const Elements lights = extension ? elementsOf(*extension, "lights") : Elements();
    if (lights.empty())
        index.refuse("an index of /extensions/EXT_lights_image_based/lights, of which there are none");
    const JsonObject light(
        lights[static_cast<std::size_t>(index.wholeNumber({0.0, static_cast<double>(lights.size() - 1)}))]);
    const double intensity = clampedNumber(document, light, "intensity", limits::environmentScale, 1.0);
    const std::optional<JsonNode> rotation = light.find("rotation");
    const glm::dmat3 turned = rotation ? rotationOf(readQuaternion(document, *rotation)) : glm::dmat3(1.0);
    const std::optional<Cube> cube = readCube(buffers, access, light);
    return cube ? std::optional(unrolled(*cube, turned, intensity)) : std::nullopt;
}

} // namespace hyalite::core::gltf
