// Materials: what a scene says of a surface, and the tables of their kinds and keys.
//
// Made from the tables: the reader of "materials" in scene files, validation, most of the record that kernels read,
// and, by tests/scene/material_table_test.cpp, the schema and the tables of documents. To add a kind: its members,
// enumerator, keys and row here, its constant and fields in shaders/layout/layout.h, its lobe and its place in the
// dispatch in shaders/bsdf.
#pragma once

#include "host/base/interval.h"
#include "host/scene/limits.h"
#include "host/scene/metals.h"
#include "shaders/layout/layout.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace hyalite::core {

enum class MaterialKind : std::uint32_t {
    Diffuse = layout::materialDiffuse,
    Mirror = layout::materialMirror,
    Dielectric = layout::materialDielectric,
    Conductor = layout::materialConductor,
    Principled = layout::materialPrincipled,
    Gltf = layout::materialGltf,
    /// To kernels it is diffuse.
    ShadowCatcher = layout::materialDiffuse | layout::materialCatchesShadows,
};

/// Texture lookup beyond the edge of the image.
enum class Wrap : std::uint32_t { Repeat = 0, Mirror = 1, Clamp = 2 };

/// The channel of an image that is read where one number is wanted.
enum class Channel : std::uint32_t { Red = 0, Green = 1, Blue = 2, Alpha = 3 };

/// How a material wears one of the scene's textures: at (u, v) it shows what the image has at
/// (scale.x u + shear.x v + offset.x, shear.y u + scale.y v + offset.y). Images begin at the bottom left, v = 0, and
/// end at the top, v = 1.
struct TextureUse {
    std::uint32_t textureIndex = 0;
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};
    glm::vec2 shear{0.0f};
    std::uint32_t uvSet = 0; ///< 1: TriangleMesh::secondUvs
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    bool isNearest = false;         ///< the nearest texel alone, instead of the bilinear filter
    Channel channel = Channel::Red; ///< of slots that want one number
};

/// Uses of textures, by layout::slot...
using TextureSlots = std::array<std::optional<TextureUse>, layout::textureSlotCount>;

/// Where a surface is not there. CutOut: where its opacity is below alphaCutoff. Blend: with a probability of
/// 1 - opacity, for each ray anew.
enum class AlphaMode : std::uint32_t { Opaque = 0, CutOut = 1, Blend = 2 };

struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::Diffuse;
    glm::vec3 albedo{0.5f};       ///< Diffuse: in [0, 1]; Principled, Gltf: its base colour
    bool twoSided = false;        ///< Diffuse, Principled, Gltf: reflects and emits on both sides
    bool reflectsBehind = false;  ///< the same three: reflects on both sides, and emits on that of the normal
    float refractiveIndex = 1.5f; ///< Dielectric, Principled, Gltf: relative to the surroundings, in [1, 10]
    /// Dielectric: factor on all that a segment inside returns, whatever its length; Whitted only.
    glm::vec3 segmentTint{1.0f};
    glm::vec3 absorption{0.0f}; ///< of glass of any kind: per unit of length, >= 0; path only
    float dispersion = 0.0f;    ///< 20 / the Abbe number of the refractive index, in [0, 20]
    int priority = 0;           ///< where glass overlaps, that of the highest is there; path only
    /// Diffuse, Principled, Gltf: radiance on the side of the normal, on both where twoSided; >= 0.
    glm::vec3 emission{0.0f};
    std::string lightGroup{}; ///< of what it emits: isLightGroupName() (light_groups.h), or empty
    /// Conductor: real part of the refractive index, in [0, 20].
    glm::vec3 conductorIndex = metalNames[0].second.index;
    glm::vec3 conductorExtinction = metalNames[0].second.extinction; ///< and its imaginary part, in [0, 20]
    float roughness = 0.0f;    ///< Dielectric, Conductor, Principled, Gltf: in [0, 1]
    float metallic = 0.0f;     ///< Principled, Gltf: in [0, 1], as are those that follow
    float specular = 0.5f;     ///< reflectance seen head on, 0.5 being that of the refractive index
    float transmission = 0.0f; ///< share of what is no metal that is glass
    float clearcoat = 0.0f;    ///< and then transmission is 0
    float clearcoatRoughness = 0.1f;
    // Gltf: as glTF's specification and its extensions KHR_materials_... define them.
    float dielectricWeight = 1.0f;        ///< KHR_materials_specular: specularFactor, in [0, 1]
    glm::vec3 dielectricColour{1.0f};     ///< specularColorFactor, in [0, 1e30]
    glm::vec3 sheenColour{0.0f};          ///< in [0, 1]
    float sheenRoughness = 0.0f;          ///< in [0, 1]
    float anisotropy = 0.0f;              ///< strength, in [0, 1]
    float anisotropyRotation = 0.0f;      ///< radians, counter-clockwise from the tangent along u
    float clearcoatNormalStrength = 1.0f; ///< in [0, 100]
    float iridescence = 0.0f;             ///< KHR_materials_iridescence: share of the film, in [0, 1]
    float iridescenceIndex = 1.3f;        ///< of the film, in [1, 10]
    float iridescenceThickness = 400.0f;  ///< nanometres, in [0, 1e5]; with a texture, where that is 1
    /// Where the texture is 0; it may be more than where that is 1.
    float iridescenceThicknessMinimum = 100.0f;
    float diffuseTransmission = 0.0f; ///< KHR_materials_diffuse_transmission: share of the base, in [0, 1]
    glm::vec3 diffuseTransmissionColour{1.0f}; ///< that light has beyond, in [0, 1]
    bool isThin = false; ///< a surface without volume behind it: what it transmits is not refracted
    /// KHR_materials_pbrSpecularGlossiness: dielectricColour is the reflectance at normal incidence.
    bool isSpecularGlossy = false;
    bool isUnlit = false; ///< KHR_materials_unlit: shows its base colour and reflects nothing
    // Diffuse, Principled, Gltf
    AlphaMode alphaMode = AlphaMode::CutOut;
    float opacity = 1.0f;        ///< in [0, 1]; a factor on that of the texture and of the mesh's colours
    float alphaCutoff = 0.5f;    ///< CutOut, >= 0
    bool isCulled = false;       ///< triangles are not there for rays that come from behind
    TextureSlots textures{};     ///< Diffuse, Principled, Gltf: most are factors on what is above
    float normalStrength = 1.0f; ///< how far a normal map turns normals; in [0, 100]
};

/// Whether a triangle of the material is absent in places, by its own opacity or by that of its texture or its colours.
/// A cutoff above 1 hides what is opaque, too.
[[nodiscard]] inline bool isAlphaTested(const Material &material, bool hasTransparentColours) {
    const bool hidesAll = material.alphaMode == AlphaMode::CutOut && material.alphaCutoff > 1.0f;
    return material.alphaMode != AlphaMode::Opaque &&
           (hidesAll || material.opacity < 1.0f || hasTransparentColours ||
            material.textures[layout::slotOpacity].has_value());
}

/// Whether light passes the material, and is refracted.
[[nodiscard]] inline bool isGlass(const Material &material) {
    return material.kind == MaterialKind::Dielectric ||
           (material.kind == MaterialKind::Principled && material.transmission > 0.0f) ||
           (material.kind == MaterialKind::Gltf && material.transmission > 0.0f && !material.isThin);
}

/// Whether light goes on in a medium beyond the material: in glass, or in what absorbs it below a base that lets it
/// through.
[[nodiscard]] inline bool holdsMedium(const Material &material) {
    return isGlass(material) || (material.kind == MaterialKind::Gltf && material.diffuseTransmission > 0.0f &&
                                 !material.isThin && material.absorption != glm::vec3(0.0f));
}

// ---- Keys

struct NumberKey {
    float Material::*member;
    Interval allowed;
    float layout::MaterialRecord::*packed = nullptr; ///< where kernels read it as it is
};

