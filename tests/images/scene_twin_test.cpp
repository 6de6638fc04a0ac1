// The device's image and the CPU twin's are equal bit for bit, whatever the render config.
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;
using testing::shippedScene;

/// Of the CPU's picture and the device's with each render config.
void expectTwins(const TestScene &scene, std::span<const gpu::RenderConfig> configs) {
    const PackedScene packed = testing::pack(scene);
    const reference::Result cpu = renderOnCpu(scene, packed);
    for (const gpu::RenderConfig &config : configs) {
        const gpu::Result device = renderOnDevice(scene, packed, config);
        EXPECT_EQ(differingPixels(device.film, cpu.film), 0u);
        EXPECT_EQ(device.rays, cpu.rays);
    }
}

void expectTwins(const TestScene &scene, const gpu::RenderConfig &config = {}) {
    expectTwins(scene, {&config, 1});
}

constexpr gpu::RenderConfig skipList{.kernel = gpu::findKernel("skip-list")};
constexpr gpu::RenderConfig stack{.kernel = gpu::findKernel("stack")};
const std::array traversals{skipList, stack};

TEST(Twins, AgreeOnTheShippedScenes) {
    expectTwins(shippedScene("spheres", 128, 128, 4));
    expectTwins(shippedScene("spheres-nested", 64, 64, 2));
    expectTwins(shippedScene("cat", 128, 128, 4));
}

TEST(Twins, AgreeAtThePixelCentres) {
    TestScene scene = shippedScene("spheres", 96, 64, 3);
    scene.settings.sampler = SamplerKind::Centre;
    expectTwins(scene);
}

TEST(Twins, AgreeAtOddSizes) {
    for (const auto &[width, height] :
         {std::pair(1, 1), std::pair(333, 217), std::pair(217, 333), std::pair(1, 200)})
        expectTwins(shippedScene("spheres", width, height, 1));
}

TEST(Twins, AgreeAtEveryDepth) {
    for (int depth = 1; depth <= 12; ++depth) {
        TestScene scene = shippedScene("spheres-nested", 24, 24, 1);
        scene.settings.maxDepth = depth;
        expectTwins(scene);
    }
}

TEST(Twins, AgreeOnEveryTree) {
    std::size_t turn = 0;
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        for (const int leafSize : {1, 2, 8, 64}) {
            TestScene scene = shippedScene("cat", 48, 48, 1);
            scene.settings.tree = tree;
            scene.settings.leafSize = leafSize;
            expectTwins(scene, testing::kernelsInTurn(turn++));
        }
        ++turn; // another kernel for this size of leaves
    }
}

TEST(Twins, AgreeWithManySamples) { expectTwins(shippedScene("spheres", 3, 3, 1024)); }

TEST(Twins, AgreeWithACameraInsideGlass) {
    TestScene scene = shippedScene("spheres", 64, 64, 2);
    scene.camera.position = {2.0, 1.0, 3.0};
    expectTwins(scene);
}

// A sphere so small that the point where it is met is its centre, which has no normal: a ray passes on, through glass
// of higher priority around it, in a direction that has nothing to do with the normal.
TEST(Twins, AgreeOnASphereWithoutANormal) {
    TestScene scene;
    scene.camera.direction = {0, 0, -1};
    scene.camera.width = 3;
    scene.camera.height = 3;
    scene.settings.integrator = Integrator::Path;
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    scene.background = {0.1f, 0.2f, 0.3f};
    scene.materials.resize(2);
    for (Material &glass : scene.materials)
        glass.kind = MaterialKind::Dielectric;
    scene.materials[0].priority = 1;
    scene.spheres.push_back({{0, 0, -1000}, 1.0, 0, false});
    scene.spheres.push_back({{0, 0, -1000}, 1e-5, 1, false});
    expectTwins(scene);
}

