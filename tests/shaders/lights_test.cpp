// Spots, directional lights and environments against closed forms and quadrature in double precision.
#include "host/reference/renderer.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/leaves.h"
#include "tests/fixtures/radiance_fixture.h"
#include "tests/fixtures/test_scene.h"

#include <functional>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::addQuad;
using hyalite::core::testing::Estimate;
using hyalite::core::testing::estimate;
using hyalite::core::testing::expectRadiance;
using hyalite::core::testing::floorScene;
using hyalite::core::testing::packed;
using hyalite::core::testing::Random;

constexpr double pi = std::numbers::pi;
using Direction = glm::dvec3;

Material grey(float albedo) {
    Material material;
    material.albedo = glm::vec3(albedo);
    return material;
}

/// What the Whitted integrator shows must be the same: these lights have no size.
void expectBoth(TestScene scene, double expected) {
    expectRadiance(scene, expected);
    scene.settings.integrator = Integrator::Whitted;
    expectRadiance(scene, expected);
}

void expectDark(TestScene scene) {
    for (const Integrator integrator : {Integrator::Path, Integrator::Whitted}) {
        scene.settings.integrator = integrator;
        EXPECT_EQ(estimate(scene).mean, 0.0);
    }
}

TEST(DirectionalLight, LightsByTheCosine) {
    TestScene scene = floorScene(grey(0.5f), 1);
    for (const Direction &direction : {Direction(0, 0, -1), Direction(1, 0, -1), Direction(3, 4, -5)}) {
        scene.lights = {{.power = glm::dvec3(2.0), .kind = LightKind::Directional, .direction = direction}};
        expectBoth(scene, 0.5 / pi * 2.0 * -direction.z / glm::length(direction));
    }
    scene.lights[0].direction = {0, 0, 1}; // from below
    expectDark(scene);
}

TEST(DirectionalLight, CastsShadowsHoweverFar) {
    TestScene scene = floorScene(grey(0.5f), 1);
    scene.lights = {{.power = glm::dvec3(2.0), .kind = LightKind::Directional, .direction = {1, 0, -1}}};
    scene.spheres.push_back({{-1000, 0, 1000}, 1.0, 0, false});
    expectDark(scene);
}

class SpotLight : public ::testing::TestWithParam<SpotFade> {};
INSTANTIATE_TEST_SUITE_P(Fades, SpotLight, ::testing::Values(SpotFade::Smooth, SpotFade::Square));

TEST_P(SpotLight, FadesBetweenItsAngles) {
    // Straight above the origin, turned away from it by some degrees; it fades from 20 to 40.
    for (const double turned : {0.0, 19.9, 25.0, 30.0, 37.0, 40.1, 90.0}) {
        TestScene scene = floorScene(grey(0.5f), 1);
        const double angle = turned * pi / 180.0;
        scene.lights = {{.position = {0, 0, 2},
                         .power = glm::dvec3(100.0),
                         .kind = LightKind::Spot,
                         .direction = {std::sin(angle), 0, -std::cos(angle)},
                         .angleDegrees = 40.0,
                         .blend = 0.5,
                         .fade = GetParam()}};
        const double inner = std::cos(20.0 * pi / 180.0);
        const double outer = std::cos(40.0 * pi / 180.0);
        const double t = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
        const double share = t * t * (GetParam() == SpotFade::Square ? 1.0 : 3.0 - 2.0 * t);
        const double expected = 0.5 / pi * 100.0 / (4.0 * pi) / 4.0 * share;
        if (share > 0.0)
            expectBoth(scene, expected);
        else
            expectDark(scene);
    }
}

