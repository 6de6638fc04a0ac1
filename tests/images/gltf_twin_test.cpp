// Materials and attributes of glTF: both renderers make one picture, by the kernels in turn, with instances and
// without. What that picture is, closed forms and the plain path tracer say (transparency_test.cpp,
// plain_materials_test.cpp).
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <array>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// On both renderers, by the kernels of a turn.
void expectOnePicture(const TestScene &scene, const Film &wanted, std::size_t turn) {
    EXPECT_EQ(differingPixels(renderOnCpu(scene).film, wanted), 0u);
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(turn))
        EXPECT_EQ(differingPixels(renderOnDevice(scene, config).film, wanted), 0u) << gpu::kernelName(config);
}

TestScene emptyScene(int width, int height, Integrator integrator) {
    TestScene scene;
    scene.camera.position = {0, 0, 6};
    scene.camera.direction = {0, 0, -1};
    scene.camera.horizontalFovDegrees = 50.0;
    scene.camera.width = width;
    scene.camera.height = height;
    scene.settings.integrator = integrator;
    scene.settings.samplesPerPixel = 2;
    scene.background = {0.4f, 0.5f, 0.6f};
    scene.lights.push_back({{3, 5, 6}, glm::dvec3(600.0)});
    return scene;
}

Material gltf() {
    Material material;
    material.kind = MaterialKind::Gltf;
    material.albedo = {0.8f, 0.6f, 0.3f};
    material.roughness = 0.4f;
    return material;
}

/// One of each feature.
std::vector<Material> materials() {
    std::vector<Material> all(16, gltf());
    all[1].metallic = 0.5f;
    all[1].anisotropy = 0.7f;
    all[1].anisotropyRotation = 0.8f;
    all[2].sheenColour = {0.5f, 0.9f, 0.7f};
    all[2].sheenRoughness = 0.3f;
    all[3].clearcoat = 0.9f;
    all[4].transmission = 0.8f;
    all[4].isThin = true;
    all[5].transmission = 1.0f;
    all[5].absorption = {0.1f, 0.3f, 0.2f};
    all[6].isUnlit = true;
    all[7].isSpecularGlossy = true;
    all[7].dielectricColour = {0.4f, 0.2f, 0.1f};
    all[8].dielectricColour = {20.0f, 8.0f, 2.0f};
    all[8].dielectricWeight = 0.5f;
    all[8].twoSided = true;
    all[9].clearcoat = 0.5f;
    all[9].sheenColour = glm::vec3(0.4f);
    all[9].transmission = 0.3f;
    all[9].metallic = 0.2f;
    all[10].iridescence = 1.0f;
    all[10].metallic = 0.6f;
    all[10].clearcoat = 0.4f;
    all[11].iridescence = 0.7f;
    all[11].iridescenceIndex = 1.8f;
    all[11].iridescenceThickness = 250.0f;
    all[11].iridescenceThicknessMinimum = 600.0f;
    all[11].transmission = 0.8f;
    all[12] = all[11];
    all[12].isThin = true;
    all[13].diffuseTransmission = 0.7f;
    all[13].diffuseTransmissionColour = {0.4f, 0.9f, 0.2f};
    all[13].isThin = true;
    all[13].clearcoat = 0.3f;
    all[14] = all[13];
    all[14].isThin = false;
    all[14].absorption = {0.5f, 0.2f, 0.9f};
    all[15] = all[14];
    all[15].transmission = 0.4f;
    all[15].dispersion = 1.0f;
    return all;
}

/// A ball with every attribute: smooth above, with all kinds of values missing at some triangles.
TriangleMesh ball() {
    TriangleMesh mesh = testing::icosphere(2);
    mesh.normals = mesh.positions;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        MeshTriangle &triangle = mesh.triangles[i];
        const glm::uvec3 corners = triangle.positions;
        const glm::uvec3 nothing(TriangleMesh::noUv);
        triangle.normals = corners;
        mesh.triangleUvs.push_back(corners);
        mesh.secondUvs.corners.push_back(i % 7 == 0 ? nothing : corners);
        mesh.colours.corners.push_back(i % 5 == 0 ? nothing : corners);
        mesh.tangents.corners.push_back(i % 3 == 0 ? nothing : corners);
    }
    for (const glm::vec3 &position : mesh.positions) {
        mesh.uvs.emplace_back(position.x + 0.3f, position.z * 2.0f);
        mesh.secondUvs.values.emplace_back(position.y * 1.5f, position.x);
        mesh.colours.values.emplace_back(0.5f + 0.5f * position, 0.6f + 0.4f * position.y);
        mesh.tangents.values.emplace_back(glm::normalize(glm::vec3(-position.z + 0.1f, 0.2f, position.x)),
                                          position.x > 0.0f ? 1.0f : -1.0f);
    }
    return mesh;
}

Texture noise(int width, int height) {
    return testing::drawnTexture(width, height, [](int x, int y) {
        return static_cast<std::uint32_t>(x * 7919 + y * 104729 + 17) * 2654435761u;
    });
}

