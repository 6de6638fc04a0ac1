#include "host/bvh/textures.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

namespace hyalite {

namespace {

using Rows = std::vector<layout::TextureRow>;

layout::TextureRow rowOf(float x, float y, float z, float w) {
    return {std::bit_cast<std::uint32_t>(x), std::bit_cast<std::uint32_t>(y), std::bit_cast<std::uint32_t>(z),
            std::bit_cast<std::uint32_t>(w)};
}

/// IEC 61966-2-1: from what a screen takes to what is proportional to light.
double fromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

template <class Decode> void addTable(Rows &rows, const Decode &decode) {
    const auto entry = [&](std::uint32_t level) { return static_cast<float>(decode(level / 255.0)); };
    for (std::uint32_t level = 0; level < 256; level += 4)
        rows.push_back(rowOf(entry(level), entry(level + 1), entry(level + 2), entry(level + 3)));
}

/// Of all triangle records; 0 for triangles that have none.
void addCoordinates(const Scene &scene, const PackedScene &packed, Rows &rows) {
    std::vector<std::uint32_t> firstTriangles; // of each mesh
    std::uint32_t count = 0;
    for (const TriangleMesh &mesh : scene.meshes) {
        firstTriangles.push_back(count);
        count += static_cast<std::uint32_t>(mesh.triangles.size());
    }
    const std::size_t first = rows.size();
    rows.resize(first + layout::rowsPerCoordinates * packed.triangles.size());
    const auto total = static_cast<std::int64_t>(packed.triangles.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < total; ++i) {
        const std::size_t record = static_cast<std::size_t>(i);
        const std::uint32_t index = packed.triangles[record].primitiveId - layout::firstTriangleId;
        // Of meshes without triangles, which begin where the next one does, the last is found.
        const auto next = std::upper_bound(firstTriangles.begin(), firstTriangles.end(), index);
        const TriangleMesh &mesh = scene.meshes[static_cast<std::size_t>(next - firstTriangles.begin() - 1)];
        if (mesh.triangleUvs.empty())
            continue;
        const glm::uvec3 &corners = mesh.triangleUvs[index - *(next - 1)];
        if (corners.x == TriangleMesh::noUv)
            continue;
        const glm::vec2 a = mesh.uvs[corners.x];
        const glm::vec2 b = mesh.uvs[corners.y];
        const glm::vec2 c = mesh.uvs[corners.z];
        layout::TextureRow *const at = &rows[first + layout::rowsPerCoordinates * record];
        at[0] = rowOf(a.x, a.y, b.x, b.y);
        at[1] = rowOf(c.x, c.y, 0.0f, 0.0f);
    }
}

std::size_t texelRowCount(const Texture &texture) {
    return texture.isFloat() ? texture.pixelCount() : (texture.pixelCount() + 3) / 4;
}

void addTexels(const Texture &texture, Rows &rows) {
    if (texture.isFloat()) {
        for (const glm::vec3 &value : texture.values)
            rows.push_back(rowOf(value.x, value.y, value.z, 0.0f));
        return;
    }
    const std::size_t first = rows.size();
    rows.resize(first + texelRowCount(texture), layout::TextureRow{});
    std::memcpy(&rows[first], texture.levels.data(), texture.levels.size() * sizeof(texture.levels[0]));
}

std::uint32_t formatOf(const Texture &texture, std::uint32_t slot) {
    if (texture.isFloat())
        return layout::textureIsFloat;
    if (slot == layout::slotBaseColour || slot == layout::slotEmission)
        return layout::textureIsSrgb;
    return slot == layout::slotOpacity && texture.hasAlpha ? layout::textureIsAlpha : 0u;
}

float factorOf(const Material &material, std::uint32_t slot) {
    switch (slot) {
    case layout::slotRoughness:
        return material.roughness;
    case layout::slotMetallic:
        return material.metallic;
    case layout::slotNormal:
        return material.normalStrength;
    default:
        return 1.0f;
    }
}

layout::TextureRecord recordOf(const Texture &texture, std::uint32_t firstRow, const TextureUse &use,
                               const Material &material, std::uint32_t slot) {
    layout::TextureRecord record{};
    record.firstRow = firstRow;
    record.size = static_cast<std::uint32_t>(texture.width) | static_cast<std::uint32_t>(texture.height)
                                                                  << 16u;
    record.format = formatOf(texture, slot);
    record.factor = factorOf(material, slot);
    record.scaleU = use.scale.x;
    record.scaleV = use.scale.y;
    record.offsetU = use.offset.x;
    record.offsetV = use.offset.y;
    return record;
}

bool hasTextures(const Material &material) {
    return std::ranges::any_of(material.textures, [](const auto &use) { return use.has_value(); });
}

} // namespace

void packTextures(const Scene &scene, std::span<const std::uint32_t> order, PackedScene &packed) {
    if (packed.texturing == 0 && scene.settings.integrator != Integrator::Uv)
        return;
    constexpr std::size_t rowsPerMaterial = layout::rowsPerTexture * layout::textureSlotCount;
    std::size_t firstTexelRow =
        layout::firstCoordinateRow + layout::rowsPerCoordinates * packed.triangles.size();
    for (const Material &material : scene.materials)
        firstTexelRow += hasTextures(material) ? rowsPerMaterial : 0;
    std::vector<std::uint32_t> firstRows;
    std::size_t rowCount = firstTexelRow;
    for (const Texture &texture : scene.textures) {
        firstRows.push_back(static_cast<std::uint32_t>(rowCount));
        rowCount += texelRowCount(texture);
    }

    Rows &rows = packed.textures;
    rows.reserve(rowCount);
    addTable(rows, fromSrgb);
    addTable(rows, [](double level) { return level; });
    assert(rows.size() == layout::firstCoordinateRow);
    addCoordinates(scene, packed, rows);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Material &material = scene.materials[order[i]];
        if (!hasTextures(material))
            continue;
        packed.materials[i].textures = static_cast<std::uint32_t>(rows.size());
        rows.resize(rows.size() + rowsPerMaterial, layout::TextureRow{});
        for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot)
            if (const std::optional<TextureUse> &use = material.textures[slot]) {
                const layout::TextureRecord record = recordOf(
                    scene.textures[use->textureIndex], firstRows[use->textureIndex], *use, material, slot);
                std::memcpy(&rows[packed.materials[i].textures + layout::rowsPerTexture * slot], &record,
                            sizeof(record));
            }
    }
    assert(rows.size() == firstTexelRow);
    for (const Texture &texture : scene.textures)
        addTexels(texture, rows);
    assert(rows.size() == rowCount);
}