struct ColourKey {
    glm::vec3 Material::*member;
    Interval allowed; ///< of each channel
    glm::vec3 layout::MaterialRecord::*packed = nullptr;
};

struct WholeKey {
    int Material::*member;
    Interval allowed;
};

struct FlagKey {
    bool Material::*member;
};

/// The name of a light group.
struct GroupKey {};

/// Whether both sides reflect and emit; without the key both reflect, and the side of the normal emits.
struct SidesKey {};

/// One of metalNames, for both parts of the refractive index.
struct MetalKey {};

struct MaterialKey {
    std::string_view key; ///< in scene files and messages
    /// Its default is the member's.
    std::variant<NumberKey, ColourKey, WholeKey, FlagKey, GroupKey, SidesKey, MetalKey> value;
    std::string_view help;
};

namespace material_keys {

using Record = layout::MaterialRecord;

inline constexpr SidesKey twoSided{};
inline constexpr ColourKey emission{&Material::emission, limits::radiance, &Record::emission};
inline constexpr NumberKey refractiveIndex{&Material::refractiveIndex, limits::refractiveIndex,
                                           &Record::refractiveIndex};
inline constexpr NumberKey dispersion{&Material::dispersion, limits::dispersion};
inline constexpr ColourKey absorption{&Material::absorption, limits::absorption, &Record::absorption};
inline constexpr WholeKey priority{&Material::priority, limits::priority};
inline constexpr NumberKey roughness{&Material::roughness, limits::fraction};

inline constexpr auto diffuse = std::to_array<MaterialKey>({
    {"albedo", ColourKey{&Material::albedo, limits::fraction, &Record::albedo},
     "share of the light that is reflected"},
    {"twoSided", twoSided,
     "both sides reflect and emit; `false`: the side of the normal alone, and the other one is black; by "
     "default both reflect, and that of the normal emits"},
    {"emission", emission,
     "radiance on the side of the normal, on both if `twoSided`; in `whitted` it is seen, but lights "
     "nothing"},
    {"lightGroup", GroupKey{}, "whose layer has what it emits, with `lightGroups`"},
});
inline constexpr auto shadowCatcher = std::to_array<MaterialKey>({
    {"albedo", ColourKey{&Material::albedo, limits::fraction, &Record::albedo},
     "share of the light that it reflects to other surfaces"},
    {"twoSided", twoSided, "as for diffuse"},
});
inline constexpr auto dielectric = std::to_array<MaterialKey>({
    {"index", refractiveIndex, "refractive index, relative to the medium around"},
    {"dispersion", dispersion,
     "20 divided by the Abbe number of `index`: how far waves are bent apart; crown glass has 0.34, flint "
     "glass 0.55, diamond 0.36; `path` only"},
    {"segmentTint", ColourKey{&Material::segmentTint, limits::fraction, &Record::segmentTint},
     "factor on everything that a segment inside returns, whatever its length; `whitted` only"},
    {"absorption", absorption, "absorption per unit of length, by Beer's law; `path` only"},
    {"priority", priority,
     "where dielectrics overlap or have a face in common, the one of highest priority wins; `path` only"},
    {"roughness", roughness, "0 is smooth; `path` only"},
});
inline constexpr auto conductor = std::to_array<MaterialKey>({
    {"metal", MetalKey{}, "Hagemann, Gudat and Kunz, 1974, at 650, 550 and 450 nm"},
    {"index", ColourKey{&Material::conductorIndex, limits::conductorIndex},
     "real part of the refractive index, instead of the metal's"},
    {"extinction", ColourKey{&Material::conductorExtinction, limits::conductorIndex},
     "imaginary part of the refractive index, instead of the metal's"},
    {"roughness", roughness, "0 is smooth; `path` only"},
});
inline constexpr auto principled = std::to_array<MaterialKey>({
    {"baseColour", ColourKey{&Material::albedo, limits::fraction, &Record::albedo},
     "colour of metal at normal incidence, of the base below plastic, and of light that passes through "
     "glass"},
    {"metallic", NumberKey{&Material::metallic, limits::fraction, &Record::metallic}, "share of metal"},
    {"roughness", roughness, "at least 0.04 is used"},
    {"specular", NumberKey{&Material::specular, limits::fraction},
     "reflectance of the surface of plastic; 0.5 is that of `index`"},
    {"transmission", NumberKey{&Material::transmission, limits::fraction, &Record::transmission},
     "share of glass in what is not metal; not with `clearcoat`"},
    {"index", refractiveIndex, "refractive index"},
    {"absorption", absorption, "as for a dielectric"},
    {"priority", priority, "as for a dielectric"},
    {"clearcoat", NumberKey{&Material::clearcoat, limits::fraction, &Record::clearcoat},
     "a clear coat above everything"},
    {"clearcoatRoughness", NumberKey{&Material::clearcoatRoughness, limits::fraction},
     "at least 0.04 is used"},
    {"twoSided", twoSided, "as for diffuse"},
    {"emission", emission, "as for diffuse"},
    {"lightGroup", GroupKey{}, "as for diffuse"},
});
inline constexpr auto gltf = std::to_array<MaterialKey>({
    {"baseColour", ColourKey{&Material::albedo, limits::fraction, &Record::albedo},
     "colour of metal at normal incidence, of the base below plastic, and of light that passes the surface "
     "once"},
    {"metallic", NumberKey{&Material::metallic, limits::fraction, &Record::metallic}, "share of metal"},
    {"roughness", roughness, "at least 0.04 is used"},
    {"index", refractiveIndex, "refractive index"},
    {"dielectricWeight", NumberKey{&Material::dielectricWeight, limits::fraction, &Record::dielectricWeight},
     "factor on the reflectance of plastic at all angles"},
    {"dielectricColour", ColourKey{&Material::dielectricColour, limits::radiance, &Record::dielectricColour},
     "factor on the reflectance of plastic at normal incidence, which is at most 1"},
    {"transmission", NumberKey{&Material::transmission, limits::fraction, &Record::transmission},
     "share of glass in what is not metal"},
    {"thin", FlagKey{&Material::isThin},
     "glass is a surface without volume behind it, and does not bend light"},
    {"dispersion", dispersion, "as for a dielectric; of glass that is not `thin`"},
    {"absorption", absorption, "as for a dielectric"},
    {"priority", priority, "as for a dielectric"},
    {"clearcoat", NumberKey{&Material::clearcoat, limits::fraction, &Record::clearcoat},
     "a clear coat above everything"},
    {"clearcoatRoughness", NumberKey{&Material::clearcoatRoughness, limits::fraction},
     "at least 0.04 is used"},
    {"clearcoatNormalStrength",
     NumberKey{&Material::clearcoatNormalStrength, limits::normalStrength, &Record::clearcoatNormalStrength},
     "how far the coat's normal map turns normals"},
    {"sheenColour", ColourKey{&Material::sheenColour, limits::fraction, &Record::sheenColour},
     "colour of fibres above all but the coat; 0: none"},
    {"sheenRoughness", NumberKey{&Material::sheenRoughness, limits::fraction}, "at least 0.07 is used"},
    {"anisotropy", NumberKey{&Material::anisotropy, limits::fraction, &Record::anisotropy},
     "how far facets are stretched; not those of glass"},
    {"anisotropyRotation", NumberKey{&Material::anisotropyRotation, limits::radians},
     "of the direction in which they are stretched, in radians from the one in which u grows"},
    {"iridescence", NumberKey{&Material::iridescence, limits::fraction, &Record::iridescence},
     "share of the surface below a thin film, whose colours change with the angle; below coat and sheen"},
    {"iridescenceIndex",
     NumberKey{&Material::iridescenceIndex, limits::refractiveIndex, &Record::iridescenceIndex},
     "refractive index of the film"},
    {"iridescenceThickness",
     NumberKey{&Material::iridescenceThickness, limits::filmThickness, &Record::iridescenceThickness},
     "in nanometres; 0: no film; with a texture, where that is 1"},
    {"iridescenceThicknessMinimum",
     NumberKey{&Material::iridescenceThicknessMinimum, limits::filmThickness,
               &Record::iridescenceThicknessMinimum},
     "where the texture is 0; it may be more than the other"},
    {"diffuseTransmission",
     NumberKey{&Material::diffuseTransmission, limits::fraction, &Record::diffuseTransmission},
     "share of the base below plastic that sends light on beyond the surface, to all directions alike"},
    {"diffuseTransmissionColour",
     ColourKey{&Material::diffuseTransmissionColour, limits::fraction, &Record::diffuseTransmissionColour},
     "the base's colour there; with `absorption` and without `thin`, light goes on in what absorbs it"},
    {"unlit", FlagKey{&Material::isUnlit}, "shows its base colour, whatever the light"},
    {"opacity", NumberKey{&Material::opacity, limits::fraction, &Record::opacity},
     "factor on that of textures and vertices; meshes only"},
    {"alphaCutoff", NumberKey{&Material::alphaCutoff, limits::alphaCutoff},
     "the surface is not there where its opacity is below"},
    {"twoSided", twoSided, "as for diffuse"},
    {"emission", emission, "as for diffuse"},
    {"lightGroup", GroupKey{}, "as for diffuse"},
});

} // namespace material_keys