/// Textures in all slots, placed in every way.
void wearEverything(Material &material) {
    for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot) {
        TextureUse use;
        use.textureIndex = slot % 2;
        use.scale = {1.5f, -0.75f};
        use.shear = {0.25f, -0.5f};
        use.offset = {0.125f, 0.375f};
        use.uvSet = slot / 2 % 2;
        use.wrapU = static_cast<Wrap>(slot % 3);
        use.wrapV = static_cast<Wrap>((slot + 1) % 3);
        use.isNearest = slot % 4 == 3;
        use.channel = static_cast<Channel>(slot % 4);
        material.textures[slot] = use;
    }
}

/// Balls in all materials: culled, blended and cut out, with textures and without; instances of one, and meshes.
TestScene crowd(Integrator integrator, bool isTextured) {
    testing::Random random(5);
    TestScene scene = emptyScene(48, 40, integrator);
    scene.materials = materials();
    scene.textures = {noise(8, 5), noise(3, 7)};
    scene.textures[0].hasAlpha = true;
    TriangleMesh mesh = ball();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material &material = scene.materials[i];
        material.isCulled = i % 3 == 1;
        material.alphaMode = static_cast<AlphaMode>(i % 3);
        material.opacity = i % 3 == 2 ? 0.7f : 1.0f;
        if (isTextured)
            wearEverything(material);
    }
    if (!isTextured)
        mesh.tangents = {};
    std::vector<Placement> placements;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangleMaterials.push_back(static_cast<std::uint32_t>(i / 20 % scene.materials.size()));
    for (int i = 0; i < 12; ++i) {
        Placement placement;
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        for (glm::length_t row = 0; row < 3; ++row)
            placement.rows[static_cast<std::size_t>(row)] =
                glm::vec3(random.direction() * (row == 0 ? side * 0.5 : 0.5));
        placement.offset = glm::vec3(random.inCube(2.0));
        placements.push_back(placement);
    }
    addInstances(scene, mesh, placements);
    scene.meshes.push_back(testing::placed(mesh, 0.7, {1.0, -1.2, 1.0}));
    scene.spheres.push_back({{-1.5, -1.0, 1.5}, 0.5, 3, false});
    scene.materials[3].textures[layout::slotOpacity].reset();
    return scene;
}

TestScene flattened(TestScene scene) {
    arrangeInstances(scene, Flattening::All);
    return scene;
}

TEST(GltfTwins, AgreeOnEveryMaterial) {
    TestScene scene = emptyScene(48, 40, Integrator::Path);
    scene.materials = materials();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const double x = static_cast<double>(i % 5) - 2.0;
        const double y = static_cast<double>(i / 5) - 1.5;
        scene.spheres.push_back({{x, y, 0.0}, 0.45, static_cast<std::uint32_t>(i), false});
    }
    const auto lamp = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.emplace_back().emission = glm::vec3(4.0f);
    scene.meshes.push_back(testing::texturedQuad({-2, 2.5f, -1}, {4, 0, 0}, {0, 0, 2}, lamp));
    scene.environment.radiance = Image(8, 4);
    for (std::size_t i = 0; i < 32; ++i)
        scene.environment.radiance.pixels()[i] = glm::vec3(0.1f * static_cast<float>(i % 7));
    const Film wanted = renderOnCpu(scene).film;
    expectOnePicture(scene, wanted, 1);
    // Paths that wait between dispatches, in every state.
    const gpu::RenderConfig inPieces{.steps = 9, .kernel = gpu::findKernel("skip-list")};
    EXPECT_EQ(differingPixels(renderOnDevice(scene, inPieces).film, wanted), 0u);
}

void expectTwinsOfTheCrowd(Integrator integrator, std::size_t turn) {
    const TestScene scene = crowd(integrator, true);
    expectOnePicture(scene, renderOnCpu(flattened(scene)).film, turn);
}

TEST(GltfTwins, AgreeOnAttributesAndTextures) { expectTwinsOfTheCrowd(Integrator::Path, 0); }

TEST(GltfTwins, AgreeOnAttributesAndTexturesForWhitted) { expectTwinsOfTheCrowd(Integrator::Whitted, 1); }

TEST(GltfTwins, AgreeOnAttributesAndTexturesInViews) {
    expectTwinsOfTheCrowd(Integrator::Albedo, 2);
    expectTwinsOfTheCrowd(Integrator::Normal, 3);
}

TEST(GltfTwins, AgreeOnColoursWithoutTextures) {
    const TestScene scene = crowd(Integrator::Path, false);
    expectOnePicture(scene, renderOnCpu(flattened(scene)).film, 2);
}

TEST(GltfTwins, AgreeOnTexturesThatStayLevels) {
    const TestScene scene = flattened(crowd(Integrator::Path, true));
    const Film wanted = renderOnCpu(scene).film;
    EXPECT_EQ(differingPixels(renderOnCpu(scene, reference::Precision::Float32, 0).film, wanted), 0u);
    EXPECT_EQ(differingPixels(renderOnDevice(scene, {}, 0).film, wanted), 0u);
}

TEST(GltfTwins, DoNotDependOnTheTree) {
    TestScene scene = flattened(crowd(Integrator::Path, true));
    const Film wanted = renderOnCpu(scene).film;
    for (const TreeKind tree : {TreeKind::Sah, TreeKind::None}) {
        scene.settings.tree = tree;
        EXPECT_EQ(differingPixels(renderOnCpu(scene).film, wanted), 0u);
    }
}

} // namespace
} // namespace hyalite::core