glm::dvec3 meanEmissionFactor(const PackedScene &packed, const layout::MaterialRecord &material) {
    if (material.textures == 0)
        return glm::dvec3(1.0);
    layout::TextureRecord record;
    std::memcpy(&record, &packed.textures[material.textures + layout::rowsPerTexture * layout::slotEmission],
                sizeof(record));
    if (record.size == 0)
        return glm::dvec3(1.0);
    const std::size_t count = std::size_t{record.size & 0xFFFFu} * (record.size >> 16u);
    const layout::TextureRow *const texels = &packed.textures[record.firstRow];
    const auto number = [](std::uint32_t word) { return double{std::bit_cast<float>(word)}; };
    glm::dvec3 sum(0.0);
    if ((record.format & layout::textureIsFloat) != 0) {
        for (std::size_t i = 0; i < count; ++i)
            sum += glm::dvec3(number(texels[i].x), number(texels[i].y), number(texels[i].z));
        return sum / static_cast<double>(count);
    }
    const auto wordAt = [](const layout::TextureRow *from, std::size_t index) {
        const layout::TextureRow &row = from[index / 4];
        const std::uint32_t words[] = {row.x, row.y, row.z, row.w};
        return words[index % 4];
    };
    const layout::TextureRow *const table = &packed.textures[layout::srgbTableRow];
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t levels = wordAt(texels, i);
        sum += glm::dvec3(number(wordAt(table, levels & 255u)), number(wordAt(table, levels >> 8u & 255u)),
                          number(wordAt(table, levels >> 16u & 255u)));
    }
    return sum / static_cast<double>(count);
}

} // namespace hyalite
