#include "host/packing/texture_rows.h"

#include "host/image/tone_curve.h"
#include "host/packing/surface_features.h"
#include "host/scene/instances.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

namespace hyalite::core {

namespace {

using Rows = RecordVector<layout::TextureRow>;

layout::TextureRow rowOf(float x, float y, float z, float w) {
    return {std::bit_cast<std::uint32_t>(x), std::bit_cast<std::uint32_t>(y), std::bit_cast<std::uint32_t>(z),
            std::bit_cast<std::uint32_t>(w)};
}

template <class Decode> void addTable(Rows &rows, const Decode &decode) {
    const auto entry = [&](std::uint32_t level) { return static_cast<float>(decode(level / 255.0)); };
    for (std::uint32_t level = 0; level < 256; level += 4)
        rows.push_back(rowOf(entry(level), entry(level + 1), entry(level + 2), entry(level + 3)));
}

/// A triangle of a mesh.
struct TriangleOfMesh {
    const TriangleMesh *mesh;
    std::uint32_t index;
};

/// Finds the mesh of a triangle record.
class MeshOfRecord {
  public:
    MeshOfRecord(const Scene &scene, const PackedScene &packed)
        : scene_(scene), packed_(packed), firstTriangles_(inputOrder(scene).meshes) {}

    [[nodiscard]] TriangleOfMesh operator()(std::uint32_t record) const {
        const std::uint32_t id = packed_.triangles[record].primitiveId;
        const auto nextTree = std::ranges::upper_bound(packed_.trees, record, {}, &PackedTree::firstRecord);
        if (const auto tree = nextTree - packed_.trees.begin(); tree > 1)
            return {&scene_.prototypes[static_cast<std::size_t>(tree) - 2], id};
        const std::uint32_t index = id - packed_.frame.firstTriangleId;
        // Meshes without triangles begin where the next one does; this finds the last of them.
        const auto next = std::ranges::upper_bound(firstTriangles_, index);
        return {&scene_.meshes[static_cast<std::size_t>(next - firstTriangles_.begin() - 1)],
                index - *(next - 1)};
    }

  private:
    const Scene &scene_;
    const PackedScene &packed_;
    std::vector<std::uint32_t> firstTriangles_;
};

/// Writes the texture coordinates of a triangle.
void writeCoordinates(std::span<const glm::vec2> uvs, const glm::uvec3 &corners, layout::TextureRow *at) {
    const glm::vec2 a = uvs[corners.x];
    const glm::vec2 b = uvs[corners.y];
    const glm::vec2 c = uvs[corners.z];
    at[0] = rowOf(a.x, a.y, b.x, b.y);
    at[1] = rowOf(c.x, c.y, 0.0f, 0.0f);
}

/// Writes a row for each corner of a triangle, or `fallback` where it has no values.
void writeCorners(const CornerValues<glm::vec4> &attribute, std::size_t triangle, const glm::vec4 &fallback,
                  layout::TextureRow *at) {
    const bool hasValues =
        !attribute.corners.empty() && attribute.corners[triangle].x != CornerValues<glm::vec4>::none;
    for (glm::length_t corner = 0; corner < 3; ++corner) {
        const glm::vec4 &value = hasValues ? attribute.values[attribute.corners[triangle][corner]] : fallback;
        at[corner] = rowOf(value.x, value.y, value.z, value.w);
    }
}

/// Writes all that textures have of a triangle. Texture coordinates and tangents that it lacks are 0, colours 1.
void writeTriangle(const TriangleMesh &mesh, std::size_t triangle, std::uint32_t texturing,
                   layout::TextureRow *at) {
    if (!mesh.triangleUvs.empty() && mesh.triangleUvs[triangle].x != TriangleMesh::noUv)
        writeCoordinates(mesh.uvs, mesh.triangleUvs[triangle], at);
    at += layout::rowsPerCoordinates;
    if ((texturing & layout::texturesSecondUv) != 0) {
        if (!mesh.secondUvs.corners.empty() &&
            mesh.secondUvs.corners[triangle].x != CornerValues<glm::vec2>::none)
            writeCoordinates(mesh.secondUvs.values, mesh.secondUvs.corners[triangle], at);
        at += layout::rowsPerCoordinates;
    }
    if ((texturing & layout::texturesColours) != 0) {
        writeCorners(mesh.colours, triangle, glm::vec4(1.0f), at);
        at += 3;
    }
    if ((texturing & layout::texturesTangents) != 0)
        writeCorners(mesh.tangents, triangle, glm::vec4(0.0f), at);
}

/// Appends what textures have of all triangle records.
void addTriangles(const Scene &scene, const PackedScene &packed, Rows &rows) {
    const MeshOfRecord meshOfRecord(scene, packed);
    const std::size_t first = rows.size();
    const std::size_t rowsEach = layout::rowsPerTriangle(packed.texturing);
    rows.resize(first + rowsEach * packed.triangles.size(), layout::TextureRow{});
    const auto total = static_cast<std::int64_t>(packed.triangles.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < total; ++i) {
        const std::size_t record = static_cast<std::size_t>(i);
        if ((packed.triangles[record].flags & layout::triangleIsSphere) != 0)
            continue;
        const auto [meshAt, index] = meshOfRecord(static_cast<std::uint32_t>(i));
        writeTriangle(*meshAt, index, packed.texturing, &rows[first + rowsEach * record]);
    }
}

/// How the texels of an image in a slot are decoded: layout::textureIsFloat, textureIsSrgb or 0.
std::uint32_t decodingOf(const Texture &texture, std::uint32_t slot) {
    if (texture.isFloat())
        return layout::textureIsFloat;
    return (layout::texturesSrgb >> slot & 1u) != 0 ? layout::textureIsSrgb : 0u;
}

/// A stored image.
struct StoredImage {
    const Texture *texture;
    std::uint32_t decoding; ///< decodingOf its slots; 0, for all slots, if it stays 8-bit levels
    std::size_t firstRow = 0;

