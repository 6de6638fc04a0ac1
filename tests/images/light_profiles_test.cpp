// Lights with profiles: irradiance on a plane by the formula, the symmetries of files, one picture of both renderers, and
// the same mean whichever way lights are chosen.
#include "host/import/ies.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/profile_of_lamp.h"
#include "tests/images/rendering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

using std::numbers::pi;

/// A floor at y = 0, seen from above by parallel rays: x to the right and z down, from -4 to 4.
TestScene floorBelow(int size) {
    TestScene scene;
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 10, 0};
    scene.camera.direction = {0, -1, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.viewWidth = 8.0;
    scene.camera.width = scene.camera.height = size;
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    scene.materials.resize(1);
    scene.materials[0].albedo = glm::vec3(1.0f);
    scene.meshes.emplace_back();
    testing::addQuad(scene.meshes.back(), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    return scene;
}

/// The point of the floor that a pixel shows.
glm::dvec3 pointAt(const TestScene &scene, int x, int y) {
    const double step = scene.camera.viewWidth / scene.camera.width;
    return {(x + 0.5) * step - 4.0, 0.0, (y + 0.5) * step - 4.0};
}

/// Irradiance is I cos / r^2; a white floor reflects its pi-th part.
void expectFloor(TestScene scene, const std::function<double(const glm::dvec3 &)> &intensity,
                 double tolerance) {
    for (const Integrator integrator : {Integrator::Whitted, Integrator::Path}) {
        scene.settings.integrator = integrator;
        scene.settings.maxDepth = 2;
        const Light &lamp = scene.lights[0];
        const Image device = renderOnDevice(scene).film.toImage();
        const Image cpu = renderOnCpu(scene).film.toImage();
        int wrongCount = 0;
        for (int y = 0; y < device.height(); ++y)
            for (int x = 0; x < device.width(); ++x) {
                const glm::dvec3 way = pointAt(scene, x, y) - lamp.position;
                const double r = glm::length(way);
                const double expected = intensity(way / r) * (-way.y / r) / (r * r) / pi;
                const bool isRight = std::abs(double{device.at(x, y).y} - expected) <= tolerance * expected &&
                                     device.at(x, y) == cpu.at(x, y);
                if (!isRight && ++wrongCount <= 3)
                    ADD_FAILURE() << x << ", " << y << ": " << device.at(x, y).y << " instead of "
                                  << expected;
            }
        EXPECT_EQ(wrongCount, 0);
    }
}

Light lampAbove(double height) {
    Light lamp;
    lamp.position = {0.3, height, -0.2};
    lamp.power = glm::dvec3(4.0 * pi * 100.0); // 100 cd
    lamp.profile = 0;
    return lamp;
}

/// A file with a value at each degree of gamma and each 15 degrees of C, up to `lastPlane`.
std::string fileOf(const std::function<double(double, double)> &intensity, int lastPlane) {
    std::string text =
        fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 181 {} 1 2 0 0 0\n1 1 50\n", lastPlane / 15 + 1);
    for (int gamma = 0; gamma <= 180; ++gamma)
        text += fmt::format("{}\n", gamma);
    for (int plane = 0; plane <= lastPlane; plane += 15)
        text += fmt::format("{} ", plane);
    for (int plane = 0; plane <= lastPlane; plane += 15)
        for (int gamma = 0; gamma <= 180; ++gamma)
            text += fmt::format("\n{}", intensity(gamma * pi / 180.0, plane * pi / 180.0));
    return text;
}

LightProfile profileOf(const std::string &text) {
    return readIes(InputFile("lamp.ies", std::as_bytes(std::span(text)))).profile;
}

// A lamp as bright in each direction as a power of the cosine says, at whole degrees, and straight between them.
TEST(LightProfiles, TheFloorBelowALampIsLitByItsFormula) {
    for (const double power : {0.0, 1.0, 3.0, 8.0}) {
        const auto share = [&](double degrees) {
            return std::pow(std::max(std::cos(degrees * pi / 180.0), 0.0), power);
        };
        TestScene scene = floorBelow(24);
        scene.profiles = {
            profileOf(fileOf([&](double gamma, double) { return 500.0 * share(gamma * 180.0 / pi); }, 0))};
        for (const double height : {1.0, 3.0}) {
            scene.lights = {lampAbove(height)};
            expectFloor(
                scene,
                [&](const glm::dvec3 &way) {
                    const double gamma = std::acos(-way.y) * 180.0 / pi;
                    const double low = std::floor(gamma);
                    return 100.0 * (share(low) * (low + 1.0 - gamma) + share(low + 1.0) * (gamma - low));
                },
                2e-4);
        }
    }
}

// Linear in both angles, so that interpolation is exact: C from 0 at +x over 90 degrees at -z, which is counter-clockwise
// for who looks down on the floor.
TEST(LightProfiles, C0AndTheSenseOfCAreTheStandards) {
    const auto intensity = [](double gamma, double c) { return (0.5 + c / (4.0 * pi)) * (1.0 - gamma / pi); };
    TestScene scene = floorBelow(25);
    const std::string text = fileOf(
        [&](double gamma, double c) { return c > 6.28 ? 0.5 * (1.0 - gamma / pi) : intensity(gamma, c); },
        345);
    scene.profiles = {profileOf(text)};
    const double greatest = intensity(0.0, 345.0 / 180.0 * pi);
    for (const glm::dvec3 &c0 : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 2), glm::dvec3(-1, 5, 1)}) {
        scene.lights = {lampAbove(2.0)};
        scene.lights[0].c0 = c0;
        const double start = std::atan2(-c0.z, c0.x);
        expectFloor(
            scene,
            [&](const glm::dvec3 &way) {
                double c = std::atan2(-way.z, way.x) - start;
                c += c < 0.0 ? 2.0 * pi : 0.0;
                const double last = 345.0 / 180.0 * pi; // from there on back to C = 0
                const double share = std::max(c - last, 0.0) / (2.0 * pi - last);
                const double gamma = std::acos(-way.y);
                return 100.0 *
                       (intensity(gamma, std::min(c, last)) * (1.0 - share) + intensity(gamma, 0.0) * share) /
                       greatest;
            },
            2e-4);
    }
}