// More spheres than kernels unroll, and more than one light.
TEST(Twins, AgreeOnManySpheresAndLights) {
    TestScene scene = shippedScene("spheres", 64, 48, 2);
    const std::vector<Sphere> balls(scene.spheres.end() - 4, scene.spheres.end());
    for (int i = 0; i < 24; ++i) {
        Sphere ball = balls[static_cast<std::size_t>(i) % balls.size()];
        ball.radius = 1.5f;
        ball.centre = {static_cast<float>(i % 8) * 5.0f - 18.0f, static_cast<float>(i / 8) * 5.0f - 6.0f,
                       12.0f};
        scene.spheres.push_back(ball);
    }
    scene.lights.push_back(scene.lights.front());
    scene.lights.back().position.x += 30.0f;
    expectTwins(scene, traversals);
}

/// What the path integrator knows: emitters of every kind, glass in glass, absorption, two-sided paper.
TestScene pathScene(int width, int height, int samplesPerPixel) {
    TestScene scene = shippedScene("spheres", width, height, samplesPerPixel);
    scene.settings.integrator = Integrator::Path;
    scene.settings.maxDepth = 12;
    scene.background = {0.1f, 0.2f, 0.3f};
    const auto addMaterial = [&](const Material &material) {
        scene.materials.push_back(material);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    };
    Material lamp;
    lamp.emission = {30.0f, 20.0f, 10.0f};
    Material paper = lamp;
    paper.twoSided = true;
    Material amber;
    amber.kind = MaterialKind::Dielectric;
    amber.absorption = {0.01f, 0.05f, 0.2f};
    amber.priority = 3;
    scene.spheres.push_back({{-8, 12, 12}, 3.0, addMaterial(lamp), false});
    scene.spheres.push_back({{14, 18, 0}, 2.0, addMaterial(paper), true});
    scene.spheres.push_back({{2, -3, 6}, 7.0, addMaterial(amber), false});
    const TestScene cat = shippedScene("cat", 8, 8, 1);
    TriangleMesh mesh = cat.meshes.front();
    mesh.triangles.resize(3000);
    for (glm::vec3 &position : mesh.positions)
        position += glm::vec3(-18.0f, 0.0f, 18.0f);
    mesh.materialIndex = addMaterial(paper);
    mesh.node = noNode; // of the cat's scene
    scene.meshes.push_back(mesh);
    return scene;
}

TEST(Twins, AgreeOnPaths) {
    const TestScene scene = pathScene(64, 64, 4);
    for (const std::size_t turn : {0, 1}) // with two slots AgreeOnPathsOfEveryLength and ResumesInsidePaths
        expectTwins(scene, testing::kernelsInTurn(turn));
    expectTwins(scene, {.tileWidth = 16, .tileHeight = 8, .arithmetic = gpu::Arithmetic::Own});
    expectTwins(shippedScene("cornell", 64, 64, 4));
    expectTwins(shippedScene("lamps", 64, 64, 4));
}

TEST(Twins, AgreeOnPathsOfEveryLength) {
    for (int depth = 1; depth <= 8; ++depth) {
        TestScene scene = pathScene(24, 24, 1);
        scene.settings.maxDepth = depth;
        expectTwins(scene);
    }
}

TEST(Twins, AgreeOnPathsFromTheOtherSampler) {
    TestScene scene = pathScene(24, 24, 3);
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.seed = 7;
    expectTwins(scene);
}

TEST(Twins, AgreeThroughTheFilterOfPixels) {
    TestScene scene = pathScene(24, 24, 3);
    scene.settings.filter = FilterKind::BlackmanHarris;
    expectTwins(scene);
    for (const char *name : {"spheres", "many-lights"}) {
        TestScene shipped = shippedScene(name, 40, 30, 4);
        shipped.settings.filter = FilterKind::BlackmanHarris;
        expectTwins(shipped);
    }
}

