// The path integrator against closed forms.
#include "host/reference/path.h"

#include "host/reference/renderer.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/radiance_fixture.h"
#include "tests/fixtures/test_scene.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::addQuad;
using hyalite::core::testing::Estimate;
using hyalite::core::testing::estimate;
using hyalite::core::testing::expectRadiance;
using hyalite::core::testing::packed;

constexpr double pi = std::numbers::pi;

/// A picture of few pixels from the eye along -z; every sample counts as one estimate.
TestScene sceneFrom(const glm::dvec3 &eye, int samplesPerPixel) {
    TestScene scene;
    scene.camera.position = eye;
    scene.camera.width = 8;
    scene.camera.height = 8;
    scene.camera.horizontalFovDegrees = 0.01;
    scene.settings.integrator = Integrator::Path;
    scene.settings.samplesPerPixel = samplesPerPixel;
    scene.settings.maxDepth = 32;
    return scene;
}

std::uint32_t addMaterial(TestScene &scene, const Material &material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Material diffuse(float albedo, float emission = 0.0f) {
    Material material;
    material.albedo = glm::vec3(albedo);
    material.emission = glm::vec3(emission);
    return material;
}

Material glass(float index, float absorption = 0.0f, int priority = 0) {
    Material material;
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.absorption = glm::vec3(absorption);
    material.priority = priority;
    return material;
}

/// A square with corner, and sides a and b, facing a x b.
void addWall(TestScene &scene, std::uint32_t material, const glm::vec3 &corner, const glm::vec3 &a,
             const glm::vec3 &b) {
    scene.meshes.emplace_back();
    scene.meshes.back().materialIndex = material;
    addQuad(scene.meshes.back(), corner, a, b);
}

TEST(PathFurnace, ABallUnderAnEvenSkyHasItsAlbedo) {
    TestScene scene = sceneFrom({0.3, 0.2, 5}, 16);
    scene.background = glm::vec3(1.0f);
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, diffuse(0.6f)), false});
    expectRadiance(scene, 0.6);
}

TEST(PathFurnace, InsideAShellThatEmits) {
    // L = e (1 + a + a^2 + ...), cut off after maxDepth segments.
    for (const int depth : {1, 2, 3, 8, 32}) {
        TestScene scene = sceneFrom({0.3, 0.2, 0.1}, depth < 8 ? 4096 : 1024);
        scene.settings.maxDepth = depth;
        scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, diffuse(0.5f, 1.0f)), true});
        expectRadiance(scene, 2.0 * (1.0 - std::pow(0.5, depth)), 3e-3);
    }
}

TEST(PathFurnace, GlassIsInvisibleUnderAnEvenSky) {
    TestScene scene = sceneFrom({0.7, 0.2, 5}, 64);
    scene.background = glm::vec3(1.0f);
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f)), false});
    expectRadiance(scene, 1.0);
    // And with another glass in it, water around that, and a diffuse ball of albedo 1 far inside.
    scene.spheres.push_back({{0.1, 0, 0}, 0.5, addMaterial(scene, glass(1.9f, 0.0f, 1)), false});
    scene.spheres.push_back({{0.2, 0, 0}, 1.5, addMaterial(scene, glass(1.33f, 0.0f, -1)), false});
    expectRadiance(scene, 1.0);
}

TEST(PathFurnace, RoughGlassIsInvisibleToo) {
    for (const float index : {1.1f, 1.5f, 1.8f})
        for (const float roughness : {0.3f, 0.6f, 1.0f}) {
            TestScene scene = sceneFrom({0.3, 0.2, 5}, 10'000);
            scene.background = glm::vec3(1.0f);
            scene.settings.maxDepth = layout::maxPathDepth;
            Material rough = glass(index);
            rough.roughness = roughness;
            scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, rough), false});
            EXPECT_NEAR(estimate(scene).mean, 1.0, 0.02) << "index " << index << ", roughness " << roughness;
        }
}

TEST(PathFurnace, AWhiteBallUnderAClearCoatIsInvisibleToo) {
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
        TestScene scene = sceneFrom({0.3, 0.2, 5}, 10'000);
        scene.background = glm::vec3(1.0f);
        Material white = diffuse(1.0f);
        white.kind = MaterialKind::Principled;
        white.roughness = roughness;
        white.clearcoat = 1.0f;
        scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, white), false});
        SCOPED_TRACE(::testing::Message() << "roughness " << roughness);
        expectRadiance(scene, 1.0, 0.005);
    }
}