TEST(RoughMaterial, UnderAPointLightIsItsClosedForm) {
    for (const auto kind : {MaterialKind::Conductor, MaterialKind::Principled}) {
        Material material = grey(0.6f);
        material.kind = kind;
        material.roughness = 0.6f;
        material.metallic = 0.3f;
        TestScene scene = floorScene(material, 1);
        scene.camera.position = {0.02, 0, 0.05};
        scene.camera.direction = {-0.02, 0, -0.05};
        scene.lights = {{.position = {1, 2, 2}, .power = glm::dvec3(100.0)}};
        const PackedScene scenePacked = packed(scene);
        const Direction up(0, 0, 1);
        const Direction view = glm::normalize(scene.camera.position);
        const Bsdf<double> rough = makeBsdf<double>(SceneView<double>(scenePacked), scenePacked.materials[0],
                                                    -view, up, up, false, 1.0, 0.5);
        const BsdfEval<double> lit =
            evalBsdf(SceneView<double>(scenePacked), rough, toLocal(rough.frame, Direction(1, 2, 2) / 3.0));
        expectRadiance(scene, lit.value.y * 100.0 / (4.0 * pi) / 9.0);
    }
}

// ---- Environments

/// A few bright spots on a dim gradient.
Image patchy(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = glm::vec3(0.1f + 0.02f * static_cast<float>((x * 7 + y * 3) % 11));
    image.at(width / 3, height / 4) = glm::vec3(50.0f);
    image.at(width - 1, height / 2) = glm::vec3(20.0f);
    image.at(0, 0) = glm::vec3(9.0f);
    return image;
}

/// The radiance from a direction, written out again: longitude from +z by -x, latitude from +y, linear in between.
double skyRadiance(const Environment &sky, const Direction &d) {
    const Image &image = sky.radiance;
    double u = std::atan2(-d.x, d.z) / (2.0 * pi) + sky.rotateDegrees / 360.0;
    u -= std::floor(u);
    const double x = u * image.width() - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image.height() - 0.5;
    const auto at = [&](double column, double row) {
        const int wrapped = (static_cast<int>(column) + image.width()) % image.width();
        return static_cast<double>(
            image.at(wrapped, std::clamp(static_cast<int>(row), 0, image.height() - 1)).y);
    };
    const double left = std::floor(x);
    const double upper = std::floor(y);
    const double across = x - left;
    const double down = y - upper;
    return sky.scale * ((1.0 - down) * ((1.0 - across) * at(left, upper) + across * at(left + 1, upper)) +
                        down * ((1.0 - across) * at(left, upper + 1) + across * at(left + 1, upper + 1)));
}

/// The integral of a function over all directions.
double overSphere(const std::function<double(const Direction &)> &value, int steps = 1200) {
    double sum = 0.0;
#pragma omp parallel for reduction(+ : sum)
    for (int i = 0; i < steps; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / steps;
        const double sine = std::sqrt(1.0 - z * z);
        for (int k = 0; k < 2 * steps; ++k) {
            const double angle = pi * (k + 0.5) / steps;
            sum += value({sine * std::cos(angle), sine * std::sin(angle), z});
        }
    }
    return sum * 4.0 * pi / (2.0 * steps * steps);
}

TestScene underSky(const Material &material, int samplesPerPixel, const Image &image,
                   double rotateDegrees = 0.0) {
    TestScene scene = floorScene(material, samplesPerPixel);
    scene.environment.radiance = image;
    scene.environment.rotateDegrees = rotateDegrees;
    scene.environment.scale = 0.75f;
    return scene;
}

TEST(EnvironmentLight, LightsAFloorAsTheIntegralSays) {
    for (const double turned : {0.0, 100.0, -33.0}) {
        const TestScene scene = underSky(grey(0.5f), 4096, patchy(16, 8), turned);
        const double irradiance = overSphere(
            [&](const Direction &d) { return std::max(d.z, 0.0) * skyRadiance(scene.environment, d); });
        expectRadiance(scene, 0.5 / pi * irradiance, 2e-3);
    }
}

