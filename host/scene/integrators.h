// Integrators, one row each. To add one: its enumerator and row here, its kernel shaders/integrators/NAME.comp, and its
// twin in host/reference, which host/reference/renderer.cpp calls.
#pragma once

#include "shaders/layout/layout.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hyalite::core {

enum class Integrator {
    Whitted,
    Path,
    AmbientOcclusion,
    Normal,
    Depth,
    Albedo,
    Id,
    Uv,
    Shadow,
    Cost,
    ObjectNumber,
    MaterialNumber,
    PlaceNumber,
    ObjectMatte,
    MaterialMatte,
    AssetMatte
};

struct IntegratorRow {
    Integrator integrator;
    std::string_view name; ///< in scene files, options and reports
    std::string_view help;
    std::string_view kernel;                 ///< shaders/integrators/KERNEL.comp
    std::uint32_t view = layout::viewNormal; ///< what the kernel "view" shows
    std::string_view layerChannels{};        ///< of a view: those of its layer in an EXR
    /// As a layer it has one sample, at the pixel's centre: a mean of depths or normals belongs to no surface.
    bool isOfCentres = false;
    bool canLookThrough = false; ///< of a view: settings may ask for what mirrors and glass show
    bool showsLight = false;     ///< a sample is radiance, and the background may be transparent
    /// Of a view of numbers whose samples are counted, as a tally (host/film/tally.h): the name of the Cryptomatte.
    std::string_view cryptomatte{};
    bool followsPaths = false;   ///< over several segments: maxDepth bounds them
    bool splitsAtGlass = false;  ///< both branches: rays wait
    bool aimsAtEmitters = false; ///< needs the scene's emitters, and the energy tables of microfacets

    /// Whether its samples are numbers, which are for layers, not for pictures.
    [[nodiscard]] constexpr bool isOfNumbers() const {
        return kernel == "view" && view >= layout::viewObject;
    }
    [[nodiscard]] constexpr bool tallies() const { return !cryptomatte.empty(); }
};

/// In the order of help texts and documents.
inline constexpr auto integratorTable = std::to_array<IntegratorRow>({
    {.integrator = Integrator::Whitted,
     .name = "whitted",
     .help = "direct light, mirrors and both branches at glass",
     .kernel = "whitted",
     .showsLight = true,
     .followsPaths = true,
     .splitsAtGlass = true},
    {.integrator = Integrator::Path,
     .name = "path",
     .help = "global illumination by path tracing",
     .kernel = "path",
     .showsLight = true,
     .followsPaths = true,
     .aimsAtEmitters = true},
    {.integrator = Integrator::AmbientOcclusion,
     .name = "ao",
     .help = "ambient occlusion",
     .kernel = "view",
     .view = layout::viewOcclusion,
     .layerChannels = "Y"},
    {.integrator = Integrator::Normal,
     .name = "normal",
     .help = "shading normal of the first hit",
     .kernel = "view",
     .view = layout::viewNormal,
     .layerChannels = "XYZ",
     .isOfCentres = true,
     .canLookThrough = true},
    {.integrator = Integrator::Depth,
     .name = "depth",
     .help = "distance of the first hit",
     .kernel = "view",
     .view = layout::viewDepth,
     .layerChannels = "Z",
     .isOfCentres = true,
     .canLookThrough = true},
    {.integrator = Integrator::Albedo,
     .name = "albedo",
     .help = "albedo of the first hit",
     .kernel = "view",
     .view = layout::viewAlbedo,
     .layerChannels = "RGB",
     .canLookThrough = true},
    {.integrator = Integrator::Id,
     .name = "id",
     .help = "a colour for each primitive",
     .kernel = "view",
     .view = layout::viewId,
     .layerChannels = "RGB",
     .isOfCentres = true},
    {.integrator = Integrator::Uv,
     .name = "uv",
     .help = "texture coordinates, without their whole parts, as red and green",
     .kernel = "view",
     .view = layout::viewCoordinates,
     .layerChannels = "UV",
     .isOfCentres = true},
    {.integrator = Integrator::Shadow,
     .name = "shadow",
     .help = "light that shadow catchers lack: green for what they had alone, blue for what is blocked of it",
     .kernel = "view",
     .view = layout::viewShadow,
     .layerChannels = "Y",
     .aimsAtEmitters = true},
    {.integrator = Integrator::Cost,
     .name = "cost",
     .help =
         "nodes, boxes and triangles that the rays of whitted test: false colours in a PNG, counts in a PFM",
     .kernel = "whitted",
     .followsPaths = true,
     .splitsAtGlass = true},
    {.integrator = Integrator::ObjectNumber,
     .name = "object-id",
     .help = "number of the object: what has a name in the input",
     .kernel = "view",
     .view = layout::viewObject,
     .layerChannels = "Y",
     .isOfCentres = true},
    {.integrator = Integrator::MaterialNumber,
     .name = "material-id",
     .help = "number of the material",
     .kernel = "view",
     .view = layout::viewMaterial,
     .layerChannels = "Y",
     .isOfCentres = true},
    {.integrator = Integrator::PlaceNumber,
     .name = "instance-id",
     .help = "number of the sphere, the mesh, or the place of a mesh",
     .kernel = "view",
     .view = layout::viewPlace,
     .layerChannels = "Y",
     .isOfCentres = true},
    {.integrator = Integrator::ObjectMatte,
     .name = "crypto-object",
     .help = "Cryptomatte of objects",
     .kernel = "view",
     .view = layout::viewObject,
     .layerChannels = "rgba",
     .cryptomatte = "CryptoObject"},
    {.integrator = Integrator::MaterialMatte,
     .name = "crypto-material",
     .help = "Cryptomatte of materials",
     .kernel = "view",
     .view = layout::viewMaterial,
     .layerChannels = "rgba",
     .cryptomatte = "CryptoMaterial"},
    {.integrator = Integrator::AssetMatte,
     .name = "crypto-asset",
     .help = "Cryptomatte of assets: the outermost nodes above objects",
     .kernel = "view",
     .view = layout::viewAsset,
     .layerChannels = "rgba",
     .cryptomatte = "CryptoAsset"},
});

/// How many rows are of pictures; the others are of layers only.
inline constexpr std::size_t pictureIntegratorCount =
    integratorTable.size() -
    static_cast<std::size_t>(std::ranges::count_if(integratorTable, &IntegratorRow::isOfNumbers));
static_assert(std::ranges::is_partitioned(integratorTable,
                                          [](const IntegratorRow &row) { return !row.isOfNumbers(); }));

[[nodiscard]] constexpr const IntegratorRow &rowOf(Integrator integrator) {
    return *std::ranges::find(integratorTable, integrator, &IntegratorRow::integrator);
}

/// The integrators whose row has a true `member`.
template <bool IntegratorRow::*member> [[nodiscard]] constexpr auto integratorsThat() {
    std::array<Integrator, std::ranges::count(integratorTable, true, member)> found{};
    std::size_t count = 0;
    for (const IntegratorRow &row : integratorTable)
        if (row.*member)
            found[count++] = row.integrator;
    return found;
}

} // namespace hyalite::core