TEST(PathFurnace, AWhiteBallInGlassIsInvisibleToo) {
    TestScene scene = sceneFrom({0.1, 0.2, 5}, 1024);
    scene.background = glm::vec3(1.0f);
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f)), false});
    scene.spheres.push_back({{0, 0, 0}, 0.7, addMaterial(scene, diffuse(1.0f)), false});
    expectRadiance(scene, 1.0);
}

// A ball that bends nothing, in a white world and in a liquid of its index.
TEST(Path, TakesOnTheColourOfAMixtureWhoseIndexIsThatAroundIt) {
    for (const auto &[kind, tint] : {std::pair{MaterialKind::Gltf, 0.5}, {MaterialKind::Principled, 0.25}})
        for (const float index : {1.0f, 1.0002f, 1.4f}) {
            TestScene scene = sceneFrom({0.1, 0.2, 5}, 1024);
            scene.background = glm::vec3(1.0f);
            Material material = glass(index, 0.0f, 1);
            material.kind = kind;
            material.albedo = glm::vec3(static_cast<float>(tint));
            material.roughness = 0.3f;
            material.transmission = 1.0f;
            scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, material), false});
            const double through = kind == MaterialKind::Gltf ? tint * tint : tint; // a root at each crossing
            double expected = through;
            if (index > 1.1f) {
                scene.spheres.push_back({{0, 0, 0}, 2.0, addMaterial(scene, glass(index)), false});
                const double reflected = std::pow((index - 1.0) / (index + 1.0), 2.0); // head on
                expected =
                    reflected + (1.0 - reflected) * (1.0 - reflected) * through / (1.0 - reflected * through);
            }
            EXPECT_NEAR(estimate(scene).mean, expected, 0.01 * expected)
                << static_cast<int>(kind) << ", " << index;
        }
}

TEST(Path, BeginsInTheGlassAroundEachOrigin) {
    // A block of what absorbs and does not refract, down to x = 0: rays along -z that begin in it are in it for 10
    // units.
    const double inside = std::exp(-1.0);
    TestScene scene = sceneFrom({0.5, 0, 0}, 1024);
    scene.background = glm::vec3(1.0f);
    scene.meshes.emplace_back();
    scene.meshes[0].materialIndex = addMaterial(scene, glass(1.0f, 0.1f));
    TriangleMesh &block = scene.meshes[0];
    addQuad(block, {-10, -10, 10}, {10, 0, 0}, {0, 20, 0});
    addQuad(block, {-10, -10, -10}, {0, 20, 0}, {10, 0, 0});
    addQuad(block, {0, -10, -10}, {0, 20, 0}, {0, 0, 20});
    addQuad(block, {-10, -10, -10}, {0, 0, 20}, {0, 20, 0});
    addQuad(block, {-10, 10, -10}, {0, 0, 20}, {10, 0, 0});
    addQuad(block, {-10, -10, -10}, {10, 0, 0}, {0, 0, 20});
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.viewWidth = 4.0;
    expectRadiance(scene, 0.625 + 0.375 * inside, 3e-3);
    scene.camera.position.x = -0.5; // an eye in the block
    expectRadiance(scene, 0.375 + 0.625 * inside, 3e-3);

    // A lens that is cut at a quarter of its radius.
    scene.camera.kind = CameraKind::Perspective;
    scene.camera.aperture = 2.0;
    scene.camera.focusDistance = 1e6;
    scene.camera.position.x = 0.25;
    const double share = (std::acos(0.25) - 0.25 * std::sqrt(1.0 - 0.0625)) / pi;
    expectRadiance(scene, 1.0 - share + share * inside, 3e-3);
}

