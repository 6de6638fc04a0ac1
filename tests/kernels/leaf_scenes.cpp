#include "tests/kernels/leaf_scenes.h"

#include "host/scene/instances.h"
#include "host/scene/validate.h"
#include "tests/fixtures/profile_of_lamp.h"
#include "tests/fixtures/texture_fixture.h"
#include "tests/kernels/draw.h"

#include <algorithm>
#include <array>
#include <bit>

namespace hyalite::core::testing {
namespace {

using layout::uint;

glm::vec3 drawColour(Draw &draw) {
    const float red = draw.unit();
    const float green = draw.chance(4) ? 0.0f : draw.unit();
    return {red, green, draw.unit()};
}

/// Images of 8-bit levels in even places, of floats, which only emission may have, in odd ones.
void addTextures(Scene &scene, Draw &draw) {
    for (const glm::ivec2 size :
         {glm::ivec2(13, 7), glm::ivec2(5, 9), glm::ivec2(1, 1), glm::ivec2(2, 3), glm::ivec2(16, 8)}) {
        Texture &texture =
            scene.textures.emplace_back(drawnTexture(size.x, size.y, [&](int, int) { return draw.word(); }));
        texture.hasAlpha = true;
        if (scene.textures.size() % 2 == 0) {
            texture.levels.clear();
            for (int i = 0; i < size.x * size.y; ++i)
                texture.values.push_back(drawColour(draw) * (draw.chance(4) ? 1e3f : 1.0f));
        }
    }
}

/// A use of each way to look up in turn.
TextureUse drawUse(const Scene &scene, std::uint32_t slot, Draw &draw) {
    const std::uint32_t index = draw.index(static_cast<std::uint32_t>(scene.textures.size()));
    TextureUse use{slot == layout::slotEmission ? index : index & ~1u};
    if (!draw.chance(3)) {
        use.scale = {2.5f * draw.unit(), -3.0f * draw.unit()};
        use.offset = {draw.unit(), draw.unit()};
        use.shear = draw.chance(2) ? glm::vec2(0.0f) : glm::vec2(draw.unit(), -draw.unit());
        use.wrapU = static_cast<Wrap>(draw.index(3));
        use.wrapV = static_cast<Wrap>(draw.index(3));
    }
    use.uvSet = draw.index(2);
    use.isNearest = draw.chance(4);
    use.channel = static_cast<Channel>(draw.index(4));
    return use;
}

/// Two of each kind with random properties, and all the features of glTF's.
void addMaterials(Scene &scene, Draw &draw) {
    for (int round = 0; round < 6; ++round)
        for (const MaterialRow &row : materialTable) {
            Material &material = scene.materials.emplace_back();
            material.kind = row.kind;
            material.name = std::string(row.name);
            material.albedo = drawColour(draw);
            material.twoSided = draw.chance(2);
            material.refractiveIndex = 1.1f + draw.unit();
            material.roughness = draw.chance(4) ? 0.0f : draw.unit();
            if (!row.scattersDiffusely)
                continue;
            material.metallic = draw.chance(2) ? 0.0f : draw.unit();
            material.transmission = draw.chance(2) ? 0.0f : draw.unit();
            material.clearcoat = material.transmission > 0.0f || draw.chance(2) ? 0.0f : draw.unit();
            material.normalStrength = 1.5f * draw.unit();
            for (const TextureSlot &slot : textureSlots)
                if ((row.textures & 1u << slot.slot) != 0 && round > 0 && !draw.chance(4))
                    material.textures[slot.slot] = drawUse(scene, slot.slot, draw);
            material.alphaMode = static_cast<AlphaMode>(draw.index(3));
            material.opacity = draw.chance(2) ? 1.0f : draw.unit();
            material.isCulled = draw.chance(4);
            if (row.kind != MaterialKind::ShadowCatcher && draw.chance(2))
                material.emission = 5.0f * drawColour(draw);
            if (row.kind != MaterialKind::Gltf)
                continue;
            material.isThin = round % 2 == 0;
            if (round == 2 || round == 3)
                material.transmission = 0.5f;
            material.isSpecularGlossy = draw.chance(3);
            material.isUnlit = round == 5;
            material.dielectricWeight = draw.unit();
            material.dielectricColour = drawColour(draw);
            material.sheenColour = draw.chance(3) ? glm::vec3(0.0f) : drawColour(draw);
            material.sheenRoughness = draw.unit();
            material.anisotropy = draw.chance(3) ? 0.0f : draw.unit();
            material.anisotropyRotation = draw.unit();
            material.iridescence = round == 2 || round == 3 ? 0.75f : draw.chance(2) ? 0.0f : draw.unit();
            material.iridescenceIndex = 1.0f + draw.unit();
            material.iridescenceThickness = draw.chance(8) ? 0.0f : 900.0f * draw.unit();
            material.iridescenceThicknessMinimum = 900.0f * draw.unit();
            material.diffuseTransmission = draw.chance(2) ? 0.0f : draw.unit();
            material.diffuseTransmissionColour = drawColour(draw);
            material.dispersion = draw.chance(2) ? 0.0f : 5.0f * draw.unit();
        }
}

/// A wall of quads that have all that corners can have, one of each material.
TriangleMesh drawnMesh(const Scene &scene, Draw &draw) {
    TriangleMesh mesh;
    mesh.name = "wall";
    for (std::uint32_t material = 0; material < scene.materials.size(); ++material) {
        addTexturedQuad(mesh, 10.0f * draw.direction(), draw.direction(), draw.direction());
        mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), 2, material);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(3 * i);
        const glm::uvec3 corners = first + glm::uvec3(0, 1, 2);
        const bool hasAll = !draw.chance(4);
        if (hasAll)
            mesh.triangles[i].normals = corners;
        mesh.secondUvs.corners.push_back(corners);
        mesh.colours.corners.push_back(corners);
        mesh.tangents.corners.push_back(hasAll ? corners : glm::uvec3(CornerValues<glm::vec4>::none));
        for (int corner = 0; corner < 3; ++corner) {
            mesh.normals.push_back(draw.direction());
            mesh.secondUvs.values.emplace_back(draw.unit() * 3.0f, draw.unit());
            mesh.colours.values.emplace_back(drawColour(draw), draw.unit());
            mesh.tangents.values.emplace_back(draw.direction(), draw.chance(2) ? -1.0f : 1.0f);
        }
    }
    return mesh;
}