/// Use of a texture.
struct TextureSlot {
    std::string_view name; ///< in scene files
    std::uint32_t slot;    ///< layout::slot...
    std::string_view help{};
};

inline constexpr std::array<TextureSlot, layout::textureSlotCount> textureSlots{
    {{"baseColour", layout::slotBaseColour},
     {"emission", layout::slotEmission},
     {"roughness", layout::slotRoughness, "its red channel"},
     {"metallic", layout::slotMetallic, "its red channel"},
     {"normal", layout::slotNormal},
     {"opacity", layout::slotOpacity,
      "its alpha, or its red channel where it has none: below a half nothing is there; meshes only"},
     {"transmission", layout::slotTransmission, "its red channel"},
     {"clearcoat", layout::slotClearcoat, "its red channel"},
     {"clearcoatRoughness", layout::slotClearcoatRoughness, "its red channel"},
     {"clearcoatNormal", layout::slotClearcoatNormal},
     {"dielectricWeight", layout::slotDielectricWeight, "its red channel"},
     {"dielectricColour", layout::slotDielectricColour},
     {"sheenColour", layout::slotSheenColour},
     {"sheenRoughness", layout::slotSheenRoughness, "its red channel"},
     {"anisotropy", layout::slotAnisotropy, "a direction in red and green, a factor on the strength in blue"},
     {"iridescence", layout::slotIridescence, "its red channel"},
     {"iridescenceThickness", layout::slotIridescenceThickness, "its red channel"},
     {"diffuseTransmission", layout::slotDiffuseTransmission, "its red channel"},
     {"diffuseTransmissionColour", layout::slotDiffuseTransmissionColour}}};

