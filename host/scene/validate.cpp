#include "host/scene/validate.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/scene/instances.h"
#include "host/scene/light_groups.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

namespace hyalite::core {
namespace {

/// An object of the scene under check. Its description is put together only when a message needs it.
class Checked {
  public:
    Checked(const std::string &sourceName, std::string_view kind, std::size_t index,
            std::string_view name = {})
        : sourceName_(sourceName), kind_(kind), name_(name), index_(index) {}
    Checked(const std::string &sourceName, std::string_view kind)
        : sourceName_(sourceName), kind_(kind), isOnlyOne_(true) {}

    [[noreturn]] void refuse(std::string_view property, std::string_view found,
                             std::string_view allowed) const {
        std::string object(kind_);
        if (!isOnlyOne_)
            object += fmt::format(" {}", index_);
        if (!name_.empty())
            object += fmt::format(" ({})", name_);
        // Names come from files and may contain terminal escapes.
        const std::string message =
            cleanText(fmt::format("{}: {}: found {}; allowed: {}", object, property, found, allowed));
        throw Error(ErrorKind::BadInput, fmt::format("{}: {}", sourceName_, message));
    }

    template <class T> void within(const Interval &allowed, T value, std::string_view property) const {
        using Real = std::conditional_t<std::is_integral_v<T>, double, T>;
        if (!allowed.contains(static_cast<Real>(value)))
            refuse(property, fmt::format("{}", value), "a number " + allowed.text());
    }

    template <class T>
    void within(const Interval &allowed, const glm::vec<3, T> &value, std::string_view property) const {
        if (!isWithin(allowed, value))
            refuse(property, fmt::format("({}, {}, {})", value.x, value.y, value.z),
                   "numbers " + allowed.text());
    }

    template <class T> static bool isWithin(const Interval &allowed, const glm::vec<3, T> &value) {
        return allowed.contains(value.x) && allowed.contains(value.y) && allowed.contains(value.z);
    }

    void atMost(std::size_t allowed, std::size_t count, std::string_view property) const {
        if (count > allowed)
            refuse(property, fmt::format("{}", count), fmt::format("at most {}", allowed));
    }

    void indexBelow(std::size_t count, std::size_t index, std::string_view property) const {
        if (index >= count)
            refuse(property, fmt::format("index {}", index), fmt::format("less than {}", count));
    }

