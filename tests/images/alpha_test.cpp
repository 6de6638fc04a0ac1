// Alpha and shadow catchers: pictures over a colour are pictures with that background, and shadows are closed forms.
#include "tests/fixtures/test_extent.h"
#include "tests/images/plain_scenes.h"
#include "tests/images/rendering.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace hyalite::core {
namespace {

using testing::addBall;
using testing::addQuad;
using testing::diffuse;

/// A glass ball in front of a matt one, a mirror, and a pane, before a grey background that all of them see.
TestScene glassScene(Integrator integrator) {
    TestScene scene = testing::emptyScene(6, 16);
    scene.settings.integrator = integrator;
    scene.background = glm::vec3(0.5f);
    Material glass;
    glass.kind = MaterialKind::Dielectric;
    Material mirror;
    mirror.kind = MaterialKind::Mirror;
    addBall(scene, {-0.6, 0.2, 0.5}, 0.7, glass);
    addBall(scene, {0.3, -0.3, -0.5}, 0.6, diffuse({0.6f, 0.4f, 0.2f}));
    addBall(scene, {0.9, 0.7, 0.0}, 0.4, mirror);
    Light light;
    light.position = {2, 3, 4};
    light.power = glm::dvec3(300.0);
    scene.lights = {light};
    return scene;
}

/// The same with a pane of clear glTF glass, which scatters, in front of an open half of the picture.
TestScene windowScene() {
    TestScene scene = glassScene(Integrator::Path);
    Material pane;
    pane.kind = MaterialKind::Gltf;
    pane.albedo = glm::vec3(0.8f);
    pane.transmission = 1.0f;
    pane.isThin = true;
    addQuad(scene, {-1.4f, -1.4f, 1.0f}, {1.2f, 0, 0}, {0, 1.6f, 0}, pane);
    return scene;
}

Film withAlpha(TestScene scene, bool throughGlass) {
    scene.settings.hasAlpha = true;
    scene.settings.isClearGlassTransparent = throughGlass;
    return testing::renderOnCpu(scene).film;
}

/// The pixel over its background.
glm::vec3 over(const layout::FilmPixel &pixel, const glm::vec3 &background) {
    return meanOf(pixel) + (1.0f - alphaOf(pixel)) * background;
}

struct AlphaCase {
    std::string name;
    std::function<TestScene()> scene;
    bool throughGlass;
    std::size_t turn;
    bool isCutShort = false;
};

class Alpha : public ::testing::TestWithParam<AlphaCase> {};

// The same samples go the same ways, so that this holds for every one of them.
TEST_P(Alpha, OverTheBackgroundIsThePictureWithIt) {
    const TestScene scene = GetParam().scene();
    const Film plain = testing::renderOnCpu(scene).film;
    const Film film = withAlpha(scene, GetParam().throughGlass);
    std::size_t clear = 0;
    std::size_t opaque = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const glm::vec3 wanted = meanOf(plain.pixels[i]);
        const glm::vec3 found = over(film.pixels[i], scene.background);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(found[channel], wanted[channel], 1e-5f * (1.0f + wanted[channel])) << "pixel " << i;
        clear += alphaOf(film.pixels[i]) == 0.0f ? 1u : 0u;
        opaque += alphaOf(film.pixels[i]) == 1.0f ? 1u : 0u;
        EXPECT_EQ(plain.pixels[i].transparency, 0.0f);
    }
    EXPECT_GT(clear, 20u);
    EXPECT_GT(opaque, 10u);
}

TEST_P(Alpha, HasTheSameBitsOnTheDevice) {
    TestScene scene = GetParam().scene();
    scene.settings.hasAlpha = true;
    scene.settings.isClearGlassTransparent = GetParam().throughGlass;
    const PackedScene packed = testing::pack(scene);
    const Film wanted = testing::renderOnCpu(scene, packed).film;
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(GetParam().turn))
        EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, config).film, wanted), 0u)
            << gpu::kernelName(config);
    if (!GetParam().isCutShort && !testing::isTestingAll())
        return;
    EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, testing::cutShortKernel()).film,
                                       wanted),
              0u);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Alpha,
    ::testing::Values(
        AlphaCase{"whitted", [] { return glassScene(Integrator::Whitted); }, false, 0},
        AlphaCase{"whittedThroughGlass", [] { return glassScene(Integrator::Whitted); }, true, 1, true},
        AlphaCase{"path", [] { return glassScene(Integrator::Path); }, false, 2},
        AlphaCase{"pathThroughGlass", [] { return glassScene(Integrator::Path); }, true, 0, true},
        AlphaCase{"pathThroughAPane", windowScene, true, 2}),
    [](const auto &each) { return each.param.name; });

