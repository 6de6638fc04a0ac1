#include "tests/images/plain_textures.h"

#include "tests/images/plain_microfacets.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace hyalite::core::testing::plain {

namespace {

/// IEC 61966-2-1, section 5.2.
double fromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vec decode(const Texture &texture, std::size_t index, std::uint32_t slot) {
    if (texture.isFloat())
        return texture.values[index];
    const std::uint32_t levels = texture.levels[index];
    const auto channel = [&](unsigned shift) { return ((levels >> shift) & 255u) / 255.0; };
    if (slot == layout::slotOpacity && texture.hasAlpha)
        return Vec(channel(24));
    const Vec value(channel(0), channel(8), channel(16));
    if (slot == layout::slotBaseColour || slot == layout::slotEmission)
        return {fromSrgb(value.x), fromSrgb(value.y), fromSrgb(value.z)};
    return value;
}

std::size_t wrapped(double index, int size) {
    const double rest = std::fmod(index, static_cast<double>(size));
    return static_cast<std::size_t>(rest < 0.0 ? rest + size : rest);
}

constexpr double minHeight = 0.01; ///< of a mapped normal over the surface, and of what it reflects

/// Keller and others, "The Iray Light Transport Simulation and Rendering System", 2017, appendix A.3: a normal whose
/// mirror direction dips below the surface is replaced by the one whose mirror direction is lifted just above it.
/// Before, a normal that faces away from the viewer is tilted until it does not. `up` is on the side of the viewer.
Vec visibleNormal(const Vec &toViewer, Vec normal, const Vec &up) {
    const double facing = glm::dot(toViewer, normal);
    if (facing < minHeight)
        normal = glm::normalize(normal + (minHeight - facing) * toViewer);
    const Vec mirrored = 2.0 * glm::dot(toViewer, normal) * normal - toViewer;
    const double height = glm::dot(mirrored, up);
    if (height >= minHeight)
        return normal;
    return glm::normalize(toViewer + glm::normalize(mirrored + (minHeight - height) * up));
}

} // namespace

Substances::Substances(const Scene &scene) : scene_(scene) {
    for (const Material &material : scene.materials) {
        Vec average(0.0);
        if (material.kind == MaterialKind::Conductor)
            for (glm::length_t i = 0; i < 3; ++i)
                average[i] =
                    averageConductorFresnel(material.conductorIndex[i], material.conductorExtinction[i]);
        averageReflectances_.push_back(average);
    }
}

/// Bilinear between the middles of pixels; the image repeats, and its last row is at v = 0.
Vec Substances::lookUp(const TextureUse &use, std::uint32_t slot, const Vec2 &uv) const {
    const Texture &texture = scene_.textures[use.textureIndex];
    const Vec2 placed = uv * Vec2(use.scale) + Vec2(use.offset);
    const double x = placed.x * texture.width - 0.5;
    const double y = -placed.y * texture.height - 0.5;
    Vec sum(0.0);
    for (const double right : {0.0, 1.0})
        for (const double down : {0.0, 1.0}) {
            const double column = std::floor(x) + right;
            const double row = std::floor(y) + down;
            const double weight = (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row));
            sum += weight * decode(texture,
                                   wrapped(row, texture.height) * static_cast<std::size_t>(texture.width) +
                                       wrapped(column, texture.width),
                                   slot);
        }
    return sum;
}

Substance Substances::at(std::uint32_t materialIndex, const Vec2 &uv) const {
    const Material &material = scene_.materials[materialIndex];
    const auto factor = [&](std::uint32_t slot) {
        return material.textures[slot] ? lookUp(*material.textures[slot], slot, uv) : Vec(1.0);
    };
    Substance substance;
    substance.material = &material;
    substance.colour = Vec(material.albedo) * factor(layout::slotBaseColour);
    substance.emission = Vec(material.emission) * factor(layout::slotEmission);
    substance.roughness = material.roughness * factor(layout::slotRoughness).x;
    substance.metallic = material.metallic * factor(layout::slotMetallic).x;
    substance.averageReflectance = averageReflectances_[materialIndex];
    return substance;
}

double Substances::presence(std::uint32_t materialIndex, const Vec2 &uv) const {
    const Material &material = scene_.materials[materialIndex];
    const auto &use = material.textures[layout::slotOpacity];
    const double opacity = material.opacity * (use ? lookUp(*use, layout::slotOpacity, uv).x : 1.0);
    if (material.alphaMode == AlphaMode::Blend)
        return opacity;
    return opacity < material.alphaCutoff ? 0.0 : 1.0;
}

void Substances::bendNormal(std::uint32_t materialIndex, const Vec &direction, SurfacePoint &point) const {
    const Material &material = scene_.materials[materialIndex];
    const auto &use = material.textures[layout::slotNormal];
    const Vec flat = point.alongU - point.normal * glm::dot(point.normal, point.alongU);
    if (!use || flat == Vec(0.0))
        return;
    const Vec x = glm::normalize(flat);
    Vec y = glm::cross(point.normal, x);
    if (glm::dot(y, point.alongV) < 0.0)
        y = -y;
    const Vec turned = 2.0 * lookUp(*use, layout::slotNormal, point.uv) - 1.0;
    const double strength = material.normalStrength;
    const Vec mapped = glm::normalize(strength * turned.x * x + strength * turned.y * y +
                                      std::max(turned.z, minHeight) * point.normal);
    const bool isBehind = glm::dot(direction, point.geometricNormal) > 0.0;
    const double side = isBehind ? -1.0 : 1.0;
    point.normal = side * visibleNormal(-direction, side * mapped, side * point.geometricNormal);
}

} // namespace hyalite::core::testing::plain
