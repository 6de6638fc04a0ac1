#include "host/packing/packed_scene.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/leaves/leaves.h"
#include "host/packing/emitters.h"
#include "host/packing/environment.h"
#include "host/packing/light_profiles.h"
#include "host/packing/listed_triangles.h"
#include "host/packing/media_at.h"
#include "host/packing/microfacet_energy.h"
#include "host/packing/packed_trees.h"
#include "host/packing/pixel_filter.h"
#include "host/packing/sheen_energy.h"
#include "host/packing/surface_features.h"
#include "host/packing/texture_rows.h"
#include "host/scene/geometry_hash.h"
#include "host/scene/light_groups.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

/// The fields of a frame that the camera decides.
void setCamera(const Camera &camera, layout::FrameRecord &frame) {
    const glm::dvec3 forward = glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    // Pixels per unit of pixelRight and pixelUp. With the focal length as the unit, directions stay near unit length at
    // every resolution.
    double scale = camera.width / (2.0 * std::tan(glm::radians(camera.horizontalFovDegrees) / 2.0));
    if (camera.kind == CameraKind::Orthographic)
        scale = camera.width / camera.viewWidth;
    else if (camera.kind == CameraKind::Panorama)
        scale = 1.0;
    frame.eye = glm::vec3(camera.position);
    frame.imageWidth = static_cast<std::uint32_t>(camera.width);
    frame.imageHeight = static_cast<std::uint32_t>(camera.height);
    frame.pixelRight = glm::vec3(right / scale);
    frame.pixelUp = glm::vec3(up / scale);
    frame.lensScale = static_cast<float>(0.5 * camera.aperture * scale);
    frame.focusDistance = static_cast<float>(camera.focusDistance);
    frame.imagePlane = glm::vec3(forward);
}

layout::FrameRecord packFrame(const Scene &scene) {
    layout::FrameRecord frame{};
    setCamera(scene.camera, frame);
    frame.lightCount = static_cast<std::uint32_t>(scene.lights.size());
    frame.firstTriangleId =
        std::max(layout::minFirstTriangleId, static_cast<std::uint32_t>(scene.spheres.size()));
    frame.background = scene.background;
    frame.shadowThroughGlass = scene.shadowThroughGlass;
    return frame;
}

std::uint32_t cameraOf(const Camera &camera) {
    switch (camera.kind) {
    case CameraKind::Orthographic:
        return layout::cameraOrthographic;
    case CameraKind::Panorama:
        return layout::cameraPanorama;
    case CameraKind::Perspective:
        break;
    }
    return camera.aperture > 0.0 ? layout::cameraLens : layout::cameraPinhole;
}

/// `profile` is the light's index among those with one.
layout::LightRecord packLight(const Light &light, std::uint32_t profile) {
    layout::LightRecord record{};
    record.position = glm::vec3(light.position);
    record.kind = light.profile ? layout::lightProfiled | profile << layout::lightKindBits
                                : static_cast<std::uint32_t>(light.kind);
    record.intensity = glm::vec3(light.power / (4.0 * std::numbers::pi));
    if (light.kind == LightKind::Point && !light.profile)
        return record;
    record.axis = glm::vec3(glm::normalize(light.direction));
    if (light.kind == LightKind::Directional) {
        record.intensity = glm::vec3(light.power);
        return record;
    }
    if (light.kind == LightKind::Point) {
        record.cosineOuter = layout::cosineOfNoCone;
        record.falloffScale = layout::scaleOfNoCone;
        return record;
    }
    const double outer = std::cos(glm::radians(light.angleDegrees));
    const double inner = std::cos(glm::radians(light.angleDegrees * (1.0 - light.blend)));
    constexpr double minDifference = 1e-6; // a spot without a soft edge
    record.cosineOuter = static_cast<float>(outer);
    const double sign = light.fade == SpotFade::Square ? -1.0 : 1.0;
    record.falloffScale = static_cast<float>(sign / std::max(inner - outer, minDifference));
    return record;
}

template <class Packed>
void packKey(const Packed &key, const Material &material, layout::MaterialRecord &record) {
    if constexpr (requires { key.packed; })
        if (key.packed != nullptr)
            record.*key.packed = material.*key.member;
}