/// Every kind of material and of light at once.
TestScene materialScene(int width, int height, int samplesPerPixel) {
    TestScene scene = pathScene(width, height, samplesPerPixel);
    scene.lights.push_back({.position = {0, 30, 30},
                            .power = glm::dvec3(2e4),
                            .kind = LightKind::Spot,
                            .direction = {0, -1, -1},
                            .angleDegrees = 35.0});
    scene.lights.push_back(
        {.power = glm::dvec3(0.5), .kind = LightKind::Directional, .direction = {1, -2, -1}});
    scene.environment.radiance = Image(23, 11);
    std::uint32_t bits = 1;
    for (glm::vec3 &pixel : scene.environment.radiance.pixels()) {
        bits = bits * 1664525u + 1013904223u;
        pixel = glm::vec3(static_cast<float>(bits >> 24) / 256.0f);
    }
    scene.environment.rotateDegrees = 77.0;
    const auto addBall = [&](const Material &material) {
        scene.materials.push_back(material);
        const auto index = static_cast<double>(scene.spheres.size());
        scene.spheres.push_back({{-20.0 + 3.0 * index, -6.0, 14.0},
                                 3.0,
                                 static_cast<std::uint32_t>(scene.materials.size() - 1),
                                 false});
    };
    Material metal;
    metal.kind = MaterialKind::Conductor;
    addBall(metal);
    metal.roughness = 0.4f;
    addBall(metal);
    Material frosted;
    frosted.kind = MaterialKind::Dielectric;
    frosted.roughness = 0.3f;
    frosted.absorption = glm::vec3(0.1f, 0.0f, 0.05f);
    addBall(frosted);
    Material varnish;
    varnish.kind = MaterialKind::Principled;
    varnish.roughness = 0.5f;
    varnish.metallic = 0.3f;
    varnish.clearcoat = 0.8f;
    addBall(varnish);
    varnish.clearcoat = 0.0f;
    varnish.transmission = 0.6f;
    addBall(varnish);
    return scene;
}

TEST(Twins, AgreeOnEveryMaterialAndLight) {
    // Drivers take seconds for each of these kernels. AgreeOnPaths has those with other numbers of slots.
    TestScene scene = materialScene(48, 48, 3);
    expectTwins(scene, skipList);
    expectTwins(scene, {.steps = 300, .kernel = stack.kernel}); // which resumes inside of paths
    scene.settings.radianceLimit = 0.5;
    expectTwins(scene, skipList);
    scene.settings.integrator = Integrator::Whitted;
    expectTwins(scene, stack);
}

TEST(Twins, AgreeOnEachMaterialAlone) {
    // Kernels leave out what a scene does not need, each in its own way.
    const TestScene all = materialScene(32, 32, 2);
    for (std::size_t i = all.spheres.size() - 5; i < all.spheres.size(); ++i) {
        TestScene scene = all;
        scene.meshes.clear();
        scene.spheres = {all.spheres.front(), all.spheres[i]};
        scene.spheres.back().centre = {0, 0, 20};
        expectTwins(scene, i + 1 < all.spheres.size() ? skipList : stack);
    }
}

/// Matt, so that kernels are small: a shader asks for a camera's ray before it knows of materials.
TestScene floorScene(int width, int height, int samplesPerPixel) {
    TestScene scene = shippedScene("spheres", width, height, samplesPerPixel);
    scene.background = {0.1f, 0.2f, 0.3f};
    for (Material &material : scene.materials)
        material.kind = MaterialKind::Diffuse;
    return scene;
}

TEST(Twins, AgreeOnEveryCamera) {
    for (const CameraKind kind : {CameraKind::Perspective, CameraKind::Orthographic, CameraKind::Panorama})
        for (const Integrator integrator : {Integrator::Path, Integrator::Whitted, Integrator::Depth}) {
            TestScene scene = floorScene(40, 32, 2);
            scene.settings.integrator = integrator;
            scene.camera.kind = kind;
            scene.camera.aperture = 1.5;
            scene.camera.focusDistance = 40.0;
            scene.camera.viewWidth = 60.0;
            expectTwins(scene);
        }
}

