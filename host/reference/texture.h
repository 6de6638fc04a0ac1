// Images on surfaces. Twin: shaders/textures/texture.glsl.
//
// The filter is ours, and no sampler's: those have 8 bits of weights, and round as they like.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/functions.h"

#include <bit>
#include <cstdint>

namespace hyalite::reference {

/// u and v of textures at the corners of a triangle.
template <class Real> struct Coordinates {
    Vec2<Real> uv0;
    Vec2<Real> uv1;
    Vec2<Real> uv2;
};

template <class Real>
[[nodiscard]] Coordinates<Real> fetchCoordinates(const std::vector<layout::TextureRow> &rows,
                                                 std::uint32_t triangleRecord) {
    const auto number = [](std::uint32_t word) { return static_cast<Real>(std::bit_cast<float>(word)); };
    const layout::TextureRow *const row =
        &rows[layout::firstCoordinateRow + layout::rowsPerCoordinates * std::size_t{triangleRecord}];
    return {{number(row[0].x), number(row[0].y)},
            {number(row[0].z), number(row[0].w)},
            {number(row[1].x), number(row[1].y)}};
}

/// As trianglePoint.
template <class Real> [[nodiscard]] Vec2<Real> triangleUv(const Coordinates<Real> &at, Real u, Real v) {
    const Real w = Real(1) - u - v;
    return at.uv0 * u + at.uv1 * v + at.uv2 * w;
}

/// Of the point of a sphere that lies `outward`, a vector of any length, from its centre: as the environment's image,
/// seen from outside. Its middle is at +z.
template <class Real> [[nodiscard]] Vec2<Real> sphereUv(const Vec3<Real> &outward) {
    const Real squared = outward.x * outward.x + outward.z * outward.z;
    const Real longitude = squared > 0 ? turnsOf(-outward.x, -outward.z) : Real(0);
    const Real latitude = Real(2) * turnsOf(std::sqrt(squared), -outward.y);
    return {longitude, latitude};
}

/// How far a number lies above the whole one below it, in [0, 1); 0 for what is no finite number, and for what is so
/// little below a whole one that it would be 1.
template <class Real> [[nodiscard]] Real fractionOf(Real x) {
    const Real fraction = x - std::floor(x);
    return fraction >= 0 && fraction < 1 ? fraction : Real(0);
}

[[nodiscard]] inline std::uint32_t wordOf(const layout::TextureRow &words, std::uint32_t index) {
    const std::uint32_t low = (index & 1u) != 0 ? words.y : words.x;
    const std::uint32_t high = (index & 1u) != 0 ? words.w : words.z;
    return (index & 2u) != 0 ? high : low;
}

template <class Real>
[[nodiscard]] Real decodeLevel(const std::vector<layout::TextureRow> &rows, std::uint32_t tableRow,
                               std::uint32_t level) {
    return static_cast<Real>(std::bit_cast<float>(wordOf(rows[tableRow + (level >> 2u)], level)));
}

template <class Real>
[[nodiscard]] Vec3<Real> textureTexel(const std::vector<layout::TextureRow> &rows,
                                      const layout::TextureRow &description, std::uint32_t x,
                                      std::uint32_t y) {
    const std::uint32_t index = y * (description.y & 0xFFFFu) + x;
    if ((description.z & layout::textureIsFloat) != 0) {
        const layout::TextureRow &row = rows[description.x + index];
        return {static_cast<Real>(std::bit_cast<float>(row.x)),
                static_cast<Real>(std::bit_cast<float>(row.y)),
                static_cast<Real>(std::bit_cast<float>(row.z))};
    }
    std::uint32_t levels = wordOf(rows[description.x + (index >> 2u)], index);
    if ((description.z & layout::textureIsAlpha) != 0)
        levels = (levels >> 24u) * 0x010101u;
    const std::uint32_t table =
        (description.z & layout::textureIsSrgb) != 0 ? layout::srgbTableRow : layout::linearTableRow;
    return {decodeLevel<Real>(rows, table, levels & 255u),
            decodeLevel<Real>(rows, table, (levels >> 8u) & 255u),
            decodeLevel<Real>(rows, table, (levels >> 16u) & 255u)};
}

/// Between the middles of texels it is linear both ways, and the image repeats. `row` is that of a TextureRecord.
template <class Real>
[[nodiscard]] Vec3<Real> lookUpTexture(const std::vector<layout::TextureRow> &rows, std::uint32_t row,
                                       const Vec2<Real> &uv) {
    const layout::TextureRow &description = rows[row];
    const auto placement = [](std::uint32_t word) { return static_cast<Real>(std::bit_cast<float>(word)); };
    const layout::TextureRow &place = rows[row + 1];
    const std::uint32_t width = description.y & 0xFFFFu;
    const std::uint32_t height = description.y >> 16u;
    const Vec2<Real> placed = uv * Vec2<Real>(placement(place.x), placement(place.y)) +
                              Vec2<Real>(placement(place.z), placement(place.w));
    const Real x = fractionOf(placed.x) * static_cast<Real>(width) + Real(0.5);
    const Real y = (Real(1) - fractionOf(placed.y)) * static_cast<Real>(height) + Real(0.5);
    auto right = static_cast<std::uint32_t>(x);
    auto lower = static_cast<std::uint32_t>(y);
    const Real across = x - static_cast<Real>(right);
    const Real down = y - static_cast<Real>(lower);
    const std::uint32_t left = right == 0 ? width - 1 : right - 1;
    const std::uint32_t upper = lower == 0 ? height - 1 : lower - 1;
    right = right >= width ? right - width : right;
    lower = lower >= height ? lower - height : lower;
    const auto texel = [&](std::uint32_t atX, std::uint32_t atY) {
        return textureTexel<Real>(rows, description, atX, atY);
    };
    return mixtureOf(mixtureOf(texel(left, upper), texel(right, upper), across),
                     mixtureOf(texel(left, lower), texel(right, lower), across), down);
}

[[nodiscard]] constexpr std::uint32_t textureRow(std::uint32_t textures, std::uint32_t slot) {
    return textures + layout::rowsPerTexture * slot;
}

/// Whether a material with textures has one in that slot.
[[nodiscard]] inline bool hasTexture(const std::vector<layout::TextureRow> &rows, std::uint32_t textures,
                                     std::uint32_t slot) {
    return rows[textureRow(textures, slot)].y != 0;
}

/// What a texture says where one number is wanted, times its factor.
template <class Real>
[[nodiscard]] Real lookUpNumber(const std::vector<layout::TextureRow> &rows, std::uint32_t row,
                                const Vec2<Real> &uv) {
    return lookUpTexture(rows, row, uv).x * static_cast<Real>(std::bit_cast<float>(rows[row].w));
}

/// GGX's alpha: what is rougher than nothing is at least so rough that float32 resolves the peak of the reflection.
template <class Real> [[nodiscard]] Real alphaOf(Real roughness) {
    const Real used = greater(roughness, Real(0.04f));
    return used * used;
}

/// Whether what a triangle's material is cut out of its image leaves nothing at the point with these weights.
template <class Real>
[[nodiscard]] bool isCutAway(const PackedScene &scene, const layout::TriangleRecord &triangle,
                             std::uint32_t record, Real u, Real v) {
    if ((triangle.flags & layout::triangleIsCutOut) == 0)
        return false;
    const std::uint32_t row =
        textureRow(scene.materials[triangle.materialIndex].textures, layout::slotOpacity);
    return lookUpNumber(scene.textures, row,
                        triangleUv(fetchCoordinates<Real>(scene.textures, record), u, v)) < Real(0.5);
}

/// The material as its textures make it at (u, v), rounded to floats in double precision, too.
template <class Real>
[[nodiscard]] layout::MaterialRecord texturedMaterial(const PackedScene &scene,
                                                      layout::MaterialRecord material, const Vec2<Real> &uv) {
    const std::uint32_t textures = material.textures;
    if (textures == 0)
        return material;
    const std::vector<layout::TextureRow> &rows = scene.textures;
    if (hasTexture(rows, textures, layout::slotBaseColour))
        material.albedo = glm::vec3(Vec3<Real>(material.albedo) *
                                    lookUpTexture(rows, textureRow(textures, layout::slotBaseColour), uv));
    if (hasTexture(rows, textures, layout::slotEmission))
        material.emission = glm::vec3(Vec3<Real>(material.emission) *
                                      lookUpTexture(rows, textureRow(textures, layout::slotEmission), uv));
    if (hasTexture(rows, textures, layout::slotRoughness))
        material.alpha =
            static_cast<float>(alphaOf(lookUpNumber(rows, textureRow(textures, layout::slotRoughness), uv)));
    if (hasTexture(rows, textures, layout::slotMetallic))
        material.metallic =
            static_cast<float>(lookUpNumber(rows, textureRow(textures, layout::slotMetallic), uv));
    return material;
}

} // namespace hyalite::reference