    bool operator==(const StoredImage &other) const {
        return texture == other.texture && decoding == other.decoding;
    }
};

/// The images of a scene. Levels are stored once, decoded images once for each decoding.
class ImageStore {
  public:
    /// Decodes levels if all decoded images take at most `maxDecoded` bytes: a texel is then a single read.
    ImageStore(const Scene &scene, std::size_t maxDecoded) : scene_(scene) {
        std::size_t pixelCount = 0;
        forEachUse([&](const TextureUse &use, std::uint32_t slot) {
            const Texture &texture = scene_.textures[use.textureIndex];
            pixelCount += add({&texture, storedDecoding(texture, use, slot)}) ? texture.pixelCount() : 0;
        });
        areDecoded_ = pixelCount <= maxDecoded / sizeof(layout::TextureRow);
        if (areDecoded_)
            return;
        images_.clear();
        forEachUse([&](const TextureUse &use, std::uint32_t slot) {
            const Texture &texture = scene_.textures[use.textureIndex];
            add({&texture, storedDecoding(texture, use, slot)});
        });
    }

    [[nodiscard]] bool hasLevels() const {
        return std::ranges::any_of(images_, [&](const auto &image) { return isOfLevels(image); });
    }

    /// Assigns rows to all images, from `row` on, and returns the first row after them.
    std::size_t place(std::size_t row) {
        for (StoredImage &image : images_) {
            image.firstRow = row;
            row += rowCount(image);
        }
        return row;
    }

    /// Sets the first row and the format of an image in a slot.
    void describe(const TextureUse &use, std::uint32_t slot, layout::TextureRecord &record) const {
        const Texture &texture = scene_.textures[use.textureIndex];
        const auto image =
            std::ranges::find(images_, StoredImage{&texture, storedDecoding(texture, use, slot)});
        record.firstRow = static_cast<std::uint32_t>(image->firstRow);
        record.format = isOfLevels(*image) ? decodingOf(texture, slot) : layout::textureIsFloat;
        record.format |= channelOf(texture, use, slot) << layout::textureChannelShift |
                         (use.uvSet != 0 ? layout::textureUsesSecondUv : 0u) |
                         (use.isNearest ? layout::textureIsNearest : 0u) |
                         static_cast<std::uint32_t>(use.wrapU) << layout::textureWrapShiftU |
                         static_cast<std::uint32_t>(use.wrapV) << layout::textureWrapShiftV;
    }

    /// Appends all images in the order of their rows. The decoding tables must be in `rows`.
    void append(Rows &rows) const {
        for (const StoredImage &image : images_) {
            if (isOfLevels(image))
                appendLevels(image, rows);
            else if (image.texture->isFloat())
                for (const glm::vec3 &value : image.texture->values)
                    rows.push_back(rowOf(value.x, value.y, value.z, 0.0f));
            else
                appendDecoded(image, rows);
        }
    }

  private:
    template <class Action> void forEachUse(const Action &action) const {
        for (const Material &material : scene_.materials)
            for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot)
                if (const std::optional<TextureUse> &use = material.textures[slot])
                    action(*use, slot);
    }

    /// Decoded images have alpha whatever else they decode: most often the colours beside it are used, too.
    [[nodiscard]] std::uint32_t storedDecoding(const Texture &texture, const TextureUse &use,
                                               std::uint32_t slot) const {
        if (!areDecoded_ && !texture.isFloat())
            return 0;
        const bool isAlpha = channelOf(texture, use, slot) == static_cast<std::uint32_t>(Channel::Alpha);
        return isAlpha && !texture.isFloat() ? layout::textureIsSrgb : decodingOf(texture, slot);
    }

    [[nodiscard]] bool isOfLevels(const StoredImage &image) const {
        return !areDecoded_ && !image.texture->isFloat();
    }

    [[nodiscard]] std::size_t rowCount(const StoredImage &image) const {
        const std::size_t pixelCount = image.texture->pixelCount();
        return isOfLevels(image) ? (pixelCount + 3) / 4 : pixelCount;
    }

    /// Returns whether the image was new.
    bool add(const StoredImage &image) {
        if (std::ranges::count(images_, image) > 0)
            return false;
        images_.push_back(image);
        return true;
    }