std::uint32_t kindAndSidesOf(const Material &material) {
    const auto flag = [](bool isSet, std::uint32_t bit) { return isSet ? bit : 0u; };
    return static_cast<std::uint32_t>(material.kind) |
           flag(material.twoSided || material.reflectsBehind, layout::materialIsTwoSided) |
           flag(material.twoSided, layout::materialEmitsBehind) |
           flag(material.isThin, layout::materialIsThin) |
           flag(material.isSpecularGlossy, layout::materialIsSpecularGlossy) |
           flag(material.isUnlit, layout::materialIsUnlit);
}

/// The differences to the principled material.
void packGltf(const Material &material, layout::MaterialRecord &record) {
    const float ratio = (material.refractiveIndex - 1.0f) / (material.refractiveIndex + 1.0f);
    record.normalReflectance = material.isSpecularGlossy ? 1.0f : ratio * ratio;
    record.sheenAlpha = leaves::sheenAlphaOf(material.sheenRoughness);
    // In double: its sine and cosine are then rounded once, as everywhere.
    const auto rotation = static_cast<double>(material.anisotropyRotation);
    record.anisotropyCosine = static_cast<float>(std::cos(rotation));
    record.anisotropySine = static_cast<float>(std::sin(rotation));
}

/// The factor of 1 / wavelength^2 in Cauchy's equation, in square micrometres, from Abbe's number: the index without 1,
/// divided by what it grows by from the C line of hydrogen to its F line. KHR_materials_dispersion.
float dispersionOf(const Material &material) {
    constexpr double squaredWaveNumberC = 1.0 / (0.65627 * 0.65627);
    constexpr double squaredWaveNumberF = 1.0 / (0.48613 * 0.48613);
    const double growth = (static_cast<double>(material.refractiveIndex) - 1.0) *
                          static_cast<double>(material.dispersion) / 20.0;
    return static_cast<float>(growth / (squaredWaveNumberF - squaredWaveNumberC));
}

layout::MaterialRecord packMaterial(const Material &material) {
    layout::MaterialRecord record{};
    for (const MaterialRow &row : materialTable)
        for (const MaterialKey &key : row.keys)
            std::visit([&](const auto &value) { packKey(value, material, record); }, key.value);
    record.kindAndSides = kindAndSidesOf(material);
    record.opacity = material.alphaMode == AlphaMode::Opaque ? 1.0f : material.opacity;
    record.alphaCutoff = material.alphaMode == AlphaMode::Blend    ? layout::alphaBlended
                         : material.alphaMode == AlphaMode::CutOut ? material.alphaCutoff
                                                                   : 0.0f;
    const bool isMixture = material.kind == MaterialKind::Principled || material.kind == MaterialKind::Gltf;
    record.alpha = material.roughness > 0.0f || isMixture ? leaves::alphaOf(material.roughness) : 0.0f;
    if (material.kind == MaterialKind::Conductor) {
        record.albedo = normalReflectance(material.conductorIndex, material.conductorExtinction);
        record.conductorIndex = material.conductorIndex;
        record.conductorExtinction = material.conductorExtinction;
        for (int i = 0; i < 3; ++i)
            record.averageReflectance[i] = static_cast<float>(
                averageConductorReflectance(material.conductorIndex[i], material.conductorExtinction[i]));
    }
    if (isMixture) {
        const float ratio = (material.refractiveIndex - 1.0f) / (material.refractiveIndex + 1.0f);
        record.normalReflectance = std::min(2.0f * material.specular * (ratio * ratio), 1.0f);
        record.clearcoatAlpha = leaves::alphaOf(material.clearcoatRoughness);
    }
    record.dispersion = dispersionOf(material);
    if (material.kind == MaterialKind::Gltf)
        packGltf(material, record);
    return record;
}

/// The refractive indices of a material for all waves.
IndexSpan indicesOf(const Material &material) {
    leaves::MaterialRecord<double> record{};
    record.refractiveIndex = static_cast<double>(material.refractiveIndex);
    record.dispersion = static_cast<double>(dispersionOf(material));
    const auto indexAt = [&](double wavelength) {
        return leaves::indexFor(record, leaves::waveOf(wavelength).bend);
    };
    return {indexAt(leaves::longestWavelength<double>), indexAt(leaves::shortestWavelength<double>)};
}