TEST(EnvironmentLight, IsSeenBehindTheScene) {
    TestScene scene = underSky(grey(0.5f), 1, patchy(16, 8), 70.0);
    scene.meshes.clear();
    scene.settings.sampler = SamplerKind::Centre;
    Random random(701);
    for (const auto integrator : {Integrator::Path, Integrator::Whitted})
        for (int i = 0; i < 20; ++i) {
            scene.settings.integrator = integrator;
            scene.camera.direction = random.direction();
            scene.camera.up = random.direction();
            const double expected = skyRadiance(scene.environment, scene.camera.direction);
            EXPECT_NEAR(estimate(scene).mean, expected, 2e-4 * (1.0 + expected));
        }
}

TEST(EnvironmentLight, DirectionsHaveTheDensityThatTheySay) {
    const TestScene scene = underSky(grey(0.5f), 1, patchy(32, 16), 20.0);
    const PackedScene scenePacked = packed(scene);
    const SceneView<double> view(scenePacked);
    EXPECT_NEAR(overSphere([&](const Direction &d) { return environmentFrom(view, d).pdf; }), 1.0, 2e-3);
    // Nothing that shines is left out, and what is drawn lies where it says: its density and radiance are those of its
    // direction.
    Random random(702);
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<std::uint32_t>(random.bits());
        const EnvironmentLight<double> drawn = sampleEnvironment(view, uvec2(x, random.bits()));
        const EnvironmentLight<double> found = environmentFrom(view, drawn.direction);
        ASSERT_GT(drawn.pdf, 0.0);
        ASSERT_NEAR(found.radiance.x, drawn.radiance.x, 1e-4 * (1.0 + drawn.radiance.x));
        ASSERT_NEAR(skyRadiance(scene.environment, drawn.direction), drawn.radiance.x,
                    1e-4 * (1.0 + drawn.radiance.x));
    }
    for (const std::uint32_t edge : {0u, 0xFFFFFFFFu})
        EXPECT_TRUE(std::isfinite(sampleEnvironment(view, uvec2(edge)).direction.x));
    // The mean of the reciprocal density is the solid angle of the sphere.
    double sum = 0.0;
    constexpr int count = 400000;
    for (int i = 0; i < count; ++i) {
        const auto x = static_cast<std::uint32_t>(random.bits());
        sum += 1.0 / sampleEnvironment(view, uvec2(x, random.bits())).pdf;
    }
    EXPECT_NEAR(sum / count, 4.0 * pi, 0.02 * 4.0 * pi);
}

// Radiance is interpolated between the centres of pixels: of what shines in one of them, three quarters lie within its
// own column and an eighth in the column on each side.
TEST(EnvironmentLight, APixelShinesIntoItsNeighboursAlike) {
    Image image(16, 8);
    image.at(5, 4) = glm::vec3(3.0f);
    const PackedScene scene = packed(underSky(grey(0.5f), 1, image));
    const SceneView<double> view(scene);
    const auto pdfInColumn = [&](int x) {
        const double longitude = 2.0 * pi * (x + 0.5) / image.width();
        const double latitude = pi * (4 + 0.5) / image.height();
        return environmentFrom(view, Direction(-std::sin(longitude) * std::sin(latitude), std::cos(latitude),
                                               std::cos(longitude) * std::sin(latitude)))
            .pdf;
    };
    EXPECT_NEAR(pdfInColumn(4), pdfInColumn(5) / 6.0, 1e-6 * pdfInColumn(5));
    EXPECT_NEAR(pdfInColumn(6), pdfInColumn(5) / 6.0, 1e-6 * pdfInColumn(5));
    EXPECT_EQ(pdfInColumn(7), 0.0);
}

TEST(EnvironmentLight, ABlackOneIsDark) {
    const TestScene scene = underSky(grey(0.5f), 16, Image(4, 2));
    EXPECT_EQ(estimate(scene).mean, 0.0);
}