    void appendLevels(const StoredImage &image, Rows &rows) const {
        const std::vector<std::uint32_t> &levels = image.texture->levels;
        const std::size_t first = rows.size();
        rows.resize(first + rowCount(image), layout::TextureRow{});
        std::memcpy(&rows[first], levels.data(), levels.size() * sizeof(levels[0]));
    }

    static std::vector<std::uint32_t> tableAt(const Rows &rows, std::size_t first) {
        std::vector<std::uint32_t> words(256);
        std::memcpy(words.data(), &rows[first], words.size() * sizeof(words[0]));
        return words;
    }

    /// Decodes with the tables of the kernels, so that a lookup has the same bits either way.
    void appendDecoded(const StoredImage &image, Rows &rows) const {
        const std::size_t table =
            (image.decoding & layout::textureIsSrgb) != 0 ? layout::srgbTableRow : layout::linearTableRow;
        const std::vector<std::uint32_t> words = tableAt(rows, table);
        const std::vector<std::uint32_t> alphas = tableAt(rows, layout::linearTableRow);
        const std::size_t first = rows.size();
        rows.resize(first + rowCount(image));
        const auto total = static_cast<std::int64_t>(rowCount(image));
        assert(image.texture->levels.size() == rowCount(image));
#pragma omp parallel for schedule(static)
        for (std::int64_t i = 0; i < total; ++i) {
            const std::uint32_t levels = image.texture->levels[static_cast<std::size_t>(i)];
            rows[first + static_cast<std::size_t>(i)] = {words[levels & 255u], words[levels >> 8u & 255u],
                                                         words[levels >> 16u & 255u], alphas[levels >> 24u]};
        }
    }

    const Scene &scene_;
    std::vector<StoredImage> images_;
    bool areDecoded_ = true;
};

float factorOf(const Material &material, std::uint32_t slot) {
    switch (slot) {
    case layout::slotRoughness:
        return material.roughness;
    case layout::slotMetallic:
        return material.metallic;
    case layout::slotNormal:
        return material.normalStrength;
    case layout::slotClearcoatRoughness:
        return material.clearcoatRoughness;
    case layout::slotClearcoatNormal:
        return material.clearcoatNormalStrength;
    case layout::slotSheenRoughness:
        return material.sheenRoughness;
    default:
        return 1.0f;
    }
}

layout::TextureRecord recordOf(const ImageStore &images, const Texture &texture, const TextureUse &use,
                               const Material &material, std::uint32_t slot) {
    layout::TextureRecord record{};
    images.describe(use, slot, record);
    record.size = static_cast<std::uint32_t>(texture.width) | static_cast<std::uint32_t>(texture.height)
                                                                  << 16u;
    record.factor = factorOf(material, slot);
    record.scaleU = use.scale.x;
    record.scaleV = use.scale.y;
    record.offsetU = use.offset.x;
    record.offsetV = use.offset.y;
    record.shearU = use.shear.x;
    record.shearV = use.shear.y;
    return record;
}

bool hasTextures(const Material &material) {
    return std::ranges::any_of(material.textures, [](const auto &use) { return use.has_value(); });
}

} // namespace

void packTextures(const Scene &scene, std::span<const std::uint32_t> order, std::size_t maxDecoded,
                  PackedScene &packed) {
    const bool needsTangents = (packed.scattering & layout::scattersAtAnisotropic) != 0; // from coordinates
    if (packed.texturing == 0 && !needsTangents)
        return;
    constexpr std::size_t rowsPerMaterial = layout::rowsPerTexture * layout::textureSlotCount;
    std::size_t firstTexelRow =
        layout::firstCoordinateRow +
        std::size_t{layout::rowsPerTriangle(packed.texturing)} * packed.triangles.size();
    for (const Material &material : scene.materials)
        firstTexelRow += hasTextures(material) ? rowsPerMaterial : 0;
    ImageStore images(scene, maxDecoded);
    const std::size_t rowCount = images.place(firstTexelRow);
    packed.texturing |= images.hasLevels() ? layout::texturesLevels : 0u;

    Rows &rows = packed.textures;
    rows.reserve(rowCount);
    addTable(rows, srgbDecoded);
    addTable(rows, [](double level) { return level; });
    assert(rows.size() == layout::firstCoordinateRow);
    addTriangles(scene, packed, rows);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Material &material = scene.materials[order[i]];
        if (!hasTextures(material))
            continue;
        packed.materials[i].textures = static_cast<std::uint32_t>(rows.size());
        rows.resize(rows.size() + rowsPerMaterial, layout::TextureRow{});
        for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot)
            if (const std::optional<TextureUse> &use = material.textures[slot]) {
                const layout::TextureRecord record =
                    recordOf(images, scene.textures[use->textureIndex], *use, material, slot);
                std::memcpy(&rows[packed.materials[i].textures + layout::rowsPerTexture * slot], &record,
                            sizeof(record));
            }
    }
    assert(rows.size() == firstTexelRow);
    images.append(rows);
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

} // namespace hyalite::core
