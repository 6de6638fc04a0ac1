#include "host/import/gltf/image_based_light.h"

#include "host/image/tone_curve.h"
#include "host/import/gltf/lights.h"
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
#include <limits>
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

/// The textures of a cube. Decoded they would take three times the memory.
class Cube {
  public:
    /// The size in pixels of the smallest face.
    [[nodiscard]] int smallestSide() const {
        int side = std::numeric_limits<int>::max();
        for (const std::uint32_t face : faces)
            side = std::min(side, library.at(face).width);
        return side;
    }
    [[nodiscard]] glm::dvec3 radianceFrom(const glm::dvec3 &direction) const {
        const auto along = [&](const CubeFace &face) { return glm::dot(face.forward, direction); };
        const auto face = std::ranges::max_element(cubeFaces, {}, along);
        return bilinear(library.at(faces[static_cast<std::size_t>(face - cubeFaces.begin())]),
                        0.5 + 0.5 * glm::dot(face->right, direction) / along(*face),
                        0.5 + 0.5 * glm::dot(face->down, direction) / along(*face));
    }

    TextureLibrary library; ///< of no scene: they are no textures
    std::array<std::uint32_t, faceCount> faces{};

  private:
    /// Between four pixels of a face; `x` and `y` from 0 to 1. At the rim of a face the last pixels hold.
    [[nodiscard]] glm::dvec3 bilinear(const Texture &face, double x, double y) const {
        const auto at = [&](int column, int row) {
            column = std::clamp(column, 0, face.width - 1);
            row = std::clamp(row, 0, face.height - 1);
            return decoded(face.levels[static_cast<std::size_t>(row) * static_cast<std::size_t>(face.width) +
                                       static_cast<std::size_t>(column)]);
        };
        const double u = x * face.width - 0.5;
        const double v = y * face.height - 0.5;
        const int column = static_cast<int>(std::floor(u));
        const int row = static_cast<int>(std::floor(v));
        return glm::mix(glm::mix(at(column, row), at(column + 1, row), u - column),
                        glm::mix(at(column, row + 1), at(column + 1, row + 1), u - column), v - row);
    }
    /// Linear radiance of a pixel of RGBD: sRGB over alpha. Images without alpha have radiance up to 1.
    [[nodiscard]] glm::dvec3 decoded(std::uint32_t levels) const {
        const auto divisor = static_cast<float>(std::max(levels >> 24u, 1u)) / 255.0f;
        return glm::vec3(linear_[levels & 255u], linear_[levels >> 8u & 255u],
                         linear_[levels >> 16u & 255u]) /
               divisor;
    }

    const std::array<float, 256> &linear_ = srgbDecodedLevels();
};

/// By longitude and latitude: four directions a pixel, of which the cube has about one pixel each.
Image unrolled(const Cube &cube, const glm::dmat3 &rotation, double scale) {
    const int width = 4 * std::min(cube.smallestSide(), maxWidth / 4);
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
                sum += cube.radianceFrom(fromWorld * glm::dvec3(std::sin(polar) * std::sin(azimuth),
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
    Cube cube;
    TextureReader reader(buffers, access, cube.library);
    const Elements images{faces};
    for (std::size_t i = 0; i < faceCount; ++i) {
        const std::optional<std::uint32_t> image = reader.readImage(images[i]);
        if (!image)
            return std::nullopt;
        cube.faces[i] = *image;
        const Texture &face = cube.library.at(*image);
        if (face.width != face.height)
            images[i].fail(
                fmt::format("the image has {}x{} pixels; allowed: a square", face.width, face.height));
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
    const JsonObject light(lightOf(document, *use, name));
    const double intensity = clampedNumber(document, light, "intensity", limits::environmentScale, 1.0);
    const std::optional<JsonNode> rotation = light.find("rotation");
    const glm::dmat3 turned = rotation ? rotationOf(readQuaternion(document, *rotation)) : glm::dmat3(1.0);
    const std::optional<Cube> cube = readCube(buffers, access, light);
    return cube ? std::optional(unrolled(*cube, turned, intensity)) : std::nullopt;
}

} // namespace hyalite::core::gltf
