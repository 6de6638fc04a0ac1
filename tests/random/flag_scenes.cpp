#include "tests/random/flag_scenes.h"

#include "host/packing/light_planes.h"
#include "host/scene/instances.h"
#include "tests/fixtures/profile_of_lamp.h"
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"

#include <fmt/format.h>

#include <utility>

namespace hyalite::core::testing {
namespace {

/// A square that the camera sees from the front; the sun and the background light both of its sides.
TestScene base() {
    TestScene scene;
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 0, 5};
    scene.camera.viewWidth = 3.0;
    scene.camera.width = 16;
    scene.camera.height = 8;
    scene.background = {0.5f, 0.25f, 1.0f};
    scene.settings.integrator = Integrator::Path;
    scene.settings.samplesPerPixel = 4;
    scene.settings.maxDepth = 4;
    scene.materials.resize(2);
    scene.materials[0].reflectsBehind = true;
    scene.materials[0].name = "front";
    scene.materials[1].name = "behind";
    scene.materials[1].albedo = {0.9f, 0.5f, 0.1f};
    scene.meshes = {texturedQuad({-1, -1, 0}, {2, 0, 0.3f}, {0, 2, 0.2f})};
    return scene;
}

Light light(LightKind kind, const glm::dvec3 &position = {1, 2, 3}) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.direction = -position;
    light.power = glm::dvec3(kind == LightKind::Directional ? 2.0 : 300.0);
    light.angleDegrees = 60.0;
    return light;
}

TestScene litBy(LightKind kind) {
    TestScene scene = base();
    scene.background = glm::vec3(0.0f);
    scene.lights = {light(kind)};
    return scene;
}