// ---- Kinds

struct MaterialRow {
    MaterialKind kind;
    std::string_view name; ///< "type" in scene files
    std::string_view help;
    std::span<const MaterialKey> keys{};
    std::uint32_t textures = 0; ///< bits 1 << layout::slot...: those that it may wear
    float defaultRoughness = 0.0f;
    bool scattersDiffusely = false; ///< unless light passes; otherwise rays go on to what it mirrors
    /// Bits of layout::scattersAt...: what it needs of the path integrator.
    std::uint32_t (*scattering)(const Material &) = [](const Material &) { return 0u; };
};

/// MaterialRow::scattering of glTF's materials.
[[nodiscard]] constexpr std::uint32_t scatteringOfGltf(const Material &material) {
    if (material.isUnlit)
        return layout::scattersAtUnlit;
    const auto has = [&](std::uint32_t slot) { return material.textures[slot].has_value(); };
    std::uint32_t bits = layout::scattersAtGltf;
    if (material.transmission > 0.0f && !material.isThin && material.dispersion > 0.0f)
        bits |= layout::scattersAtDispersion;
    if (material.transmission > 0.0f)
        bits |= material.isThin ? layout::scattersAtThin : layout::scattersAtRoughGlass;
    if (material.sheenColour != glm::vec3(0.0f))
        bits |= layout::scattersAtSheen;
    if (material.anisotropy > 0.0f)
        bits |= layout::scattersAtAnisotropic;
    const bool isThick =
        material.iridescenceThickness > 0.0f ||
        (has(layout::slotIridescenceThickness) && material.iridescenceThicknessMinimum > 0.0f);
    if (material.iridescence > 0.0f && isThick)
        bits |= layout::scattersAtIridescent;
    if (material.diffuseTransmission > 0.0f)
        bits |= layout::scattersAtDiffuseTransmission;
    if (material.clearcoat > 0.0f && (has(layout::slotNormal) || has(layout::slotClearcoatNormal)))
        bits |= layout::scattersAtCoatNormals;
    return bits;
}