// An even image is an even background: the one is aimed at, the other is not.
TEST(EnvironmentLight, AnEvenOneIsAFurnaceForEveryMaterial) {
    Image even(4, 2);
    std::fill(even.pixels().begin(), even.pixels().end(), glm::vec3(1.0f));
    const auto expectSame = [&](const Material &material, std::optional<double> known = {}) {
        TestScene scene = floorScene(material, 4096);
        scene.meshes.clear();
        scene.settings.maxDepth = 32;
        scene.camera.position = {0.5, 0.3, 5};
        scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false});
        scene.background = glm::vec3(1.0f);
        const Estimate unaimed = estimate(scene);
        scene.environment.radiance = even;
        const Estimate aimed = estimate(scene);
        EXPECT_LT(std::abs(aimed.mean - unaimed.mean), 4.0 * std::hypot(aimed.error, unaimed.error) + 1e-5)
            << aimed.mean << " and " << unaimed.mean;
        if (known) {
            EXPECT_NEAR(aimed.mean, *known, 3e-3);
        }
    };
    Material material = grey(0.6f);
    expectSame(material, 0.6);
    material.kind = MaterialKind::Conductor;
    material.conductorIndex = glm::vec3(0.0f);
    material.conductorExtinction = glm::vec3(1.0f);
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
        material.roughness = roughness;
        expectSame(material, 1.0);
    }
    material.kind = MaterialKind::Dielectric;
    material.roughness = 0.3f;
    expectSame(material);
    material.kind = MaterialKind::Principled;
    material.albedo = glm::vec3(1.0f);
    expectSame(material, 1.0);
    material.clearcoat = 1.0f;
    material.metallic = 0.5f;
    expectSame(material);
    material.clearcoat = 0.0f;
    material.transmission = 0.7f;
    expectSame(material);
}

TEST(SeveralLights, AddUp) {
    TestScene scene = underSky(grey(0.5f), 4096, patchy(16, 8));
    const double irradiance = overSphere(
        [&](const Direction &d) { return std::max(d.z, 0.0) * skyRadiance(scene.environment, d); });
    scene.lights = {{.position = {0, 0, 2}, .power = glm::dvec3(30.0)},
                    {.power = glm::dvec3(0.7), .kind = LightKind::Directional, .direction = {0, 1, -1}}};
    scene.materials.push_back(grey(0.0f));
    scene.materials.back().emission = glm::vec3(3.0f);
    scene.spheres.push_back({{4, 0, 3}, 0.5, 1, false});
    const double fromPoint = 30.0 / (4.0 * pi) / 4.0;
    const double fromDirection = 0.7 / std::sqrt(2.0);
    const double squaredSine = 0.25 / 25.0;
    const double fromBall = (3.0 - skyRadiance(scene.environment, {0.8, 0, 0.6})) * pi * squaredSine * 0.6;
    expectRadiance(scene, 0.5 / pi * (irradiance + fromPoint + fromDirection + fromBall), 4e-3);
}

TEST(RadianceLimit, HoldsBehindTheFirstSegmentOnly) {
    // A floor under a bright ball: lit directly it keeps all of it, by two bounces no more than the limit a path.
    TestScene scene = floorScene(grey(0.5f), 256);
    scene.lights = {{.position = {0, 0, 2}, .power = glm::dvec3(3000.0)}};
    const double direct = 0.5 / pi * 3000.0 / (4.0 * pi) / 4.0;
    scene.settings.radianceLimit = 0.25;
    expectRadiance(scene, direct);
    scene.settings.maxDepth = 3;
    scene.materials.push_back(grey(0.9f));
    scene.materials.back().twoSided = true;
    scene.meshes.emplace_back();
    scene.meshes.back().materialIndex = 1;
    addQuad(scene.meshes.back(), {-3, -3, 4}, {6, 0, 0}, {0, 6, 0});
    const double limited = estimate(scene).mean;
    EXPECT_GT(limited, direct);
    EXPECT_LE(limited, direct + 0.25 + 1e-4);
    scene.settings.radianceLimit = 0.0;
    EXPECT_GT(estimate(scene).mean, direct + 1.0);
}

} // namespace
} // namespace hyalite::core::reference