TEST(Twins, AgreeOnEveryView) {
    for (const Integrator integrator : {Integrator::AmbientOcclusion, Integrator::Normal, Integrator::Depth,
                                        Integrator::Albedo, Integrator::Id}) {
        TestScene scene = pathScene(48, 40, 3);
        scene.settings.integrator = integrator;
        scene.settings.occlusionDistance = 12.0;
        // A view knows of hits, not of how they were found.
        if (integrator == Integrator::AmbientOcclusion || integrator == Integrator::Id)
            expectTwins(scene, traversals);
        else
            expectTwins(scene, integrator == Integrator::Normal ? stack : skipList);
    }
}

/// Textures in every slot, on meshes and on a ball: a floor, a cut-out lamp, and what is bumpy and of varied roughness.
TestScene texturedScene(int width, int height, int samplesPerPixel) {
    using testing::drawnTexture;
    using testing::levels;
    using testing::texturedQuad;
    TestScene scene;
    scene.camera.position = {0, 2, 7};
    scene.camera.direction = {0, -0.2, -1};
    scene.camera.width = width;
    scene.camera.height = height;
    scene.background = {0.2f, 0.3f, 0.4f};
    scene.lights.push_back({{-4, 8, 6}, glm::dvec3(900.0)});
    scene.settings.samplesPerPixel = samplesPerPixel;
    scene.settings.integrator = Integrator::Path;
    const auto noise = [](int x, int y) {
        return static_cast<std::uint32_t>(x * 7919 + y * 104729) * 2654435761u;
    };
    scene.textures = {
        drawnTexture(19, 11, [&](int x, int y) { return noise(x, y) | 0xFF000000u; }),
        drawnTexture(8, 8, [](int x, int y) { return (x + y) % 2 == 0 ? levels(255, 255, 255) : 0u; }),
        drawnTexture(16, 16, [&](int x, int y) {
            return levels(96 + (noise(x, y) >> 26), 96 + (noise(y, x) >> 26), 255);
        })};
    Texture glow;
    glow.width = 2;
    glow.height = 2;
    glow.values = {{3, 2, 1}, {0, 0, 0}, {0, 0, 9}, {1, 1, 1}};
    scene.textures.push_back(glow);
    const auto addMaterial =
        [&](std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> textures) -> Material & {
        Material &material = scene.materials.emplace_back();
        material.twoSided = true;
        for (const auto &[slot, texture] : textures)
            material.textures[slot] = TextureUse{texture, {2.0f, 3.0f}, {0.25f, -0.125f}};
        return material;
    };
    addMaterial({{layout::slotBaseColour, 0}});
    addMaterial({{layout::slotOpacity, 1}, {layout::slotEmission, 3}}).emission = glm::vec3(2.0f);
    Material &varnish = addMaterial({{layout::slotBaseColour, 0},
                                     {layout::slotRoughness, 0},
                                     {layout::slotMetallic, 1},
                                     {layout::slotNormal, 2}});
    varnish.kind = MaterialKind::Principled;
    varnish.roughness = 0.8f;
    varnish.metallic = 0.9f;
    varnish.clearcoat = 0.5f;
    scene.meshes = {texturedQuad({-6, -1, 6}, {12, 0, 0}, {0, 0, -12}, 0),
                    texturedQuad({-3, 0, -1}, {2, 0, 0}, {0, 2, 0.5f}, 1),
                    texturedQuad({1, -0.5f, -1}, {2.5f, 0, 0.5f}, {0, 2.5f, 0}, 2)};
    scene.spheres.push_back({{-0.4, 0, 0.5}, 1.0, 2, false});
    scene.materials.push_back(scene.materials[1]);
    scene.materials.back().textures[layout::slotOpacity].reset();
    scene.spheres.push_back({{2.0, -0.4, 2.0}, 0.5, 3, false});
    return scene;
}

TEST(Twins, AgreeOnTextures) {
    const gpu::RenderConfig configs[] = {
        skipList,
        {.tileWidth = 16, .tileHeight = 8, .kernel = skipList.kernel},
        stack,
        {.steps = 60, .kernel = stack.kernel}, // which resumes inside of paths
    };
    expectTwins(texturedScene(48, 40, 4), configs);
}