/// The table nodes for rough glass between any two of the scene's media. None where there are more media than the path
/// integrator, which alone reads of them, can follow.
GlassNodes glassNodesOf(const Scene &scene) {
    GlassNodes nodes;
    if (std::ranges::count_if(scene.materials, holdsMedium) > std::int64_t{layout::maxMedia})
        return nodes;
    std::vector<IndexSpan> indices = {{1.0, 1.0}};
    for (const Material &material : scene.materials) {
        if (holdsMedium(material))
            indices.push_back(indicesOf(material));
        if (!isGlass(material))
            continue;
        const double roughness = std::sqrt(static_cast<double>(leaves::alphaOf(material.roughness)));
        const bool isTextured = material.textures[layout::slotRoughness].has_value();
        const bool isGlossiness = isTextured && material.isSpecularGlossy;
        nodes.addRoughness(isTextured ? 0.0 : roughness, isGlossiness ? 1.0 : roughness);
    }
    // Facets of mixtures bend light a little where the indices of two media are equal.
    constexpr IndexSpan nearlyEqual{1.0, leaves::nearlyEqualIndex<double>};
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::size_t k = 0; k < indices.size(); ++k) {
            nodes.addIndices(indices[i], indices[k]);
            if (i != k && indices[i].least <= indices[k].most && indices[k].least <= indices[i].most)
                nodes.addIndices(nearlyEqual, nearlyEqual);
        }
    return nodes;
}