  private:
    const std::string &sourceName_;
    std::string_view kind_;
    std::string_view name_{};
    std::size_t index_ = 0;
    bool isOnlyOne_ = false;
};

void checkDirection(const Checked &checked, const glm::dvec3 &direction, std::string_view property) {
    checked.within(limits::coordinate, direction, property);
    checked.within(limits::directionLength, glm::length(direction), fmt::format("length of {}", property));
}

void checkCamera(const Camera &camera, const Checked &checked) {
    checked.within(limits::coordinate, camera.position, "position");
    checkDirection(checked, camera.direction, "direction");
    checkDirection(checked, camera.up, "up");
    const double sineToUp =
        glm::length(glm::cross(glm::normalize(camera.direction), glm::normalize(camera.up)));
    if (!(sineToUp >= limits::minSineToUp))
        checked.refuse("up", "the view direction's own axis", "any other axis");
    checked.within(limits::horizontalFovDegrees, camera.horizontalFovDegrees, "horizontal field of view");
    checked.within(limits::aperture, camera.aperture, "aperture");
    checked.within(limits::focusDistance, camera.focusDistance, "focusDistance");
    checked.within(limits::viewWidth, camera.viewWidth, "viewWidth");
    checked.within(limits::imageSize, camera.width, "width");
    checked.within(limits::imageSize, camera.height, "height");
}

template <class Ranged>
void checkKey(const Checked &checked, std::string_view key, const Ranged &value, const Material &material) {
    checked.within(value.allowed, material.*value.member, key);
}
void checkKey(const Checked & /*checked*/, std::string_view /*key*/, const FlagKey & /*value*/,
              const Material & /*material*/) {}
void checkKey(const Checked & /*checked*/, std::string_view /*key*/, const GroupKey & /*value*/,
              const Material & /*material*/) {}
void checkKey(const Checked & /*checked*/, std::string_view /*key*/, const SidesKey & /*value*/,
              const Material & /*material*/) {}
void checkKey(const Checked & /*checked*/, std::string_view /*key*/, const MetalKey & /*value*/,
              const Material & /*material*/) {}

void checkMaterial(const Material &material, const std::vector<Texture> &textures, const Checked &checked) {
    const auto checkKeys = [&](const MaterialRow &row) {
        for (const MaterialKey &key : row.keys)
            std::visit([&](const auto &value) { checkKey(checked, key.key, value, material); }, key.value);
    };
    checkKeys(rowOf(material.kind));
    for (const MaterialRow &row : materialTable) // members that this kind does not use are checked, too
        checkKeys(row);
    checked.within(limits::normalStrength, material.normalStrength, "strength of the normal map");
    for (const std::optional<TextureUse> &use : material.textures) {
        if (!use)
            continue;
        if (rowOf(material.kind).textures == 0)
            checked.refuse("textures", "some", "on a diffuse, a principled or a gltf material");
        checked.indexBelow(textures.size(), use->textureIndex, "texture");
        for (const glm::vec2 &pair : {use->scale, use->offset, use->shear})
            for (const float number : {pair.x, pair.y})
                checked.within(limits::texturePlacement, number, "placement of a texture");
    }
    for (std::size_t slot = 0; slot < material.textures.size(); ++slot) {
        if (!material.textures[slot] || !textures[material.textures[slot]->textureIndex].isFloat())
            continue;
        const Texture &texture = textures[material.textures[slot]->textureIndex];
        if (slot != layout::slotEmission)
            checked.refuse("textures", texture.name + ", of floats",
                           "a PNG or a JPEG, except for the emission");
        for (const glm::vec3 &value : texture.values)
            if (!Checked::isWithin(limits::radiance, value * material.emission))
                checked.within(limits::radiance, value * material.emission,
                               fmt::format("emission times {}", texture.name));
    }
    if (material.kind == MaterialKind::Principled && material.clearcoat > 0.0f &&
        material.transmission > 0.0f)
        checked.refuse("clearcoat",
                       fmt::format("{}, and a transmission of {}", material.clearcoat, material.transmission),
                       "a clear coat, which only opaque materials have: one of the two must be 0");
}

void checkTextures(const std::vector<Texture> &textures, const Checked &checked) {
    std::size_t sizeBytes = 0;
    for (const Texture &texture : textures) {
        sizeBytes += bytesOnDevice(texture);
        checked.within(limits::imageSize, texture.width, fmt::format("width of {}", texture.name));
        checked.within(limits::imageSize, texture.height, fmt::format("height of {}", texture.name));
    }
    checked.atMost(limits::textureBytes, sizeBytes, "bytes of textures");
}

/// Refuses textures on a mesh without texture coordinates.
void checkTexturable(const TriangleMesh &mesh, const std::vector<Material> &materials,
                     const Checked &checked) {
    const auto check = [&](const Material &material) {
        if (std::ranges::any_of(material.textures, [](const auto &use) { return use.has_value(); }))
            checked.refuse("material", material.name + ", which has textures, but no texture coordinates",
                           "a mesh with some (vt, and faces v/vt or v/vt/vn)");
    };
    if (!mesh.triangleUvs.empty())
        return;
    if (mesh.triangleMaterials.empty())
        check(materials[mesh.materialIndex]);
    for (const std::uint32_t index : mesh.triangleMaterials)
        check(materials[index]);
}

template <class Value>
void checkCorners(const CornerValues<Value> &attribute, std::size_t triangleCount, std::string_view name,
                  const Checked &checked) {
    if (!attribute.corners.empty() && attribute.corners.size() != triangleCount)
        checked.refuse(fmt::format("{} of triangles", name), fmt::format("{}", attribute.corners.size()),
                       fmt::format("{}, or none", triangleCount));
    for (std::size_t i = 0; i < attribute.corners.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (attribute.corners[i] != glm::uvec3(CornerValues<Value>::none) &&
                attribute.corners[i][corner] >= attribute.values.size())
                checked.indexBelow(attribute.values.size(), attribute.corners[i][corner],
                                   fmt::format("{} of triangle {}", name, i));
}

void checkMesh(const TriangleMesh &mesh, std::size_t materialCount, const Checked &checked) {
    checked.indexBelow(materialCount, mesh.materialIndex, "material");
    if (!mesh.triangleMaterials.empty() && mesh.triangleMaterials.size() != mesh.triangles.size())
        checked.refuse("materials of triangles", fmt::format("{}", mesh.triangleMaterials.size()),
                       fmt::format("{}, or none", mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangleMaterials.size(); ++i)
        if (mesh.triangleMaterials[i] >= materialCount)
            checked.indexBelow(materialCount, mesh.triangleMaterials[i],
                               fmt::format("material of triangle {}", i));
    if (!mesh.triangleUvs.empty() && mesh.triangleUvs.size() != mesh.triangles.size())
        checked.refuse("texture coordinates of triangles", fmt::format("{}", mesh.triangleUvs.size()),
                       fmt::format("{}, or none", mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangleUvs.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (mesh.triangleUvs[i] != glm::uvec3(TriangleMesh::noUv) &&
                mesh.triangleUvs[i][corner] >= mesh.uvs.size())
                checked.indexBelow(mesh.uvs.size(), mesh.triangleUvs[i][corner],
                                   fmt::format("texture coordinates of triangle {}", i));
    checkCorners(mesh.secondUvs, mesh.triangles.size(), "second texture coordinates", checked);
    checkCorners(mesh.colours, mesh.triangles.size(), "colours", checked);
    checkCorners(mesh.tangents, mesh.triangles.size(), "tangents", checked);
    for (std::size_t i = 0; i < mesh.colours.values.size(); ++i)
        for (glm::length_t channel = 0; channel < 4; ++channel)
            if (!limits::fraction.contains(static_cast<double>(mesh.colours.values[i][channel])))
                checked.within(limits::fraction, mesh.colours.values[i][channel],
                               fmt::format("colour of vertex {}", i));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (!Checked::isWithin(limits::coordinate, mesh.positions[i]))
            checked.within(limits::coordinate, mesh.positions[i], fmt::format("vertex {}", i));

    const Interval unitLength{1.0 - limits::normalLengthTolerance, 1.0 + limits::normalLengthTolerance};
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        if (const float length = glm::length(mesh.normals[i]); !unitLength.contains(length))
            checked.within(unitLength, length, fmt::format("length of normal {}", i));

    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const MeshTriangle &triangle = mesh.triangles[i];
        const bool isFlat = triangle.normals == glm::uvec3(MeshTriangle::noNormal);
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            if (triangle.positions[corner] >= mesh.positions.size())
                checked.indexBelow(mesh.positions.size(), triangle.positions[corner],
                                   fmt::format("vertex of triangle {}", i));
            if (!isFlat && triangle.normals[corner] >= mesh.normals.size())
                checked.indexBelow(mesh.normals.size(), triangle.normals[corner],
                                   fmt::format("normal of triangle {}", i));
        }
    }
}

void checkNodes(const Scene &scene, const std::string &sourceName) {
    const Checked whole(sourceName, "scene");
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent != noNode)
            Checked(sourceName, "node", i, scene.nodes[i].name)
                .indexBelow(i, scene.nodes[i].parent, "parent");
    const auto check = [&](std::uint32_t node) {
        if (node != noNode)
            whole.indexBelow(scene.nodes.size(), node, "node");
    };
    for (const TriangleMesh &mesh : scene.meshes)
        check(mesh.node);
    for (const Instance &instance : scene.instances)
        check(instance.node);
}

/// `sizes` are the largest coordinates of each prototype.
void checkInstance(const Instance &instance, const std::vector<glm::dvec3> &sizes, const Checked &checked) {
    checked.indexBelow(sizes.size(), instance.prototype, "prototype");
    for (const glm::vec3 &row : instance.toWorld.rows)
        checked.within(limits::coordinate, row, "row of its transform");
    checked.within(limits::coordinate, instance.toWorld.offset, "offset of its transform");
    if (determinant(instance.toWorld) == 0.0)
        checked.refuse("transform", "one that makes everything flat", "one with a volume");
    checked.within(limits::coordinate, placedExtent(instance.toWorld, sizes[instance.prototype]),
                   "extent in world space");
}

void checkInstances(const Scene &scene, const std::string &sourceName) {
    std::vector<glm::dvec3> sizes;
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
        const Checked checked(sourceName, "mesh with instances", i, scene.prototypes[i].name);
        checkMesh(scene.prototypes[i], scene.materials.size(), checked);
        checkTexturable(scene.prototypes[i], scene.materials, checked);
        if (scene.prototypes[i].triangles.empty())
            checked.refuse("triangles", "none", "at least one");
        glm::vec3 size(0.0f);
        for (const glm::vec3 &position : scene.prototypes[i].positions)
            size = glm::max(size, glm::abs(position));
        sizes.emplace_back(size);
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Checked checked(sourceName, "instance", i);
        checkInstance(scene.instances[i], sizes, checked);
        const std::uint32_t before = i == 0 ? 0 : scene.instances[i - 1].meshesBefore;
        if (scene.instances[i].meshesBefore < before)
            checked.refuse("meshes before it", fmt::format("{}", scene.instances[i].meshesBefore),
                           fmt::format("at least {}, as for the instance before", before));
    }
    Checked(sourceName, "scene")
        .atMost(limits::primitiveCount, scene.spheres.size() + inputOrder(scene).triangleCount,
                "spheres and triangles, those of instances included");
}

/// Refuses meshes that are all together smaller than products of floats can tell.
void checkExtent(const std::vector<TriangleMesh> &meshes, const Checked &checked) {
    glm::vec3 lower(std::numeric_limits<float>::max());
    glm::vec3 upper(std::numeric_limits<float>::lowest());
    for (const TriangleMesh &mesh : meshes)
        for (const glm::vec3 &position : mesh.positions) {
            lower = glm::min(lower, position);
            upper = glm::max(upper, position);
        }
    const glm::vec3 size = upper - lower;
    const double extent = std::max({size.x, size.y, size.z});
    if (extent >= 0.0 && extent < limits::meshExtent)
        checked.refuse("extent of all meshes", fmt::format("{}", extent),
                       fmt::format("at least {}: scale the scene up", limits::meshExtent));
}

void checkEnvironment(const Environment &environment, const Checked &checked) {
    checked.within(limits::rotateDegrees, environment.rotateDegrees, "rotateDegrees");
    checked.within(limits::environmentScale, environment.scale, "scale");
    checked.atMost(limits::environmentTexelCount, environment.radiance.pixels().size(), "pixels");
    for (std::size_t i = 0; i < environment.radiance.pixels().size(); ++i)
        if (const glm::vec3 scaled = environment.radiance.pixels()[i] * environment.scale;
            !Checked::isWithin(limits::radiance, scaled))
            checked.within(limits::radiance, scaled, fmt::format("radiance of pixel {}", i));
}

void checkProfile(const LightProfile &profile, const Checked &checked) {
    const auto ascend = [](const std::vector<double> &angles) {
        return std::ranges::adjacent_find(angles, std::ranges::greater_equal()) == angles.end();
    };
    for (const double gamma : profile.gammas)
        checked.within(limits::profileAngle, gamma, "angle gamma");
    if (profile.gammas.size() < 2 || !ascend(profile.gammas))
        checked.refuse("angles gamma", "others", "at least two that ascend");
    const std::vector<double> &planes = profile.planes;
    if (planes.empty() || !ascend(planes) ||
        (planes.size() > 1 && (planes.front() != 0.0 || planes.back() != 360.0)))
        checked.refuse("angles C", "others", "one, or those from 0 to 360 that ascend");
    // Cells are counted by 16 bits; those of before and behind the profile are two more.
    checked.atMost(65535 - 2, std::max(planes.size(), profile.gammas.size()), "angles");
    if (profile.shares.size() != planes.size() * profile.gammas.size())
        checked.refuse("values", fmt::format("{}", profile.shares.size()),
                       fmt::format("{} x {}", planes.size(), profile.gammas.size()));
    for (const float share : profile.shares)
        checked.within(limits::fraction, share, "share");
}

void checkLight(const Light &light, std::size_t profileCount, const Checked &checked) {
    checked.within(limits::coordinate, light.position, "position");
    checked.within(limits::power, light.power, "power");
    checkDirection(checked, light.direction, "direction");
    checked.within(limits::spotAngle, light.angleDegrees, "angle");
    checked.within(limits::fraction, light.blend, "blend");
    if (!light.profile)
        return;
    checked.indexBelow(profileCount, *light.profile, "profile");
    if (light.kind == LightKind::Directional)
        checked.refuse("profile", "one of a directional light", "those of points and spots");
    checkDirection(checked, light.c0, "c0");
    if (isParallel(light.direction, light.c0))
        checked.refuse("c0", "the light's own direction", "any other one");
}

template <class Number>
void checkRange(const NumberSetting<Number> &number, const RenderSettings &settings, std::string_view key,
                const Checked &checked) {
    checked.within(number.allowed, settings.*number.member, key);
}

void checkRange(const FlagSetting &, const RenderSettings &, std::string_view, const Checked &) {}

/// Every value has a name.
template <class Value>
void checkRange(const ChoiceSetting<Value> &, const RenderSettings &, std::string_view, const Checked &) {}

} // namespace

void validateSettings(const RenderSettings &settings, const Scene &scene, const std::string &sourceName) {
    const Checked checked(sourceName, "settings");
    for (const Setting &setting : settingsTable)
        std::visit([&](const auto &value) { checkRange(value, settings, setting.key, checked); },
                   setting.value);
    if (settings.filter != FilterKind::Box && settings.sampler == SamplerKind::Centre)
        checked.refuse("filter",
                       std::string(nameOf(settings.filter)) + " with all samples at the pixel's centre",
                       "with the sampler sobol");
    if (settings.isClearGlassTransparent && !settings.hasAlpha)
        checked.refuse("alphaThroughGlass", "true without alpha", "with alpha");
    if (keepsDenoisingData(settings) && settings.samplesPerPixel < 2)
        checked.refuse(settings.isDenoised ? "denoise" : "denoisingData", "true with 1 sample per pixel",
                       "with spp 2 or more: the denoiser compares the first samples with all");
    const bool areViewsThrough = settings.areLayersThrough || keepsDenoisingData(settings);
    if (settings.integrator == Integrator::Path || areViewsThrough)
        Checked(sourceName, "scene")
            .atMost(limits::mediumCount,
                    static_cast<std::size_t>(std::ranges::count_if(scene.materials, holdsMedium)),
                    settings.integrator == Integrator::Path
                        ? "materials that light passes for the integrator path"
                        : "materials that light passes for layersThrough");
}

void validateScene(const Scene &scene, const std::string &sourceName) {
    const Checked whole(sourceName, "scene");
    whole.atMost(limits::lightCount, scene.lights.size(), "lights");
    whole.atMost(limits::materialCount, scene.materials.size(), "materials");
    whole.atMost(limits::sphereCount, scene.spheres.size(), "spheres");
    whole.atMost(limits::meshCount, scene.meshes.size(), "meshes");
    whole.atMost(limits::meshCount, scene.prototypes.size(), "meshes with instances");
    whole.atMost(limits::triangleCount, triangleCount(scene), "triangles");
    whole.atMost(limits::treeCount, scene.spheres.size() + triangleCount(scene), "spheres and triangles");
    whole.atMost(limits::instanceCount, scene.instances.size(), "instances");
    whole.atMost(limits::lightGroupCount, lightGroupsOf(scene).size(), "light groups");
    whole.within(limits::radiance, scene.background, "background");
    checkEnvironment(scene.environment, {sourceName, "environment"});
    whole.within(limits::fraction, scene.shadowThroughGlass, "shadowThroughGlass");

    checkCamera(scene.camera, {sourceName, "camera"});
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        checkLight(scene.lights[i], scene.profiles.size(), {sourceName, "light", i});
    std::size_t valueCount = 0;
    for (std::size_t i = 0; i < scene.profiles.size(); ++i) {
        checkProfile(scene.profiles[i], {sourceName, "profile", i, scene.profiles[i].name});
        valueCount += scene.profiles[i].shares.size();
    }
    whole.atMost(limits::profileValueCount, valueCount, "values of profiles");
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        checkMaterial(scene.materials[i], scene.textures,
                      {sourceName, "material", i, scene.materials[i].name});
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const Checked checked(sourceName, "sphere", i);
        checked.within(limits::coordinate, scene.spheres[i].centre, "centre");
        checked.within(limits::radius, scene.spheres[i].radius, "radius");
        checked.indexBelow(scene.materials.size(), scene.spheres[i].materialIndex, "material");
        if (scene.materials[scene.spheres[i].materialIndex].textures[layout::slotOpacity])
            checked.refuse("material",
                           scene.materials[scene.spheres[i].materialIndex].name +
                               ", with a texture of opacity",
                           "one without: only meshes are cut out");
    }
    checkTextures(scene.textures, whole);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Checked checked(sourceName, "mesh", i, scene.meshes[i].name);
        checkMesh(scene.meshes[i], scene.materials.size(), checked);
        checkTexturable(scene.meshes[i], scene.materials, checked);
    }
    checkExtent(scene.meshes, whole);
    checkInstances(scene, sourceName);
    checkNodes(scene, sourceName);
}

void validateCamera(const Camera &camera, const std::string &sourceName) {
    checkCamera(camera, {sourceName, "camera"});
}

void validateCameraPath(const CameraPath &path, const Camera &camera, const std::string &sourceName) {
    for (std::size_t frame = 0; frame < path.size(); ++frame)
        checkCamera(posed(camera, path[frame]), {sourceName, "camera of frame", frame});
}

} // namespace hyalite::core