TEST(Twins, AgreeOnTexturesWithOwnArithmetic) {
    expectTwins(texturedScene(32, 24, 2), {.arithmetic = gpu::Arithmetic::Own});
}

TEST(Twins, AgreeOnTexturesInViews) {
    TestScene scene = texturedScene(48, 40, 2);
    for (const Integrator integrator :
         {Integrator::Whitted, Integrator::Uv, Integrator::Albedo, Integrator::Normal, Integrator::Id,
          Integrator::AmbientOcclusion, Integrator::Cost}) {
        scene.settings.integrator = integrator;
        expectTwins(scene);
    }
}

TEST(Twins, AgreeOnEachTextureAlone) {
    // Kernels leave out what a scene does not need, each in its own way.
    const TestScene all = texturedScene(32, 24, 2);
    for (std::uint32_t slot = 0; slot <= layout::slotOpacity; ++slot) {
        TestScene scene = all;
        for (Material &material : scene.materials)
            for (std::uint32_t other = 0; other < layout::textureSlotCount; ++other)
                if (other != slot)
                    material.textures[other].reset();
        EXPECT_EQ(testing::pack(scene).texturing, 1u << slot | layout::texturesCoordinates);
        expectTwins(scene);
    }
}

TEST(Twins, AgreeOnTexturesDecodedOrNot) {
    const TestScene scene = texturedScene(48, 40, 4);
    const reference::Result decoded = renderOnCpu(scene);
    const PackedScene levels = testing::pack(scene, 0);
    ASSERT_NE(levels.texturing & layout::texturesLevels, 0u);
    ASSERT_LT(levels.textures.size(), testing::pack(scene).textures.size());
    EXPECT_EQ(differingPixels(renderOnCpu(scene, reference::Precision::Float32, 0).film, decoded.film), 0u);
    EXPECT_EQ(differingPixels(renderOnDevice(scene, skipList, 0).film, decoded.film), 0u);
    // Of the other kind of memory; a view's kernel is small and looks levels up by the same function.
    TestScene view = scene;
    view.settings.integrator = Integrator::Albedo;
    EXPECT_EQ(differingPixels(renderOnDevice(view, stack, 0).film, renderOnCpu(view).film), 0u);
}

TEST(Twins, AgreeOnCoordinatesOfWhatHasNoTextures) {
    TestScene scene = pathScene(48, 40, 2);
    scene.settings.integrator = Integrator::Uv;
    expectTwins(scene, traversals);
}

TEST(Twins, AgreeOnWhittedEmission) {
    TestScene scene = pathScene(48, 48, 2);
    scene.settings.integrator = Integrator::Whitted;
    expectTwins(scene);
}

void expectToResumeInsidePaths(const gpu::KernelRow *kernel) {
    const TestScene scene = pathScene(24, 24, 3);
    const gpu::Result result = renderOnDevice(scene, {.steps = 60, .kernel = kernel});
    EXPECT_EQ(differingPixels(result.film, renderOnCpu(scene).film), 0u);
    EXPECT_GT(result.timing.dispatchCount, 5u);
}

TEST(RenderConfig, ResumesInsidePathsByAStack) { expectToResumeInsidePaths(stack.kernel); }

TEST(RenderConfig, ResumesInsidePathsByASkipList) { expectToResumeInsidePaths(skipList.kernel); }

TEST(Twins, AgreeOnAnEmptyScene) {
    TestScene scene;
    scene.camera.width = 20;
    scene.camera.height = 10;
    scene.background = {0.25f, 0.5f, 1.0f};
    expectTwins(scene);
    EXPECT_EQ(renderOnDevice(scene).film.toImage().at(7, 3), scene.background);
}