/// The packed index of each material, by its index in the input.
std::vector<std::uint32_t> packedMaterials(const std::vector<std::uint32_t> &order) {
    std::vector<std::uint32_t> packed(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        packed[order[i]] = i;
    return packed;
}

/// The input indices of the materials, in packed order.
std::vector<std::uint32_t> materialOrder(const std::vector<Material> &materials) {
    std::vector<std::uint32_t> order(materials.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto rank = [&](std::uint32_t i) {
        return holdsMedium(materials[i]) ? -materials[i].priority : std::numeric_limits<int>::max();
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    return order;
}

/// Half the size of the box around the eye in which primary rays begin.
glm::dvec3 spreadOfOrigins(const Camera &camera, const layout::FrameRecord &frame) {
    const glm::dvec3 right = glm::abs(glm::dvec3(frame.pixelRight));
    const glm::dvec3 up = glm::abs(glm::dvec3(frame.pixelUp));
    constexpr double filterRadius = 1.5; // pixels
    if (camera.kind == CameraKind::Orthographic)
        return right * (0.5 * camera.width + filterRadius) + up * (0.5 * camera.height + filterRadius);
    return static_cast<double>(frame.lensScale) * (right + up);
}

/// Sets the camera, and the glass around it: mediumAround in shaders/bsdf/media.glsl.
void setEye(const Scene &scene, const std::vector<std::uint32_t> &packedMaterial, PackedScene &packed) {
    layout::FrameRecord &frame = packed.frame;
    const MediaAt media =
        mediaAt(scene, packedMaterial, scene.camera.position, spreadOfOrigins(scene.camera, frame));
    packed.camera = cameraOf(scene.camera);
    const bool areElsewhere =
        packed.camera == layout::cameraLens || packed.camera == layout::cameraOrthographic;
    packed.camera |= areElsewhere && media.isSurfaceNear ? layout::cameraOriginsMeetGlass : 0u;
    frame.mediaAtEye = media.around;
    frame.mediumAtEye = media.around == 0
                            ? layout::noMaterial
                            : static_cast<std::uint32_t>(std::countr_zero(media.around)) / layout::mediumBits;
}

std::uint64_t nextSerial() {
    static std::atomic<std::uint64_t> count = 0;
    return ++count;
}

void addLights(const Scene &scene, PackedScene &packed) {
    std::uint32_t profileCount = 0;
    for (const Light &light : scene.lights) {
        packed.lights.push_back(packLight(light, profileCount));
        profileCount += light.profile ? 1u : 0u;
        packed.lighting |= 1u << emitterKindOf(packed.lights.back());
    }
}

/// Marks the features that kernels need for a material on a surface. `hasTransparency`: of the surface's colours.
void useMaterial(const Scene &scene, std::uint32_t index, bool hasTransparency, PackedScene &packed) {
    const Material &material = scene.materials[index];
    const MaterialRow &row = rowOf(material.kind);
    packed.hasEmission = packed.hasEmission || material.emission != glm::vec3(0.0f);
    packed.hasSpecular = packed.hasSpecular || !row.scattersDiffusely || holdsMedium(material);
    packed.hasDielectric = packed.hasDielectric || holdsMedium(material);
    packed.scattering |= row.scattering(material);
    packed.texturing |= texturingOf(material, scene.textures);
    packed.anyHit |= anyHitOf(material, hasTransparency);
}

void useMaterials(const Scene &scene, const TriangleMesh &mesh, PackedScene &packed) {
    packed.texturing |= texturingOf(mesh);
    const bool hasTransparency = hasTransparentColours(mesh);
    if (mesh.triangleMaterials.empty())
        useMaterial(scene, mesh.materialIndex, hasTransparency, packed);
    std::vector<bool> isUsed(scene.materials.size(), false);
    for (const std::uint32_t index : mesh.triangleMaterials)
        isUsed[index] = true;
    for (std::size_t i = 0; i < isUsed.size(); ++i)
        if (isUsed[i])
            useMaterial(scene, static_cast<std::uint32_t>(i), hasTransparency, packed);
}

void packSpheres(const Scene &scene, const Bvh &bvh, const std::vector<std::uint32_t> &packedMaterial,
                 PackedScene &packed) {
    for (const Sphere &sphere : scene.spheres) {
        useMaterial(scene, sphere.materialIndex, false, packed);
        layout::SphereRecord record{};
        record.centre = glm::vec3(sphere.centre);
        record.radius = static_cast<float>(sphere.radius);
        record.materialAndSide =
            packedMaterial[sphere.materialIndex] | (sphere.inwardNormal ? layout::sphereFacesInward : 0u);
        record.isTransmissive =
            scene.materials[sphere.materialIndex].kind == MaterialKind::Dielectric ? 1u : 0u;
        record.primitiveId = static_cast<std::uint32_t>(packed.spheres.size());
        packed.spheres.push_back(record);
        if (!std::ranges::binary_search(bvh.spheres, record.primitiveId))
            packed.loopSpheres.push_back(record);
    }
}

/// Names, and the numbers of places and materials.
void packNumbers(const Scene &scene, const std::vector<std::uint32_t> &packedMaterial, PackedScene &packed) {
    NumberedScene numbered = numberScene(scene, packed.frame.firstTriangleId);
    packed.names = std::move(numbered.names);
    packed.places = std::move(numbered.places);
    for (std::size_t i = 0; i < packedMaterial.size(); ++i)
        packed.materials[packedMaterial[i]].number = numbered.materials[i];
}

/// The groups of what shines: before its emitters are packed.
void packLightGroups(const Scene &scene, PackedScene &packed) {
    packed.lightGroups = lightGroupsOf(scene);
    const std::vector<std::uint32_t> order = materialOrder(scene.materials);
    for (std::size_t i = 0; i < order.size(); ++i)
        packed.materials[i].lightGroup =
            numberOfGroup(packed.lightGroups, scene.materials[order[i]].lightGroup);
    packed.frame.environmentGroup = numberOfGroup(packed.lightGroups, scene.environment.lightGroup);
}

/// The tables of directional albedo, which are the first lookup rows.
void packEnergies(const Scene &scene, PackedScene &packed) {
    if ((packed.scattering & layout::scattersAtRough) != 0) {
        static const std::vector<layout::LookupRow> ofMicrofacets = makeEnergyTexels();
        packed.lookups = ofMicrofacets;
    }
    if ((packed.scattering & layout::scattersAtRoughGlass) != 0)
        std::ranges::copy(makeGlassTexels(glassNodesOf(scene)), std::back_inserter(packed.lookups));
    if ((packed.scattering & layout::scattersAtSheen) != 0) {
        packed.frame.sheenTexels = static_cast<std::uint32_t>(packed.lookups.size());
        static const std::vector<layout::LookupRow> ofSheen = makeSheenTexels();
        std::ranges::copy(ofSheen, std::back_inserter(packed.lookups));
    }
}

} // namespace

std::array<SceneArray, layout::sceneArrayCount> PackedScene::arrays() const {
#define HYALITE_ARRAY(number, value, name, Record, fetch)                                                    \
    SceneArray{layout::number, #name, std::as_bytes(std::span(name))},
    return {HYALITE_SCENE_ARRAYS(HYALITE_ARRAY)};
#undef HYALITE_ARRAY
}

std::size_t PackedScene::sizeBytes() const {
    std::size_t bytes = sizeof(frame) + std::span(nodes).size_bytes();
    for (const SceneArray &array : arrays())
        bytes += array.bytes.size();
    return bytes;
}

std::uint64_t PackedScene::contentHash(std::uint64_t ofArrays) const {
    layout::FrameRecord seen = frame;
    seen.environmentTexels = 0; // this and the next depend on how emitters are chosen
    seen.environmentProbability = 0.0f;
    seen.filterTexels = seen.environmentGroup = seen.lightProfiles = 0;
    seen.triangleCount = 0; // this and the next depend on which instances became meshes
    seen.boundsLower = seen.boundsUpper = glm::vec3(0.0f);
    const std::uint64_t hash = hashBytes(std::as_bytes(std::span(&seen, 1)), ofArrays);
    return hashBytes(std::as_bytes(std::span(&camera, 1)), hash);
}

std::uint64_t PackedScene::arraysHash() const {
    // Texture rows are counted from the first one after those of triangles, which depend on the instances, too: first
    // those of the materials' textures, then their texels.
    const std::size_t firstRow =
        texturing != 0 ? layout::firstCoordinateRow + layout::rowsPerTriangle(texturing) * triangles.size()
                       : textures.size();
    std::span<const layout::TextureRow> texels = std::span(textures).subspan(firstRow);
    std::vector<layout::TextureRecord> seenTextures;
    std::vector<layout::MaterialRecord> seenMaterials = materials;
    for (layout::MaterialRecord &material : seenMaterials) {
        material.emitterPdf = 0.0f, material.number = material.lightGroup = 0; // likewise, and on names
        if (material.textures == 0)
            continue;
        material.textures -= static_cast<std::uint32_t>(firstRow);
        for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot) {
            layout::TextureRecord &record = seenTextures.emplace_back();
            std::memcpy(&record, texels.data(), sizeof(record));
            record.firstRow -= record.size != 0 ? static_cast<std::uint32_t>(firstRow) : 0u;
            texels = texels.subspan(layout::rowsPerTexture);
        }
    }
    std::vector<layout::SphereRecord> seenSpheres = spheres;
    for (layout::SphereRecord &sphere : seenSpheres)
        sphere.emitter = sphere.primitiveId = 0;
    std::uint64_t hash = hashBytes(std::as_bytes(std::span(seenSpheres)), geometry);
    hash = hashBytes(std::as_bytes(std::span(lights)), hash);
    hash = hashBytes(std::as_bytes(std::span(seenMaterials)), hash);
    if ((lighting & layout::lightsByEnvironment) != 0)
        hash =
            hashBytes(std::as_bytes(std::span(lookups).subspan(
                          frame.environmentTexels, (frame.environmentWidth + 1) * frame.environmentHeight)),
                      hash);
    if ((lighting & layout::lightsByProfiles) != 0)
        hash = hashBytes(std::as_bytes(std::span(lookups).subspan(frame.lightProfiles)), hash);
    hash = hashBytes(std::as_bytes(std::span(seenTextures)), hash);
    return hashBytes(std::as_bytes(texels), hash);
}

std::uint64_t PackedScene::namesHash() const {
    std::uint64_t hash = hashBytes(std::as_bytes(std::span(places)));
    for (const layout::MaterialRecord &material : materials)
        hash = hashBytes(std::as_bytes(std::span(&material.number, 1)), hash);
    for (const std::vector<std::string> *list : {&names.objects, &names.assets, &names.materials})
        for (const std::string &name : *list)
            hash = hashBytes(std::as_bytes(std::span(name)), hash + name.size());
    return hash;
}

std::vector<std::string> PackedScene::namesOf(Integrator view) const {
    const IntegratorRow &row = rowOf(view);
    std::vector<std::string> shown;
    if (!row.isOfNumbers())
        return shown;
    if (row.view == layout::viewMaterial)
        shown = names.materials;
    else if (row.view == layout::viewAsset)
        shown = names.withSpheres(names.assets);
    else
        shown = names.withSpheres(names.objects);
    if (row.view == layout::viewPlace) {
        const std::vector<std::string> objects = std::exchange(shown, {});
        for (const layout::PlaceRecord &place : places)
            shown.push_back(objects[place.object - 1]);
    }
    if (shown.size() > layout::maxNumber)
        throw Error(ErrorKind::LimitExceeded, fmt::format("layer {}: found {} numbers; allowed: at most {}",
                                                          row.name, shown.size(), layout::maxNumber));
    return shown;
}

std::uint32_t samplerOf(const RenderSettings &settings) {
    if (settings.sampler == SamplerKind::Centre)
        return layout::samplerCentre;
    return settings.filter == FilterKind::Box ? layout::samplerSobol : layout::samplerFiltered;
}

layout::FrameRecord frameOf(const PackedScene &scene, const RenderSettings &settings) {
    layout::FrameRecord frame = scene.frame;
    frame.radianceLimit = settings.radianceLimit > 0.0 ? static_cast<float>(settings.radianceLimit)
                                                       : std::numeric_limits<float>::infinity();
    frame.seed = settings.seed;
    frame.maxDepth = static_cast<std::uint32_t>(settings.maxDepth);
    frame.occlusionDistance = static_cast<float>(settings.occlusionDistance);
    return frame;
}

PackedScene packScene(const Scene &scene, const Bvh &bvh, const PackOptions &options) {
    assert(bvh.order.size() <= triangleCount(scene) + bvh.spheres.size() + scene.instances.size());
    PackedScene packed;
    packed.serial = nextSerial();
    packed.geometry = options.geometry ? *options.geometry : geometryHash(scene);
    packed.frame = packFrame(scene);
    packed.hasTriangles = !bvh.order.empty();
    if (!bvh.spheres.empty())
        packed.treeSpheres = scene.meshes.empty() && scene.instances.empty() ? layout::treeHasSpheresOnly
                                                                             : layout::treeHasSpheresToo;

    const std::vector<std::uint32_t> order = materialOrder(scene.materials);
    const std::vector<std::uint32_t> packedMaterial = packedMaterials(order);
    setEye(scene, packedMaterial, packed);
    for (const std::uint32_t index : order)
        packed.materials.push_back(packMaterial(scene.materials[index]));
    packSpheres(scene, bvh, packedMaterial, packed);
    packNumbers(scene, packedMaterial, packed);
    for (const TriangleMesh &mesh : scene.meshes)
        useMaterials(scene, mesh, packed);
    for (const TriangleMesh &prototype : scene.prototypes)
        useMaterials(scene, prototype, packed);
    addLights(scene, packed);
    const std::uint32_t turning = layout::texturesNormal | layout::texturesClearcoatNormal;
    if ((packed.texturing & turning) == 0 && (packed.scattering & layout::scattersAtAnisotropic) == 0)
        packed.texturing &= ~layout::texturesTangents;
    packTrees(scene, bvh, packedMaterial, packed);
    packTextures(scene, order, options.maxDecoded, packed);
    packEnergies(scene, packed);
    const bool isLitAround = !scene.environment.radiance.pixels().empty() && packEnvironment(scene, packed);
    packFilter(packed);
    packProfiles(scene, packed);
    packLightGroups(scene, packed);
    packEmitters(scene, isLitAround, options.lightChoice, packed);
    const bool isClosed = !isLitAround && scene.background == glm::vec3(0.0f);
    if (isClosed && packed.treeSpheres == layout::treeHasTriangles && packed.instances.empty() &&
        packed.triangles.size() <= layout::maxListedTriangles)
        packed.trianglePairs = pairTriangles(packed.triangles);
    if (packed.hasTriangles) {
        packed.frame.boundsLower = bvh.nodes.front().box.lower;
        packed.frame.boundsUpper = bvh.nodes.front().box.upper;
    }
    packed.frame.triangleCount = static_cast<std::uint32_t>(packed.triangles.size());
    return packed;
}

void packCamera(const Scene &scene, PackedScene &packed) {
    setCamera(scene.camera, packed.frame);
    setEye(scene, packedMaterials(materialOrder(scene.materials)), packed);
}

void packLights(const Scene &scene, LightChoice choice, PackedScene &packed) {
    packed.serial = nextSerial();
    packed.lights.clear();
    packed.emitters.clear();
    packed.lightNodes.clear();
    packed.infiniteEmitterCount = 0;
    packed.lighting &= layout::lightsByEnvironment;
    const bool isLitAround = packed.lighting != 0;
    addLights(scene, packed);
    packed.frame.lightCount = static_cast<std::uint32_t>(packed.lights.size());
    packProfiles(scene, packed);
    packLightGroups(scene, packed);
    packEmitters(scene, isLitAround, choice, packed);
}

} // namespace hyalite::core
