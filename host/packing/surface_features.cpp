#include "host/packing/surface_features.h"

#include <algorithm>
#include <optional>

namespace hyalite::core {

namespace {

/// Slots that want one number of an image.
constexpr std::uint32_t numberSlots =
    layout::texturesMaterials + layout::texturesOpacity - layout::texturesSrgb - layout::texturesAnisotropy;

} // namespace

std::uint32_t channelOf(const Texture &texture, const TextureUse &use, std::uint32_t slot) {
    if ((numberSlots >> slot & 1u) == 0)
        return 0;
    if (slot == layout::slotOpacity && use.channel == Channel::Red && texture.hasAlpha)
        return static_cast<std::uint32_t>(Channel::Alpha);
    return static_cast<std::uint32_t>(use.channel);
}

std::uint32_t texturingOf(const Material &material, const std::vector<Texture> &textures) {
    std::uint32_t texturing = 0;
    for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot) {
        const std::optional<TextureUse> &use = material.textures[slot];
        if (!use)
            continue;
        texturing |= 1u << slot;
        if (use->uvSet != 0)
            texturing |= layout::texturesSecondUv;
        if (use->shear != glm::vec2(0.0f) || use->wrapU != Wrap::Repeat || use->wrapV != Wrap::Repeat ||
            use->isNearest)
            texturing |= layout::texturesPlaced;
        if (channelOf(textures[use->textureIndex], *use, slot) != 0)
            texturing |= layout::texturesChannels;
    }
    return texturing;
}

std::uint32_t texturingOf(const TriangleMesh &mesh) {
    return (mesh.triangleUvs.empty() ? 0u : layout::texturesCoordinates) |
           (mesh.colours.corners.empty() ? 0u : layout::texturesColours) |
           (mesh.tangents.corners.empty() ? 0u : layout::texturesTangents);
}

bool hasTransparentColours(const TriangleMesh &mesh) {
    return std::ranges::any_of(mesh.colours.values, [](const glm::vec4 &colour) { return colour.w < 1.0f; });
}

std::uint32_t anyHitOf(const Material &material, bool hasTransparentColours) {
    const std::uint32_t alphaTest =
        material.alphaMode == AlphaMode::Blend ? layout::anyHitBlended : layout::anyHitCutOut;
    return (isAlphaTested(material, hasTransparentColours) ? alphaTest : 0u) |
           (material.isCulled ? layout::anyHitCulled : 0u);
}

} // namespace hyalite::core