Placement drawPlacement(Draw &draw) {
    Placement placement;
    for (glm::vec3 &row : placement.rows)
        row = draw.direction() + 0.1f * draw.direction();
    placement.offset = 5.0f * draw.direction();
    return placement;
}

Scene drawnScene() {
    Draw draw;
    Scene scene;
    scene.camera.aperture = 0.1;
    scene.camera.width = 48;
    scene.camera.height = 32;
    scene.camera.direction = {0.1, -0.2, -1.0};
    addTextures(scene, draw);
    addMaterials(scene, draw);
    TriangleMesh mesh = drawnMesh(scene, draw);
    scene.meshes.push_back(mesh);
    for (std::uint32_t &material : mesh.triangleMaterials)
        if (scene.materials[material].emission != glm::vec3(0.0f)) // lights cannot be instances
            material = 0;
    const std::array<Placement, 3> placements{drawPlacement(draw), drawPlacement(draw), drawPlacement(draw)};
    addInstances(scene, mesh, placements);
    std::vector<std::uint32_t> ofSpheres; // only meshes are cut out
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].opacity == 1.0f && !scene.materials[i].textures[layout::slotOpacity])
            ofSpheres.push_back(i);
    for (std::size_t i = 0; i < 40; ++i)
        scene.spheres.push_back({glm::dvec3(15.0f * draw.direction()), 0.05 + draw.unit(),
                                 ofSpheres[i % ofSpheres.size()], draw.chance(3)});
    scene.profiles = {crookedLamp(), ringLamp()};
    for (int i = 0; i < 16; ++i) {
        Light light;
        light.kind = static_cast<LightKind>(i % 3);
        light.position = glm::dvec3(12.0f * draw.direction());
        light.direction = glm::dvec3(draw.direction());
        light.power = glm::dvec3(drawColour(draw)) * 100.0;
        light.fade = i % 2 == 0 ? SpotFade::Smooth : SpotFade::Square;
        light.blend = draw.unit();
        if (i >= 12 && light.kind != LightKind::Directional) {
            light.profile = static_cast<std::uint32_t>(i % 2);
            light.c0 = glm::dvec3(draw.direction());
        }
        scene.lights.push_back(light);
    }
    scene.environment.radiance = Image(37, 19);
    for (glm::vec3 &pixel : scene.environment.radiance.pixels())
        pixel = draw.chance(3) ? glm::vec3(0.0f) : drawColour(draw) * 9.0f;
    scene.environment.rotateDegrees = 123.0;
    validateScene(scene, "the scene of leaves");
    return scene;
}