TEST(LightProfiles, SymmetricFilesMakeSymmetricPictures) {
    const auto crooked = [](double gamma, double c) {
        return 1.0 + gamma * (2.0 + std::sin(c) + std::cos(c));
    };
    const auto pictureOf = [&](int lastPlane) {
        TestScene scene = floorBelow(24);
        scene.profiles = {profileOf(fileOf(crooked, lastPlane))};
        scene.lights = {lampAbove(2.0)};
        scene.lights[0].position = {0, 2, 0};
        return renderOnCpu(scene).film.toImage();
    };
    const auto difference = [](const Image &image, bool isTurned, bool isMirrored) {
        float most = 0.0f;
        const int last = image.width() - 1;
        for (int y = 0; y <= last; ++y)
            for (int x = 0; x <= last; ++x)
                most = std::max(most,
                                std::abs(image.at(x, y).y /
                                             image.at(isTurned ? last - x : x, isMirrored ? last - y : y).y -
                                         1.0f));
        return most;
    };
    const Image quarters = pictureOf(90);
    EXPECT_LT(difference(quarters, true, false), 1e-4f);
    EXPECT_LT(difference(quarters, false, true), 1e-4f);
    const Image halves = pictureOf(180);
    EXPECT_GT(difference(halves, true, false), 0.1f);
    EXPECT_LT(difference(halves, false, true), 1e-4f);
    const Image whole = pictureOf(360);
    EXPECT_GT(difference(whole, true, false), 0.1f);
    EXPECT_GT(difference(whole, false, true), 0.1f);
    const Image round = pictureOf(0);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            EXPECT_NEAR(round.at(x, y).y / round.at(y, x).y, 1.0f, 1e-4f);
}