TEST(RenderConfig, ChangesNoBit) {
    const TestScene scene = shippedScene("spheres", 70, 50, 3);
    const Film expected = renderOnCpu(scene).film;
    const auto expectSame = [&](const gpu::RenderConfig &config) {
        EXPECT_EQ(differingPixels(renderOnDevice(scene, config).film, expected), 0u);
    };
    expectSame({.tileWidth = 8, .tileHeight = 8});
    expectSame({.tileWidth = 64, .tileHeight = 16, .kernel = skipList.kernel});
    expectSame({.tileWidth = 32, .tileHeight = 64, .kernel = gpu::findKernel("skip-list-x2")});
    expectSame({.steps = 1, .kernel = skipList.kernel});
    expectSame({.steps = 100, .kernel = gpu::findKernel("skip-list-x2")});
    expectSame({.isStaged = true});
    expectSame({.arithmetic = gpu::Arithmetic::Own});
}

// Whatever runs side by side, and also where a dispatch ends before the round and the round is done again.
TEST(RenderConfig, AddsSamplesInFlightInTheirOrder) {
    for (const int samples : {1, 2, 5, 8, 13, 16}) {
        std::vector<gpu::RenderConfig> configs;
        for (const int inFlight : {1, 2, 4, 8})
            for (const std::uint32_t steps : {0u, 40u})
                configs.push_back({.steps = steps, .samplesInFlight = inFlight, .kernel = skipList.kernel});
        expectTwins(shippedScene("spheres", 20, 12, samples), configs);
    }
}

// With a budget of a few steps every ray of the cat stops in the middle of the tree, many times.
TEST(RenderConfig, ResumesInsideTheTree) {
    const TestScene scene = shippedScene("cat", 24, 24, 2);
    const Film expected = renderOnCpu(scene).film;
    for (gpu::RenderConfig kernel : testing::allKernels()) {
        kernel.steps = 20;
        const gpu::Result result = renderOnDevice(scene, kernel);
        EXPECT_EQ(differingPixels(result.film, expected), 0u) << kernel.kernel->name;
        EXPECT_GT(result.timing.dispatchCount, 5u) << kernel.kernel->name;
    }
}

// One ray meets more triangles than a subgroup of lavapipe may take loop iterations in a dispatch.
TEST(RenderConfig, ResumesInsideBruteForce) {
    TestScene scene = shippedScene("cat", 8, 4, 1);
    const Film expected = renderOnCpu(scene).film;
    scene.settings.tree = TreeKind::None;
    for (const char *kernel : {"stack", "skip-list-x2"}) {
        const gpu::Result brute = renderOnDevice(scene, {.kernel = gpu::findKernel(kernel)});
        EXPECT_EQ(differingPixels(brute.film, expected), 0u);
        EXPECT_GT(brute.timing.dispatchCount, 20u);
    }
}

// Films larger than a device's largest storage buffer are rendered in bands.
TEST(RenderConfig, CutsTheFilmIntoBands) {
    const TestScene scene = shippedScene("spheres", 70, 50, 2);
    gpu::DeviceInfo device = testing::testDevice();
    device.maxStorageBufferBytes = 32 * 1024;
    gpu::Renderer renderer(device, {.tileWidth = 8, .tileHeight = 8});
    const Film film = renderer.render(testing::pack(scene), scene.settings, Crop{0, 70, 0, 50}).film;
    EXPECT_EQ(differingPixels(film, renderOnCpu(scene).film), 0u);
}

TEST(Crop, IsThatPartOfTheWholeImage) {
    const TestScene scene = shippedScene("spheres", 60, 40, 2);
    const PackedScene packed = testing::pack(scene);
    const Image whole = renderOnCpu(scene).film.toImage();
    const Crop crop{11, 47, 5, 33};
    const Image part = testing::rendererBy({}).render(packed, scene.settings, crop).film.toImage();
    ASSERT_EQ(part.width(), 36);
    ASSERT_EQ(part.height(), 28);
    for (int y = 0; y < part.height(); ++y)
        for (int x = 0; x < part.width(); ++x)
            ASSERT_EQ(part.at(x, y), whole.at(x + crop.x0, y + crop.y0)) << x << ", " << y;
}

} // namespace
} // namespace hyalite::core