TEST(Path, ADiffuseSilhouetteDoesNotDependOnOtherMaterials) {
    // The shading normals lean 60 degrees to the left, and the eye is 60 degrees to the right: it sees the wall, but
    // they face away. Of an even sky a surface that leans by an angle sees (1 + cos) / 2 (Lambert's law).
    for (const bool isBesideMetal : {false, true}) {
        TestScene scene = sceneFrom({5.0 * std::sqrt(3.0), 0, 5.0}, 4096);
        scene.camera.direction = -scene.camera.position;
        scene.background = glm::vec3(1.0f);
        addWall(scene, addMaterial(scene, diffuse(0.6f)), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        TriangleMesh &wall = scene.meshes.back();
        wall.normals = {{-std::sqrt(0.75f), 0.0f, 0.5f}};
        for (MeshTriangle &triangle : wall.triangles)
            triangle.normals = glm::uvec3(0);
        if (isBesideMetal) {
            Material metal;
            metal.kind = MaterialKind::Conductor;
            metal.conductorIndex = glm::vec3(0.2f);
            metal.conductorExtinction = glm::vec3(3.0f);
            scene.spheres.push_back({{0, 0, -50}, 1.0, addMaterial(scene, metal), false});
        }
        expectRadiance(scene, 0.6 * 0.75, 3e-3);
    }
}

TEST(PathLight, ASphereAboveAFloor) {
    // Irradiance pi L (r / d)^2 under a sphere, whatever its size: here by cones, and by areas from inside a shell of
    // light.
    for (const double radius : {0.01, 1.0, 1.9}) {
        TestScene scene = sceneFrom({0, 0, 0.5}, 1024);
        scene.settings.maxDepth = 2;
        addWall(scene, addMaterial(scene, diffuse(0.5f)), {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
        scene.spheres.push_back({{0, 0, 2.0}, radius, addMaterial(scene, diffuse(0.0f, 3.0f)), false});
        scene.camera.position = {0, 0, 0.05};
        expectRadiance(scene, 0.5 * 3.0 * (radius / 2.0) * (radius / 2.0), 3e-3);
    }
}

/// The irradiance that a rectangle at height z above the origin, parallel to the floor, gives it per radiance: the
/// integral of cos cos / d^2, from the corner formula of Lambert.
double cornerFactor(double a, double b) { // times pi, for sides a and b in units of the height
    const double x = std::sqrt(1.0 + a * a);
    const double y = std::sqrt(1.0 + b * b);
    return 0.5 * (a / x * std::atan(b / x) + b / y * std::atan(a / y));
}

TEST(PathLight, ARectangleAboveAFloor) {
    TestScene scene = sceneFrom({0, 0, 0.5}, 2048);
    scene.settings.maxDepth = 2;
    addWall(scene, addMaterial(scene, diffuse(0.5f)), {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    addWall(scene, addMaterial(scene, diffuse(0.0f, 2.0f)), {-1, -1, 2}, {0, 4, 0}, {3, 0, 0}); // faces down
    const double irradiance = 2.0 * (cornerFactor(0.5, 0.5) + cornerFactor(1.0, 0.5) +
                                     cornerFactor(0.5, 1.5) + cornerFactor(1.0, 1.5));
    scene.camera.position = {0, 0, 0.05};
    expectRadiance(scene, 0.5 / pi * irradiance, 3e-3);
}

TEST(PathLight, EmissionIsOneSidedUnlessSaidOtherwise) {
    for (const bool isTwoSided : {false, true}) {
        TestScene scene = sceneFrom({0, 0, 5}, 4);
        Material material = diffuse(0.0f, 2.0f);
        material.twoSided = isTwoSided;
        addWall(scene, addMaterial(scene, material), {-1, -1, 0}, {0, 2, 0}, {2, 0, 0}); // faces away
        EXPECT_EQ(estimate(scene).mean, isTwoSided ? 2.0 : 0.0);
        scene.camera.position = {0, 0, -5};
        scene.camera.direction = {0, 0, 1};
        EXPECT_EQ(estimate(scene).mean, 2.0);
    }
}

TEST(PathLight, APointLightIsThatOfTheWhittedIntegrator) {
    TestScene scene = sceneFrom({0, 0, 5}, 1);
    scene.camera.horizontalFovDegrees = 40.0;
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.maxDepth = 2;
    addWall(scene, addMaterial(scene, diffuse(0.5f)), {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    scene.lights.push_back({{1, 2, 3}, glm::dvec3(100.0)});
    const Crop crop{0, 8, 0, 8};
    const Image path = render(packed(scene), scene.settings, crop).film.toImage();
    scene.settings.integrator = Integrator::Whitted;
    const Image whitted = render(packed(scene), scene.settings, crop).film.toImage();
    for (std::size_t i = 0; i < path.pixels().size(); ++i)
        EXPECT_NEAR(path.pixels()[i].x, whitted.pixels()[i].x, 1e-6f * whitted.pixels()[i].x);
}

TEST(PathLight, SeveralEmittersAddUp) {
    TestScene scene = sceneFrom({0, 0, 0.5}, 4096);
    scene.settings.maxDepth = 2;
    addWall(scene, addMaterial(scene, diffuse(0.5f)), {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    scene.spheres.push_back({{0, 0, 2.0}, 0.5, addMaterial(scene, diffuse(0.0f, 3.0f)), false});
    scene.lights.push_back({{3, 0, 4}, glm::dvec3(500.0)});
    scene.camera.position = {0, 0, 0.05};
    const double fromPoint = 0.5 / pi * 500.0 / (4.0 * pi) * 0.8 / 25.0;
    expectRadiance(scene, 0.5 * 3.0 * 0.0625 + fromPoint, 5e-3);
}

TEST(PathMedia, BeersLawThroughABall) {
    TestScene scene = sceneFrom({0, 0, 5}, 4);
    scene.background = glm::vec3(2.0f);
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.0f, 0.7f)), false});
    expectRadiance(scene, 2.0 * std::exp(-1.4));
}

TEST(PathMedia, WhatOverlapsIsTheGlassOfHigherPriority) {
    // Along the axis: 0.5 of the weak glass alone, 1.5 where both are, 0.5 of the strong one alone.
    for (const int priority : {-1, 1}) {
        TestScene scene = sceneFrom({0, 0, 5}, 4096);
        scene.background = glm::vec3(1.0f);
        scene.spheres.push_back({{0, 0, 0.25}, 1.0, addMaterial(scene, glass(1.0f, 0.1f)), false});
        scene.spheres.push_back({{0, 0, -0.25}, 1.0, addMaterial(scene, glass(1.0f, 0.9f, priority)), false});
        expectRadiance(scene, std::exp(-(0.5 * 0.1 + 1.5 * (priority > 0 ? 0.9 : 0.1) + 0.5 * 0.9)), 3e-3);
    }
}

TEST(PathMedia, AHollowBallIsABallOfAirInGlass) {
    // By a normal that points inward, or by air of higher priority.
    TestScene scene = sceneFrom({0.4, 0.3, 5}, 256);
    scene.camera.horizontalFovDegrees = 8.0;
    scene.background = glm::vec3(1.0f);
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f, 2.0f)), false});
    scene.spheres.push_back({{0, 0, 0}, 0.8, 0, true});
    const Estimate byNormal = estimate(scene);
    scene.spheres.back() = {{0, 0, 0}, 0.8, addMaterial(scene, glass(1.0f, 0.0f, 1)), false};
    const Estimate byPriority = estimate(scene);
    EXPECT_NEAR(byNormal.mean, byPriority.mean, 1e-5);
    EXPECT_LT(byNormal.mean, 0.9);
}

TEST(Fresnel, NormalIncidenceBrewsterAndTotalReflection) {
    const glm::dvec3 normal(0, 0, 1);
    EXPECT_NEAR(fresnelDielectric<double>({0, 0, -1}, normal, 1.0 / 1.5).reflectance, 0.04, 1e-12);
    EXPECT_NEAR(fresnelDielectric<double>({0, 0, -1}, normal, 1.5).reflectance, 0.04, 1e-12);
    // At Brewster's angle only light across the plane is reflected: half of sin^2(i - t).
    const double angle = std::atan(1.5);
    const double across = std::sin(angle - (pi / 2.0 - angle));
    EXPECT_NEAR(
        fresnelDielectric<double>({std::sin(angle), 0, -std::cos(angle)}, normal, 1.0 / 1.5).reflectance,
        0.5 * across * across, 1e-12);
    const double beyond = std::asin(1.0 / 1.5) + 1e-3;
    EXPECT_EQ(fresnelDielectric<double>({std::sin(beyond), 0, -std::cos(beyond)}, normal, 1.5).reflectance,
              1.0);
    // Snell.
    const DielectricFresnel<double> glass =
        fresnelDielectric<double>({std::sin(0.5), 0, -std::cos(0.5)}, normal, 1.0 / 1.5);
    EXPECT_NEAR(glass.refracted.x, std::sin(0.5) / 1.5, 1e-12);
}

} // namespace
} // namespace hyalite::core::reference