TEST(LightProfiles, ASpotsConeBoundsThem) {
    TestScene scene = floorBelow(24);
    scene.profiles = {profileOf(fileOf([](double, double) { return 7.0; }, 0))};
    scene.lights = {lampAbove(2.0)};
    scene.lights[0].kind = LightKind::Spot;
    scene.lights[0].angleDegrees = 40.0;
    scene.lights[0].blend = 0.0;
    const double outer = std::cos(40.0 * pi / 180.0);
    expectFloor(
        scene, [&](const glm::dvec3 &way) { return -way.y > outer ? 100.0 : 0.0; }, 1e-4);
}

/// Lamps with and without profiles, above and beside a floor and a wall.
TestScene showroom(int lampCount) {
    TestScene scene = floorBelow(32);
    scene.camera.position = {1, 6, 6};
    scene.camera.direction = {-0.2, -1.0, -1.0};
    scene.camera.up = {0, 1, 0};
    scene.materials[0].albedo = {0.6f, 0.7f, 0.8f};
    scene.meshes.emplace_back();
    testing::addQuad(scene.meshes.back(), {-5, 0, -3}, {10, 0, 0}, {0, 5, 0});
    scene.profiles = {testing::crookedLamp(), testing::ringLamp(), testing::uplight()};
    testing::Random random(11);
    for (int i = 0; i < lampCount; ++i) {
        Light lamp;
        lamp.kind = i % 5 == 0 ? LightKind::Spot : LightKind::Point;
        lamp.position = random.inCube(2.0) + glm::dvec3(0, 3.5, 0);
        lamp.direction = random.direction();
        lamp.c0 = random.direction();
        lamp.angleDegrees = 100.0;
        lamp.power = glm::dvec3(random.uniform(2.0, 20.0), 8.0, 5.0);
        if (i % 4 != 3)
            lamp.profile = static_cast<std::uint32_t>(i % 4);
        scene.lights.push_back(lamp);
    }
    scene.settings.sampler = SamplerKind::Sobol;
    scene.settings.samplesPerPixel = 2;
    scene.settings.maxDepth = 3;
    scene.settings.tree = TreeKind::Sah;
    return scene;
}

TEST(LightProfiles, BothRenderersHaveOnePicture) {
    std::size_t turn = 0;
    for (const int lampCount : {1, 5, 20})
        for (const Integrator integrator : {Integrator::Path, Integrator::Whitted})
            for (const LightChoice choice : {LightChoice::Power, LightChoice::Tree}) {
                TestScene scene = showroom(lampCount);
                scene.settings.integrator = integrator;
                scene.settings.lightChoice = choice;
                const reference::Result wanted = renderOnCpu(scene);
                for (const gpu::RenderConfig &config : testing::kernelsInTurn(turn++)) {
                    const gpu::Result device = renderOnDevice(scene, config);
                    EXPECT_EQ(differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
                    EXPECT_EQ(device.rays, wanted.rays);
                }
            }
}

TEST(LightProfiles, MeansDoNotDependOnHowLightsAreChosen) {
    TestScene scene = showroom(16);
    scene.settings.integrator = Integrator::Path;
    scene.settings.maxDepth = 2;
    scene.settings.samplesPerPixel = 256;
    const auto meanBy = [&](LightChoice choice) {
        scene.settings.lightChoice = choice;
        const Image image = renderOnCpu(scene).film.toImage();
        glm::dvec3 sum(0.0);
        for (const glm::vec3 &pixel : image.pixels())
            sum += glm::dvec3(pixel);
        return sum / static_cast<double>(image.pixels().size());
    };
    const glm::dvec3 byPower = meanBy(LightChoice::Power);
    const glm::dvec3 byTree = meanBy(LightChoice::Tree);
    scene.settings.integrator = Integrator::Whitted; // all lights at each point
    const glm::dvec3 byAll = meanBy(LightChoice::Auto);
    for (glm::length_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(byPower[channel] / byAll[channel], 1.0, 5e-3);
        EXPECT_NEAR(byTree[channel] / byAll[channel], 1.0, 5e-3);
    }
}

} // namespace
} // namespace hyalite::core