/// The base's square and a wall behind it, which is seen through it.
TestScene beforeAWall(MaterialKind kind) {
    TestScene scene = base();
    scene.lights = {light(LightKind::Directional)};
    scene.meshes.push_back(texturedQuad({-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, 1));
    scene.materials[0].kind = kind;
    scene.materials[0].roughness = 0.3f;
    return scene;
}

Texture image(bool hasAlpha = false) {
    Texture texture = drawnTexture(3, 2, [&](int x, int y) {
        const auto level = static_cast<std::uint32_t>(40 + 30 * x + 70 * y);
        return levels(level, 255 - level, 200, hasAlpha ? level : 255);
    });
    texture.hasAlpha = hasAlpha;
    return texture;
}

/// A glTF material, with all lobes for the slots that lobes have.
TestScene textured(std::uint32_t slot) {
    TestScene scene = beforeAWall(MaterialKind::Gltf);
    Material &material = scene.materials[0];
    material.metallic = 0.5f;
    material.emission = glm::vec3(0.2f);
    if (slot >= layout::slotTransmission) {
        material.transmission = 0.5f;
        material.isThin = true;
        material.clearcoat = 0.5f;
        material.sheenColour = {0.2f, 0.4f, 0.3f};
        material.sheenRoughness = 0.5f;
        material.anisotropy = 0.5f;
        material.iridescence = 0.8f;
        material.iridescenceIndex = 1.8f;
        material.diffuseTransmission = 0.5f;
    }
    scene.textures = {image()};
    material.textures[slot] = TextureUse{};
    return scene;
}

/// Spheres that are too many to be tested by every ray.
void addManySpheres(TestScene &scene, std::uint32_t material = 1) {
    for (int i = 0; i < 20; ++i)
        scene.spheres.push_back({{i % 5 * 0.5 - 1.0, i / 5 * 0.5 - 0.7, 1.0}, 0.2, material, false});
}

class Rows {
  public:
    using Word = std::uint32_t PackedScene::*;

    /// A bit of a word, which has `others` beside it.
    void bit(std::string flag, Word word, std::uint32_t value, TestScene scene, std::uint32_t others = 0,
             bool isEncoded = false) {
        rows_.push_back({std::move(flag), std::move(scene),
                         [word](const PackedScene &packed) { return packed.*word; }, value | others,
                         [word, value](PackedScene &packed) { packed.*word &= ~value; }, isEncoded});
    }
    void flag(std::string flag, bool PackedScene::*member, TestScene scene) {
        rows_.push_back({std::move(flag), std::move(scene),
                         [member](const PackedScene &packed) { return packed.*member ? 1u : 0u; }, 1,
                         [member](PackedScene &packed) { packed.*member = false; }});
    }
    template <class Read>
    void value(std::string flag, std::uint32_t expected, TestScene scene, const Read &read) {
        rows_.push_back(
            {std::move(flag), std::move(scene),
             [read](const PackedScene &packed) { return static_cast<std::uint32_t>(read(packed)); },
             expected});
    }
    [[nodiscard]] std::vector<FlagScene> take() { return std::move(rows_); }

  private:
    std::vector<FlagScene> rows_;
};

void addScattering(Rows &rows) {
    const auto add = [&](const char *flag, std::uint32_t value, std::uint32_t others, MaterialKind kind,
                         const std::function<void(TestScene &, Material &)> &edit) {
        TestScene scene = beforeAWall(kind);
        edit(scene, scene.materials[0]);
        rows.bit(flag, &PackedScene::scattering, value, std::move(scene), others);
    };
    using namespace layout;
    add("scattersAtConductors", scattersAtConductors, 0, MaterialKind::Conductor,
        [](TestScene &, Material &m) { m.roughness = 0.0f; });
    add("scattersAtRoughConductors", scattersAtRoughConductors, scattersAtConductors, MaterialKind::Conductor,
        [](TestScene &, Material &) {});
    add("scattersAtRoughGlass", scattersAtRoughGlass, 0, MaterialKind::Dielectric,
        [](TestScene &, Material &) {});
    add("scattersAtPrincipled", scattersAtPrincipled, 0, MaterialKind::Principled,
        [](TestScene &, Material &) {});
    add("scattersAtGltf", scattersAtGltf, 0, MaterialKind::Gltf, [](TestScene &, Material &) {});
    add("scattersAtSheen", scattersAtSheen, scattersAtGltf, MaterialKind::Gltf, [](TestScene &, Material &m) {
        m.sheenColour = {0.2f, 0.9f, 0.5f};
    });
    add("scattersAtAnisotropic", scattersAtAnisotropic, scattersAtGltf, MaterialKind::Gltf,
        [](TestScene &, Material &m) {
            m.metallic = 1.0f;
            m.anisotropy = 0.9f;
        });
    add("scattersAtIridescent", scattersAtIridescent, scattersAtGltf, MaterialKind::Gltf,
        [](TestScene &, Material &m) {
            m.metallic = 1.0f;
            m.iridescence = 1.0f;
            m.iridescenceIndex = 2.0f;
        });
    add("scattersAtDispersion", scattersAtDispersion, scattersAtRoughGlass, MaterialKind::Dielectric,
        [](TestScene &, Material &m) { m.dispersion = 5.0f; });
    add("scattersAtDiffuseTransmission", scattersAtDiffuseTransmission, scattersAtGltf, MaterialKind::Gltf,
        [](TestScene &scene, Material &m) {
            m.diffuseTransmission = 0.8f;
            scene.lights.push_back(light(LightKind::Point, {0, 0, -1}));
        });
    const auto makeThin = [](TestScene &scene, Material &m) {
        m.transmission = 0.9f;
        m.isThin = true;
        scene.lights.push_back(light(LightKind::Point, {0, 0, -1}));
    };
    add("scattersAtThin", scattersAtThin, scattersAtGltf, MaterialKind::Gltf, makeThin);
    // Light from behind, chosen by a tree: what kernels ask of the scene and of the material must agree.
    TestScene lit = beforeAWall(MaterialKind::Gltf);
    makeThin(lit, lit.materials[0]);
    lit.lights.push_back(light(LightKind::Point, {1, 1, -1}));
    lit.settings.lightChoice = LightChoice::Tree;
    rows.value("constantHasLightTree", 1, lit,
               [](const PackedScene &packed) { return !packed.lightNodes.empty(); });
    add("scattersAtCoatNormals", scattersAtCoatNormals, scattersAtGltf, MaterialKind::Gltf,
        [](TestScene &scene, Material &m) {
            m.clearcoat = 1.0f;
            scene.textures = {image()};
            m.textures[slotClearcoatNormal] = TextureUse{};
        });
    add("scattersAtUnlit", scattersAtUnlit, 0, MaterialKind::Gltf,
        [](TestScene &, Material &m) { m.isUnlit = true; });
    add("scattersAtUnlit", scattersAtUnlit, 0, MaterialKind::Gltf, [](TestScene &scene, Material &m) {
        m.isUnlit = true;
        scene.settings.integrator = Integrator::Cost;
    });
}

void addLighting(Rows &rows) {
    const auto add = [&](const char *flag, std::uint32_t value, TestScene scene) {
        rows.bit(flag, &PackedScene::lighting, value, std::move(scene));
    };
    add("lightsByPoints", layout::lightsByPoints, litBy(LightKind::Point));
    add("lightsBySpots", layout::lightsBySpots, litBy(LightKind::Spot));
    add("lightsByDirections", layout::lightsByDirections, litBy(LightKind::Directional));
    TestScene profiled = litBy(LightKind::Point);
    profiled.profiles = {crookedLamp()};
    profiled.lights[0].profile = 0;
    add("lightsByProfiles", layout::lightsByProfiles, profiled);
    TestScene spheres = base();
    spheres.materials[1].emission = glm::vec3(5.0f);
    spheres.spheres = {{{1, 1, 2}, 0.3, 1, false}};
    add("lightsBySpheres", layout::lightsBySpheres, spheres);
    TestScene triangles = base();
    triangles.materials[1].emission = glm::vec3(5.0f);
    triangles.meshes.push_back(texturedQuad({1.2f, -1, 0}, {0, 0, 1}, {0, 2, 0}, 1));
    add("lightsByTriangles", layout::lightsByTriangles, triangles);
    TestScene sky = base();
    sky.environment.radiance = Image(4, 2);
    for (std::size_t i = 0; i < 8; ++i)
        sky.environment.radiance.pixels()[i] = glm::vec3(static_cast<float>(i) * 0.5f, 1.0f, 0.5f);
    add("lightsByEnvironment", layout::lightsByEnvironment, sky);

    const auto lightTree = [](bool hasSun) {
        TestScene scene = litBy(LightKind::Point);
        scene.lights.push_back(light(LightKind::Point, {-3, 1, 2}));
        if (hasSun)
            scene.lights.push_back(light(LightKind::Directional));
        scene.settings.lightChoice = LightChoice::Tree;
        return scene;
    };
    rows.value("constantHasLightTree", 1, lightTree(false),
               [](const PackedScene &packed) { return !packed.lightNodes.empty(); });
    rows.value("constantInfiniteEmitters", 1, lightTree(true),
               [](const PackedScene &packed) { return packed.infiniteEmitterCount; });
    TestScene whitted = lightTree(true);
    whitted.settings.integrator = Integrator::Whitted;
    rows.value("constantLightCount", 3, whitted,
               [](const PackedScene &packed) { return packed.lights.size(); });
    rows.flag("constantHasEmission", &PackedScene::hasEmission, spheres);
    rows.value("constantEmitterCount", 2, triangles,
               [](const PackedScene &packed) { return packed.emitters.size(); });
}

void addTexturing(Rows &rows) {
    const auto add = [&](std::string flag, std::uint32_t value, TestScene scene, std::uint32_t others = 0,
                         bool isEncoded = false) {
        rows.bit(std::move(flag), &PackedScene::texturing, value, std::move(scene),
                 others | layout::texturesCoordinates, isEncoded);
    };
    using namespace layout;
    for (const TextureSlot &slot : textureSlots)
        add(fmt::format("slot {}", slot.name), 1u << slot.slot, textured(slot.slot));
    add("texturesLevels", texturesLevels, textured(slotBaseColour), texturesBaseColour, true);
    TestScene second = textured(slotBaseColour);
    second.materials[0].textures[slotBaseColour]->uvSet = 1;
    second.meshes[0].secondUvs = {{{0, 0}, {0, 2}, {2, 2}}, {{0, 1, 2}, {0, 2, 1}}};
    add("texturesSecondUv", texturesSecondUv, second, texturesBaseColour);
    TestScene coloured = beforeAWall(MaterialKind::Diffuse);
    coloured.meshes[0].colours = {{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}, {{0, 1, 2}, {0, 2, 1}}};
    add("texturesColours", texturesColours, coloured);
    TestScene tangents = textured(slotNormal);
    tangents.meshes[0].tangents = {{{0, 1, 0, 1}, {0, 1, 0, -1}, {1, 0, 0, 1}}, {{0, 1, 2}, {0, 2, 1}}};
    add("texturesTangents", texturesTangents, tangents, texturesNormal);
    TestScene placed = textured(slotBaseColour);
    placed.materials[0].textures[slotBaseColour]->wrapU = Wrap::Mirror;
    placed.materials[0].textures[slotBaseColour]->offset = glm::vec2(0.6f);
    add("texturesPlaced", texturesPlaced, placed, texturesBaseColour);
    TestScene channels = textured(slotRoughness);
    channels.materials[0].textures[slotRoughness]->channel = Channel::Green;
    TestScene coordinates = beforeAWall(MaterialKind::Diffuse);
    coordinates.settings.integrator = Integrator::Uv;
    add("texturesCoordinates", texturesCoordinates, coordinates);
    add("texturesChannels", texturesChannels, channels, texturesRoughness);
}

void addAnyHit(Rows &rows) {
    const auto add = [&](const char *flag, std::uint32_t value, const std::function<void(Material &)> &edit) {
        TestScene scene = beforeAWall(MaterialKind::Diffuse);
        edit(scene.materials[0]);
        rows.bit(flag, &PackedScene::anyHit, value, std::move(scene));
    };
    add("anyHitCutOut", layout::anyHitCutOut, [](Material &m) { m.opacity = 0.25f; });
    add("anyHitBlended", layout::anyHitBlended, [](Material &m) {
        m.opacity = 0.25f;
        m.alphaMode = AlphaMode::Blend;
    });
    TestScene culled = beforeAWall(MaterialKind::Diffuse);
    culled.materials[0].isCulled = true;
    culled.meshes[0] = texturedQuad({1, -1, 0}, {-2, 0, 0}, {0, 2, 0}); // from behind
    rows.bit("anyHitCulled", &PackedScene::anyHit, layout::anyHitCulled, culled);
}

void addGeometry(Rows &rows) {
    const TestScene square = base();
    rows.flag("constantHasTriangles", &PackedScene::hasTriangles, square);
    TestScene balls = base();
    balls.meshes.clear();
    balls.spheres = {{{0, 0, 0}, 1.0, 0, false}, {{0.5, 0, 1}, 0.3, 1, false}};
    rows.value("constantSphereCount", 2, balls,
               [](const PackedScene &packed) { return packed.loopSpheres.size(); });
    const auto treeSpheres = [](const PackedScene &packed) { return packed.treeSpheres; };
    rows.value("treeHasTriangles", layout::treeHasTriangles, square, treeSpheres);
    TestScene many = base();
    addManySpheres(many);
    rows.value("treeHasSpheresToo", layout::treeHasSpheresToo, many, treeSpheres);
    many.meshes.clear();
    rows.value("treeHasSpheresOnly", layout::treeHasSpheresOnly, many, treeSpheres);
    TestScene instances = base();
    const TriangleMesh mesh = std::exchange(instances.meshes, {}).front();
    Placement small;
    small.rows[0].x = 0.5f;
    small.offset = {0.3f, 0.2f, 1.0f};
    const std::vector<Placement> placements{Placement(), small};
    addInstances(instances, mesh, placements);
    rows.value("constantHasInstances", 2, instances,
               [](const PackedScene &packed) { return packed.instances.size(); });
    TestScene smooth = base();
    smooth.lights = {light(LightKind::Directional)};
    TriangleMesh &curved = smooth.meshes[0];
    for (const float x : {-0.3f, 0.3f})
        curved.normals.push_back(glm::normalize(glm::vec3(x, 0.2f, 1.0f)));
    curved.triangles[0].normals = {0, 1, 0};
    rows.flag("constantHasNormals", &PackedScene::hasNormals, smooth);
    TestScene grid = base();
    grid.meshes[0] = {};
    for (int i = 0; i < 40; ++i)
        addQuad(grid.meshes[0], glm::vec3(glm::dvec3(i % 8 * 0.3 - 1.2, i / 8 * 0.3 - 0.7, i % 3 * 0.1)),
                {0.2f, 0, 0}, {0, 0.2f, 0.1f});
    grid.settings.tree = TreeKind::Sah;
    rows.value("constantHasPairs", 1, grid, [](const PackedScene &packed) { return packed.hasPairs; });
    TestScene closed = base();
    closed.background = glm::vec3(0.0f);
    closed.materials[1].emission = glm::vec3(5.0f);
    closed.meshes.push_back(texturedQuad({1.2f, -1, 0}, {0, 0, 1}, {0, 2, 0}, 1));
    rows.value("constantTrianglePairs", 2, closed,
               [](const PackedScene &packed) { return packed.trianglePairs.size(); });
    TestScene mirror = beforeAWall(MaterialKind::Mirror);
    rows.flag("constantHasSpecular", &PackedScene::hasSpecular, mirror);
    TestScene glass = beforeAWall(MaterialKind::Dielectric);
    glass.materials[0].roughness = 0.0f;
    rows.flag("constantHasDielectric", &PackedScene::hasDielectric, glass);
    glass.settings.integrator = Integrator::Whitted;
    rows.flag("constantHasDielectric", &PackedScene::hasDielectric, glass);
}

void addCameras(Rows &rows) {
    const auto add = [&](const char *flag, std::uint32_t value, CameraKind kind, double aperture) {
        TestScene scene = base();
        scene.camera.kind = kind;
        scene.camera.aperture = aperture;
        rows.value(flag, value, std::move(scene), [](const PackedScene &packed) { return packed.camera; });
    };
    add("cameraPinhole", layout::cameraPinhole, CameraKind::Perspective, 0.0);
    add("cameraLens", layout::cameraLens, CameraKind::Perspective, 0.5);
    add("cameraOrthographic", layout::cameraOrthographic, CameraKind::Orthographic, 0.0);
    add("cameraPanorama", layout::cameraPanorama, CameraKind::Panorama, 0.0);
    TestScene half = beforeAWall(MaterialKind::Dielectric); // of the orthographic view in glass
    half.materials[0].roughness = 0.0f;
    half.materials[0].absorption = {0.1f, 0.5f, 0.9f};
    half.materials[0].segmentTint = {0.9f, 0.5f, 0.1f};
    half.spheres = {{{2, 0, 5}, 2.0, 0, false}};
    rows.bit("cameraOriginsMeetGlass", &PackedScene::camera, layout::cameraOriginsMeetGlass, half,
             layout::cameraOrthographic);
    half.settings.integrator = Integrator::Whitted;
    rows.bit("cameraOriginsMeetGlass", &PackedScene::camera, layout::cameraOriginsMeetGlass, half,
             layout::cameraOrthographic);
}

/// What settings choose.
void addSettings(Rows &rows) {
    for (const IntegratorRow &row : integratorTable) {
        TestScene scene = base();
        scene.settings.integrator = row.integrator;
        scene.settings.occlusionDistance = 3.0;
        scene.meshes.push_back(texturedQuad({-1, -1, 0}, {2, 0, 0}, {0, 0, 2}, 1));
        rows.value(fmt::format("integrator {}", row.name), row.view, std::move(scene),
                   [view = row.view](const PackedScene &) { return view; });
    }
    TestScene numbered = base();
    numbered.settings.integrator = Integrator::PlaceNumber;
    numbered.spheres.assign(3, {{0.5, 0, 1}, 0.3, 0, false});
    rows.value("constantPlaceCount", 4, numbered,
               [](const PackedScene &packed) { return packed.places.size(); });
    const auto sampler = [&](const char *flag, std::uint32_t value, SamplerKind kind, FilterKind filter) {
        TestScene scene = base();
        scene.settings.sampler = kind;
        scene.settings.filter = filter;
        const RenderSettings settings = scene.settings;
        rows.value(flag, value, std::move(scene),
                   [settings](const PackedScene &) { return samplerOf(settings); });
    };
    sampler("samplerCentre", layout::samplerCentre, SamplerKind::Centre, FilterKind::Box);
    sampler("samplerSobol", layout::samplerSobol, SamplerKind::Sobol, FilterKind::Box);
    sampler("samplerFiltered", layout::samplerFiltered, SamplerKind::Sobol, FilterKind::BlackmanHarris);
    const auto alpha = [&](const char *flag, std::uint32_t value, bool hasAlpha, bool isThroughGlass) {
        TestScene scene = base();
        scene.settings.hasAlpha = hasAlpha;
        scene.settings.isClearGlassTransparent = isThroughGlass;
        const RenderSettings settings = scene.settings;
        rows.value(flag, value, std::move(scene),
                   [settings](const PackedScene &) { return alphaKindOf(settings); });
    };
    alpha("alphaOfNothing", layout::alphaOfNothing, false, false);
    alpha("alphaOfBackground", layout::alphaOfBackground, true, false);
    alpha("alphaThroughGlass", layout::alphaThroughGlass, true, true);
    TestScene mirror = beforeAWall(MaterialKind::Mirror);
    mirror.settings.integrator = Integrator::Albedo;
    mirror.settings.areLayersThrough = true;
    const RenderSettings settings = mirror.settings;
    rows.value("constantLooksThrough", 1, std::move(mirror),
               [settings](const PackedScene &) { return looksThrough(settings.integrator, settings); });
    TestScene layered = base(); // a matt square with a light, before a background
    layered.lights = {light(LightKind::Point)};
    layered.lights[0].lightGroup = "key";
    layered.settings.hasLightLayers = true;
    layered.settings.hasLightGroups = true;
    const auto planes = [settings = layered.settings](const PackedScene &packed) {
        return lightPlanesOf(packed, settings);
    };
    constexpr std::uint32_t classes =
        1u << layout::lightBackground | 1u << layout::lightDiffuseDirect | 1u << layout::lightDiffuseIndirect;
    rows.value("constantLightClasses", classes, layered,
               [planes](const PackedScene &packed) { return planes(packed).classes; });
    rows.value("constantLightGroups", 2, layered,
               [planes](const PackedScene &packed) { return planes(packed).groups; });
}

} // namespace

std::vector<FlagScene> flagScenes() {
    Rows rows;
    addScattering(rows);
    addLighting(rows);
    addTexturing(rows);
    addAnyHit(rows);
    addGeometry(rows);
    addCameras(rows);
    addSettings(rows);
    return rows.take();
}

} // namespace hyalite::core::testing