/// The mean alpha of both renderers, of a picture that shows one thing.
void expectAlpha(TestScene scene, double expected, double tolerance) {
    scene.settings.hasAlpha = true;
    for (const Film &film : {testing::renderOnDevice(scene).film, testing::renderOnCpu(scene).film}) {
        double sum = 0.0;
        for (const layout::FilmPixel &pixel : film.pixels)
            sum += static_cast<double>(alphaOf(pixel));
        EXPECT_NEAR(sum / static_cast<double>(film.pixels.size()), expected, tolerance);
    }
}

TEST(AlphaOfGlass, IsOneUnlessItIsSeenThrough) {
    TestScene scene = testing::emptyScene(8, 64);
    scene.background = glm::vec3(1.0f);
    Material pane;
    pane.kind = MaterialKind::Gltf;
    pane.transmission = 1.0f;
    pane.roughness = 0.0f;
    pane.isThin = true;
    pane.albedo = glm::vec3(1.0f);
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, pane);
    expectAlpha(scene, 1.0, 0.0);
    scene.settings.isClearGlassTransparent = true;
    expectAlpha(scene, 0.04, 0.03); // what the pane reflects, head on and a little aside
    scene.materials[0].roughness = 0.4f;
    expectAlpha(scene, 1.0, 0.0);
}

// Light samples of the environment do not shine through what is transparent, and scattered rays have all of it.
TEST(AlphaOfGlass, CountsAnEnvironmentOnce) {
    TestScene scene = windowScene();
    scene.settings.samplesPerPixel = 512;
    scene.environment.radiance = Image(4, 2);
    for (glm::vec3 &texel : scene.environment.radiance.pixels())
        texel = glm::vec3(0.5f);
    const Film plain = testing::renderOnCpu(scene).film;
    const Film film = withAlpha(scene, true);
    glm::vec3 wanted(0.0f);
    glm::vec3 found(0.0f);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        wanted += meanOf(plain.pixels[i]);
        found += over(film.pixels[i], glm::vec3(0.5f));
    }
    EXPECT_NEAR(found.y, wanted.y, 0.004f * wanted.y);
}

// ---- Shadow catchers

Material catcher() {
    Material material;
    material.kind = MaterialKind::ShadowCatcher;
    return material;
}

/// From straight above, the square from -2 to 2 of the plane y = 0, which catches shadows.
TestScene groundScene(int samplesPerPixel) {
    TestScene scene;
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 9, 0};
    scene.camera.direction = {0, -1, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.viewWidth = 4.0;
    scene.camera.width = 16;
    scene.camera.height = 16;
    scene.settings.samplesPerPixel = samplesPerPixel;
    scene.settings.integrator = Integrator::Shadow;
    addQuad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, catcher());
    return scene;
}

Light sun(const glm::dvec3 &direction, double power) {
    Light light;
    light.kind = LightKind::Directional;
    light.direction = direction;
    light.power = glm::dvec3(power);
    return light;
}

/// A plate that the camera sees, at this height above the quarter x, z < 0 of the ground.
void addPlate(TestScene &scene, float height, const Material &material) {
    addQuad(scene, {-20, height, 0}, {20, 0, 0}, {0, 0, -20}, material);
}

/// Whether a pixel lies in a quarter of the ground: its centre is not on a border.
bool isIn(int x, int y, bool right, bool lower) { return (x >= 8) == right && (y >= 8) == lower; }

/// What the formula says of each pixel's share of shadow, by x and y; below 0: anything.
void expectShadows(const TestScene &scene, double tolerance,
                   const std::function<double(int x, int y)> &formula) {
    const PackedScene packed = testing::pack(scene);
    const Film film = testing::renderOnCpu(scene, packed).film;
    static std::size_t turn = 0;
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(turn++))
        EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, config).film, film), 0u)
            << gpu::kernelName(config);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const layout::FilmPixel &pixel = rowOf(film, y)[static_cast<std::size_t>(x)];
            const double wanted = formula(x, y);
            if (wanted < 0.0)
                continue;
            EXPECT_EQ(pixel.sum.x, static_cast<float>(pixel.sampleCount)) << x << ", " << y;
            EXPECT_NEAR(pixel.sum.z / pixel.sum.y, wanted, tolerance) << x << ", " << y;
        }
}