/// By the light tree, with textures of 8-bit levels.
PackedScene packedByTree() {
    const Scene scene = drawnScene();
    PackedScene packed = packScene(scene, buildBvh(TreeKind::Sah, scene, 4), {LightChoice::Tree, 0});
    packed.frame.seed = 12345;
    packed.frame.maxDepth = 8;
    Draw draw;
    for (uint i = 0; i < layout::glassTexelCount; ++i) { // the scene's glass has few of them
        layout::LookupRow &row = packed.lookups[layout::energyTexelCount + i];
        row = {0.5f + 0.5f * drawColour(draw), std::bit_cast<uint>(0.5f + 0.5f * draw.unit())};
    }
    return packed;
}

PackedScene packedByPower(PackedScene byTree) {
    const Scene scene = drawnScene();
    PackedScene packed = byTree;
    packLights(scene, LightChoice::Power, packed);
    packed.lightNodes = std::move(byTree.lightNodes); // for leaves of the tree that ask for no constant
    return packed;
}

} // namespace

const std::vector<LeafScene> &leafScenes() {
    static const PackedScene byTree = packedByTree();
    static const PackedScene byPower = packedByPower(byTree);
    static const std::vector<LeafScene> scenes = [] {
        std::vector<LeafScene> made{{"all", leaves::SceneView<float>(byTree, layout::samplerFiltered)}};
        leaves::SceneView<float> view(byPower, layout::samplerSobol);
        view.camera = layout::cameraOrthographic;
        view.treeSpheres = layout::treeHasTriangles;
        view.hasNormals = view.hasInstances = view.hasLightTree = false;
        made.push_back({"by power", view});
        view.camera = layout::cameraPinhole;
        made.push_back({"pinhole", view});
        view.camera = layout::cameraPanorama;
        view.samplerKind = layout::samplerCentre;
        view.treeSpheres = layout::treeHasSpheresOnly;
        view.hasTriangles = false;
        view.scattering = view.anyHit = view.emitterCount = view.infiniteEmitterCount = 0;
        view.texturing = layout::texturesLevels;
        view.lighting = layout::lightsByPoints;
        made.push_back({"spheres alone", view});
        return made;
    }();
    return scenes;
}

bool differs(const std::vector<std::string> &sceneWords, const LeafScene &a, const LeafScene &b) {
    const auto isOther = [&](const std::string &word) {
#define HYALITE_COMPARE(constant)                                                                            \
    if (word == #constant)                                                                                   \
        return a.view.constant != b.view.constant;
        HYALITE_COMPARE(samplerKind)
        HYALITE_COMPARE(scattering)
        HYALITE_COMPARE(texturing)
        HYALITE_COMPARE(anyHit)
        HYALITE_COMPARE(lighting)
        HYALITE_COMPARE(camera)
        HYALITE_COMPARE(emitterCount)
        HYALITE_COMPARE(infiniteEmitterCount)
        HYALITE_COMPARE(placeCount)
        HYALITE_COMPARE(sphereCount)
        HYALITE_COMPARE(treeSpheres)
        HYALITE_COMPARE(hasTriangles)
        HYALITE_COMPARE(hasNormals)
        HYALITE_COMPARE(hasInstances)
        HYALITE_COMPARE(hasLightTree)
#undef HYALITE_COMPARE
        return word == "fetchEmitter" &&
               &a.view.packed != &b.view.packed; // of other arrays no leaf sees a difference
    };
    return std::ranges::any_of(sceneWords, isOther);
}

} // namespace hyalite::core::testing