inline constexpr auto materialTable = std::to_array<MaterialRow>({
    {.kind = MaterialKind::Diffuse,
     .name = "diffuse",
     .help = "a matt surface",
     .keys = material_keys::diffuse,
     .textures = layout::texturesBaseColour | layout::texturesEmission | layout::texturesNormal |
                 layout::texturesOpacity,
     .scattersDiffusely = true},
    {.kind = MaterialKind::Mirror, .name = "mirror", .help = "a mirror without loss"},
    {.kind = MaterialKind::Dielectric,
     .name = "dielectric",
     .help = "glass and the like, which reflects and refracts by Fresnel's equations",
     .keys = material_keys::dielectric,
     .scattering =
         [](const Material &material) {
             return (material.roughness > 0.0f ? layout::scattersAtRoughGlass : 0u) |
                    (material.dispersion > 0.0f ? layout::scattersAtDispersion : 0u);
         }},
    {.kind = MaterialKind::Conductor,
     .name = "conductor",
     .help = "a metal, by Fresnel's equations for its complex refractive index",
     .keys = material_keys::conductor,
     .scattering =
         [](const Material &material) {
             return layout::scattersAtConductors |
                    (material.roughness > 0.0f ? layout::scattersAtRoughConductors : 0u);
         }},
    {.kind = MaterialKind::Principled,
     .name = "principled",
     .help = "a mixture of metal, plastic and glass under a clear coat",
     .keys = material_keys::principled,
     .textures = layout::texturesBaseColour | layout::texturesEmission | layout::texturesRoughness |
                 layout::texturesMetallic | layout::texturesNormal | layout::texturesOpacity,
     .defaultRoughness = 0.5f,
     .scattersDiffusely = true,
     .scattering =
         [](const Material &material) {
             return layout::scattersAtPrincipled | (isGlass(material) ? layout::scattersAtRoughGlass : 0u);
         }},
    {.kind = MaterialKind::Gltf,
     .name = "gltf",
     .help = "the material of glTF 2.0: metal, plastic and glass below a film, sheen and a clear coat",
     .keys = material_keys::gltf,
     .textures = (1u << layout::textureSlotCount) - 1u,
     .defaultRoughness = 1.0f,
     .scattersDiffusely = true,
     .scattering = scatteringOfGltf},
    {.kind = MaterialKind::ShadowCatcher,
     .name = "shadowCatcher",
     .help = "with `alpha` transparent but for the light that it lacks, and matt to other surfaces; "
             "otherwise matt",
     .keys = material_keys::shadowCatcher,
     .textures = layout::texturesBaseColour | layout::texturesNormal | layout::texturesOpacity,
     .scattersDiffusely = true},
});

[[nodiscard]] constexpr const MaterialRow &rowOf(MaterialKind kind) {
    return *std::ranges::find(materialTable, kind, &MaterialRow::kind);
}

} // namespace hyalite::core