// A sun from the side throws the plate's shadow one unit to the right, beside the plate.
TEST(ShadowCatcher, LacksTheLightThatIsBlocked) {
    TestScene scene = groundScene(4);
    scene.lights = {sun({1, -1, 0}, 3.0)};
    addPlate(scene, 1.0f, diffuse(glm::vec3(0.5f)));
    expectShadows(scene, 0.0, [](int x, int y) {
        if (isIn(x, y, false, false))
            return -1.0; // the plate
        return y < 8 && x < 12 ? 1.0 : 0.0;
    });
}

TEST(ShadowCatcher, WeighsLightsByTheirIrradiance) {
    TestScene scene = groundScene(1024);
    // Of luminance 3 / sqrt(2) and 2: the second one comes from straight above, and nothing beside the plate lacks it.
    scene.lights = {sun({1, -1, 0}, 3.0), sun({0, -1, 0}, 2.0)};
    addPlate(scene, 1.0f, diffuse(glm::vec3(0.5f)));
    const double slanted = 3.0 / std::sqrt(2.0);
    expectShadows(scene, 0.02, [&](int x, int y) {
        if (isIn(x, y, false, false))
            return -1.0;
        return y < 8 && x < 12 ? slanted / (slanted + 2.0) : 0.0;
    });
}

// The configuration factor of a sphere that is wholly above the plane of a small surface: (R / d)^2 cos. Howell, "A
// Catalog of Radiation Heat Transfer Configuration Factors", B-26.
TEST(ShadowCatcher, LacksTheSkyThatASphereHides) {
    TestScene scene = groundScene(2048);
    scene.environment.radiance = Image(8, 4);
    for (glm::vec3 &texel : scene.environment.radiance.pixels())
        texel = glm::vec3(1.0f);
    const glm::dvec3 centre(0.0, 1.5, 0.0);
    const double radius = 0.5;
    addBall(scene, centre, radius, diffuse(glm::vec3(0.5f)));
    expectShadows(scene, 0.012, [&](int x, int y) {
        const glm::dvec3 ground(-2.0 + (x + 0.5) / 4.0, 0.0, -2.0 + (y + 0.5) / 4.0);
        const double distance = glm::distance(ground, centre);
        if (glm::length(ground) < radius + 0.2)
            return -1.0; // the sphere
        return std::pow(radius / distance, 2.0) * (centre.y / distance);
    });
}

TEST(ShadowCatcher, IsDimmedByGlassAsTheSceneSays) {
    TestScene scene = groundScene(4);
    scene.lights = {sun({1, -1, 0}, 3.0)};
    scene.shadowThroughGlass = 0.25f;
    Material glass;
    glass.kind = MaterialKind::Dielectric;
    addPlate(scene, 1.0f, glass);
    expectShadows(scene, 1e-6, [](int x, int y) {
        if (isIn(x, y, false, false))
            return -1.0;
        return y < 8 && x < 12 ? 0.75 : 0.0;
    });
}

TEST(ShadowCatcher, CastsNoShadowOnAnother) {
    TestScene scene = groundScene(4);
    scene.lights = {sun({1, -1, 0}, 3.0)};
    addPlate(scene, 1.0f, catcher());
    expectShadows(scene, 0.0, [](int, int) { return 0.0; });
}

// It hides what is behind it, whatever that is, and is a matt surface to rays that other surfaces scatter.
TEST(ShadowCatcher, IsTransparentToTheEyeAlone) {
    for (const Integrator integrator : {Integrator::Whitted, Integrator::Path}) {
        TestScene scene = groundScene(16);
        scene.settings.integrator = integrator;
        scene.lights = {sun({0, -1, 0}, 3.0)};
        addQuad(scene, {-20, -1, 20}, {40, 0, 0}, {0, 0, -40}, testing::lamp(glm::vec3(5.0f)));
        Material mirror;
        mirror.kind = MaterialKind::Mirror;
        addQuad(scene, {0, 4, 0}, {0, 0, 20}, {20, 20, 0}, mirror); // at 45 degrees, over a quarter
        scene.settings.hasAlpha = true;
        const PackedScene packed = testing::pack(scene);
        const Film film = testing::renderOnCpu(scene, packed).film;
        EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, {}).film, film), 0u);
        const layout::FilmPixel ground = rowOf(film, 4)[4];
        EXPECT_EQ(alphaOf(ground), 0.0f);
        EXPECT_EQ(meanOf(ground), glm::vec3(0.0f));
        EXPECT_EQ(alphaOf(rowOf(film, 12)[12]), 1.0f);
    }
}

} // namespace
} // namespace hyalite::core
