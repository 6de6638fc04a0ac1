// Views that look through mirrors and glass: the same films on both renderers, and closed forms.
#include "tests/images/plain_scenes.h"
#include "tests/images/rendering.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace hyalite::core::look_through {
namespace {

using glm::dvec3;
using testing::addBall;
using testing::addQuad;
using testing::diffuse;
using testing::emptyScene;
using testing::renderOnCpu;

constexpr std::array views{Integrator::Albedo, Integrator::Normal, Integrator::Depth};

Material ofKind(MaterialKind kind, float roughness = 0.0f) {
    Material material;
    material.kind = kind;
    material.roughness = roughness;
    return material;
}

Material gltf(float metallic, float roughness, const glm::vec3 &colour) {
    Material material = ofKind(MaterialKind::Gltf, roughness);
    material.albedo = colour;
    material.metallic = metallic;
    return material;
}

/// The view of the scene, through mirrors and glass.
TestScene through(TestScene scene, Integrator view) {
    scene.settings.integrator = view;
    scene.settings.areLayersThrough = true;
    return scene;
}

/// The mean of a view over all pixels.
dvec3 meanOfView(const TestScene &scene, Integrator view) {
    dvec3 sum(0.0);
    const Film film = renderOnCpu(through(scene, view)).film;
    for (const layout::FilmPixel &pixel : film.pixels)
        sum += dvec3(meanOf(pixel));
    return sum / static_cast<double>(film.pixels.size());
}

dvec3 normalOfColour(const dvec3 &colour) { return 2.0 * colour - 1.0; }

void expectNear(const dvec3 &found, const dvec3 &wanted, double tolerance, const std::string &what) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], wanted[channel], tolerance) << what << ", channel " << channel;
}

// ---- Twins

/// All that is looked through, before what is not, through a lens that is half in glass.
TestScene crowd() {
    TestScene scene = emptyScene(6, 9);
    scene.camera.aperture = 0.1;
    scene.settings.filter = FilterKind::BlackmanHarris;
    Material glass = ofKind(MaterialKind::Dielectric);
    glass.absorption = {0.2f, 0.9f, 0.4f};
    Material inner = glass;
    inner.priority = 1;
    inner.refractiveIndex = 1.2f;
    addBall(scene, {-0.5, 0.4, 0.2}, 0.45, glass);
    addBall(scene, {-0.4, 0.3, 0.3}, 0.25, inner);
    addBall(scene, {0.5, 0.4, 0.0}, 0.3, ofKind(MaterialKind::Mirror));
    addBall(scene, {0.1, -0.5, 0.3}, 0.3, ofKind(MaterialKind::Conductor, 0.08f));
    addBall(scene, {-0.6, -0.5, 0.1}, 0.25, gltf(1.0f, 0.05f, {0.9f, 0.6f, 0.2f}));
    addBall(scene, {0.6, -0.4, 0.2}, 0.25, ofKind(MaterialKind::Dielectric, 0.05f));
    Material varnish = ofKind(MaterialKind::Principled, 0.05f);
    varnish.albedo = {0.3f, 0.8f, 0.5f};
    varnish.transmission = 0.9f;
    addBall(scene, {0.0, 0.1, 0.5}, 0.2, varnish);
    Material pane = gltf(0.0f, 0.04f, {0.7f, 0.9f, 0.8f});
    pane.transmission = 1.0f;
    pane.isThin = true;
    pane.twoSided = true;
    addQuad(scene, {-0.9f, -0.3f, 0.8f}, {1.2f, 0.1f, 0.3f}, {0, 0.7f, 0}, pane);
    addQuad(scene, {-1.5f, -1.5f, -1.0f}, {3, 0, 0}, {0, 3, 0}, diffuse({0.7f, 0.3f, 0.2f}));
    addQuad(scene, {-1.5f, -0.9f, 2.0f}, {3, 0, 0}, {0, 0, -3}, gltf(0.0f, 0.05f, {0.2f, 0.4f, 0.9f}));
    Material veil = gltf(1.0f, 0.02f, {1.0f, 1.0f, 1.0f});
    veil.alphaMode = AlphaMode::Blend;
    veil.opacity = 0.5f;
    addQuad(scene, {0.2f, -0.2f, 1.0f}, {0.5f, 0, 0.2f}, {0, 0.6f, 0}, veil);
    addBall(scene, {0.06, 0.0, 4.0}, 0.06, glass);
    return scene;
}

class LookThrough : public ::testing::TestWithParam<Integrator> {};

void expectTwins(const TestScene &scene) {
    const PackedScene packed = testing::pack(scene);
    const reference::Result wanted = renderOnCpu(scene, packed);
    EXPECT_GT(wanted.rays.reflection, 100u);
    EXPECT_GT(wanted.rays.refraction, 100u);
    std::vector<gpu::RenderConfig> configs{testing::cutShortKernel()};
    for (const gpu::RenderConfig &kernel : testing::allKernels())
        configs.push_back(kernel);
    for (const gpu::RenderConfig &config : configs) {
        const gpu::Result device = testing::renderOnDevice(scene, packed, config);
        EXPECT_EQ(testing::differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
        EXPECT_EQ(device.rays, wanted.rays) << gpu::kernelName(config);
    }
}

TEST_P(LookThrough, HasTheSameBitsOnTheDevice) { expectTwins(through(crowd(), GetParam())); }

// What the denoiser needs: albedos, with normals and depths beside them.
TEST(Features, HaveTheSameBitsOnTheDevice) {
    TestScene scene = through(crowd(), Integrator::Albedo);
    scene.settings.areFeaturesShown = true;
    expectTwins(scene);
}

// A few spheres and metals of glTF alone, which no other integrator takes for mirrors.
TEST_P(LookThrough, HasTheSameBitsOnTheDeviceAmongMetals) {
    TestScene scene = emptyScene(8, 4);
    addBall(scene, {-0.4, 0, 0}, 0.5, gltf(1.0f, 0.05f, {0.9f, 0.6f, 0.2f}));
    addBall(scene, {0.5, 0, 0}, 0.4, gltf(1.0f, 0.05f, {0.5f, 0.6f, 0.9f}));
    const PackedScene packed = testing::pack(through(scene, GetParam()));
    EXPECT_FALSE(packed.hasSpecular);
    const reference::Result wanted = renderOnCpu(through(scene, GetParam()), packed);
    EXPECT_GT(wanted.rays.reflection, 100u);
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(1)) {
        const gpu::Result device = testing::renderOnDevice(through(scene, GetParam()), packed, config);
        EXPECT_EQ(testing::differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
        EXPECT_EQ(device.rays, wanted.rays) << gpu::kernelName(config);
    }
}

INSTANTIATE_TEST_SUITE_P(Each, LookThrough, ::testing::ValuesIn(views),
                         [](const auto &each) { return std::string(nameOf(each.param)); });

// ---- Closed forms

/// Orthographic rays along -z from z = 0 meet a square at z = -5 - x that turns what it reflects to +x: to a green wall
/// at x = 4, which faces away from it, after 9 units. Behind the square is a red wall at z = -20.
TestScene corner(const Material &material) {
    TestScene scene = emptyScene(4, 64);
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 0, 0};
    scene.camera.direction = {0, 0, -1};
    scene.camera.viewWidth = 2.0;
    addQuad(scene, {-2, -2, -3}, {4, 0, -4}, {0, 4, 0}, material);
    addQuad(scene, {4, -9, -14}, {0, 18, 0}, {0, 0, 14}, diffuse({0.1f, 0.6f, 0.2f}));
    addQuad(scene, {-9, -9, -20}, {18, 0, 0}, {0, 18, 0}, diffuse({0.8f, 0.1f, 0.3f}));
    return scene;
}

const dvec3 green(0.1f, 0.6f, 0.2f);
const dvec3 red(0.8f, 0.1f, 0.3f);

TEST(LookThroughAMirror, ShowsTheWallAndTheLengthOfBothSegments) {
    TestScene scene = corner(ofKind(MaterialKind::Mirror));
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    for (const Integrator view : views) {
        const Film film = renderOnCpu(through(scene, view)).film;
        for (const layout::FilmPixel &pixel : film.pixels) {
            const dvec3 found(meanOf(pixel));
            if (view == Integrator::Albedo)
                expectNear(found, green, 1e-7, "albedo");
            else if (view == Integrator::Normal) // on the ray's side, in world space
                expectNear(normalOfColour(found), {-1, 0, 0}, 1e-6, "normal");
            else
                expectNear(found, dvec3(9.0), 2e-6, "depth");
        }
    }
}

TEST(LookThroughAMirror, OfMetalHasTheMetalsColour) {
    Material metal = ofKind(MaterialKind::Conductor);
    metal.conductorIndex = {0.2f, 0.9f, 1.5f};
    metal.conductorExtinction = {3.9f, 2.4f, 1.9f};
    dvec3 reflectance;
    for (int channel = 0; channel < 3; ++channel) {
        const std::complex<double> index(static_cast<double>(metal.conductorIndex[channel]),
                                         static_cast<double>(metal.conductorExtinction[channel]));
        const double cosine = std::numbers::sqrt2 / 2.0;
        const std::complex<double> refracted = std::sqrt(1.0 - 0.5 / (index * index));
        const double parallel = std::norm((index * cosine - refracted) / (index * cosine + refracted));
        const double across = std::norm((cosine - index * refracted) / (cosine + index * refracted));
        reflectance[channel] = (parallel + across) / 2.0;
    }
    expectNear(meanOfView(corner(metal), Integrator::Albedo), green * reflectance, 1e-6, "conductor");
    metal.roughness = 0.1f;
    expectNear(meanOfView(corner(metal), Integrator::Albedo), green * reflectance, 1e-6,
               "polished conductor");
    const dvec3 gold(0.9f, 0.6f, 0.2f);
    const dvec3 schlick = gold + (1.0 - gold) * std::pow(1.0 - std::numbers::sqrt2 / 2.0, 5.0);
    expectNear(meanOfView(corner(gltf(1.0f, 0.1f, {0.9f, 0.6f, 0.2f})), Integrator::Albedo), green * schlick,
               1e-6, "glTF");
}

// What is rougher is shown itself, and so is what has a colour of its own.
TEST(LookThroughAMirror, EndsAtARoughnessOfATenth) {
    const glm::vec3 gold{0.9f, 0.6f, 0.2f};
    const dvec3 itself(dvec3(gold[0], gold[1], gold[2]));
    for (const Material &material :
         {gltf(1.0f, 0.11f, gold), gltf(0.0f, 0.05f, gold), gltf(0.7f, 0.05f, gold)})
        expectNear(meanOfView(corner(material), Integrator::Albedo), itself, 1e-6, "itself");
    Material unlit = gltf(1.0f, 0.0f, gold);
    unlit.isUnlit = true;
    expectNear(meanOfView(corner(unlit), Integrator::Albedo), itself, 1e-6, "unlit");
    const double depth = meanOfView(corner(gltf(1.0f, 0.11f, gold)), Integrator::Depth).x;
    EXPECT_NEAR(depth, 5.0, 1e-2);
}

// At 45 degrees, by Fresnel's equations; light is refracted once, and goes on straight as its glass fills all beyond.
TEST(LookThroughGlass, IsTheMeanByFresnelsReflectance) {
    const double cosine = std::numbers::sqrt2 / 2.0;
    const double beyond = std::sqrt(1.0 - 0.5 / (1.5 * 1.5));
    const double across = std::pow((cosine - 1.5 * beyond) / (cosine + 1.5 * beyond), 2.0);
    const double parallel = std::pow((1.5 * cosine - beyond) / (1.5 * cosine + beyond), 2.0);
    const double reflectance = (across + parallel) / 2.0;
    TestScene scene = corner(ofKind(MaterialKind::Dielectric));
    scene.settings.samplesPerPixel = 256;
    const double error = 5.0 * std::sqrt(reflectance / (256.0 * 256.0)); // of as many samples
    expectNear(meanOfView(scene, Integrator::Albedo), green * reflectance + red * (1.0 - reflectance), error,
               "albedo: not dimmed by the square of the index");
    expectNear(normalOfColour(meanOfView(scene, Integrator::Normal)),
               dvec3(-reflectance, 0, 1.0 - reflectance), 2.0 * error, "normal");
    scene.meshes[0].materialIndex = testing::addMaterial(scene, ofKind(MaterialKind::Dielectric, 0.1f));
    expectNear(meanOfView(scene, Integrator::Albedo), green * reflectance + red * (1.0 - reflectance), error,
               "clear glass");
    scene.meshes[0].materialIndex = testing::addMaterial(scene, ofKind(MaterialKind::Dielectric, 0.11f));
    expectNear(meanOfView(scene, Integrator::Albedo), dvec3(1.0), 1e-6, "rough glass is shown itself");
}

// A slab of the index of air reflects nothing: what passes has the colour of two units of it.
TEST(LookThroughGlass, HasItsColour) {
    Material glass = ofKind(MaterialKind::Dielectric);
    glass.refractiveIndex = 1.0f;
    glass.absorption = {0.1f, 0.5f, 1.5f};
    TestScene scene = emptyScene(4, 4);
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.viewWidth = 2.0;
    addQuad(scene, {-2, -2, 1}, {4, 0, 0}, {0, 4, 0}, glass);
    addQuad(scene, {-2, -2, -1}, {0, 4, 0}, {4, 0, 0}, glass);
    scene.meshes[1].materialIndex = scene.meshes[0].materialIndex;
    addQuad(scene, {-2, -2, -3}, {4, 0, 0}, {0, 4, 0}, diffuse({0.8f, 0.1f, 0.3f}));
    expectNear(meanOfView(scene, Integrator::Albedo),
               red * dvec3(std::exp(-0.2), std::exp(-1.0), std::exp(-3.0)), 1e-6, "absorption");
    expectNear(meanOfView(scene, Integrator::Depth), dvec3(7.0), 1e-5, "depth");
    // The tint of glTF's glass is that of each of its surfaces.
    Material tinted = gltf(0.0f, 0.0f, {0.5f, 0.7f, 0.9f});
    tinted.refractiveIndex = 1.0f;
    tinted.transmission = 1.0f;
    scene.meshes[0].materialIndex = scene.meshes[1].materialIndex = testing::addMaterial(scene, tinted);
    expectNear(meanOfView(scene, Integrator::Albedo), red * dvec3(0.25, 0.49, 0.81), 1e-6, "tint");
}

/// A pane of thin glass reflects its share once.
TEST(LookThroughGlass, ThatIsThinIsStraight) {
    Material pane = gltf(0.0f, 0.05f, {0.5f, 0.7f, 0.9f});
    pane.transmission = 1.0f;
    pane.isThin = true;
    TestScene scene = corner(pane);
    scene.settings.samplesPerPixel = 256;
    const double reflectance = 0.04 + 0.96 * std::pow(1.0 - std::numbers::sqrt2 / 2.0, 5.0);
    const double error = 5.0 * std::sqrt(reflectance / (256.0 * 256.0));
    expectNear(meanOfView(scene, Integrator::Albedo),
               green * reflectance + red * dvec3(0.5, 0.7, 0.9) * (1.0 - reflectance), error, "albedo");
    expectNear(meanOfView(scene, Integrator::Depth), dvec3(9.0 * reflectance + 20.0 * (1.0 - reflectance)),
               20.0 * error, "depth");
}

// A point of the lens at the distance p from its middle sends its ray through the point in focus: a wall at the distance
// d is met after d sqrt(1 + (p / f)^2).
TEST(LookThroughALens, IsTheMeanOverIt) {
    TestScene scene = emptyScene(2, 4096);
    scene.camera.position = {0, 0, 0};
    scene.camera.direction = {0, 0, -1};
    scene.camera.horizontalFovDegrees = 0.1;
    scene.camera.width = scene.camera.height = 2;
    scene.camera.aperture = 4.0;
    scene.camera.focusDistance = 4.0;
    addQuad(scene, {-90, -90, -8}, {90, 0, 0}, {0, 180, 0}, diffuse({0.1f, 0.6f, 0.2f}));
    addQuad(scene, {0, -90, -8}, {90, 0, 0}, {0, 180, 0}, diffuse({0.8f, 0.1f, 0.3f}));
    const double radius = 2.0;
    const double focus = 4.0;
    const double mean = 8.0 * 2.0 / (3.0 * radius * radius * focus) *
                        (std::pow(radius * radius + focus * focus, 1.5) - focus * focus * focus);
    EXPECT_GT(mean, 8.4) << "far from the depth of the middle";
    expectNear(meanOfView(scene, Integrator::Depth), dvec3(mean), 2e-3, "depth");
    // Out of focus, each pixel sees both walls.
    const Film film = renderOnCpu(through(scene, Integrator::Albedo)).film;
    for (const layout::FilmPixel &pixel : film.pixels)
        expectNear(dvec3(meanOf(pixel)), (green + red) / 2.0, 5e-3, "albedo");
}

TEST(LookThroughAMirror, ShowsNothingOfWhatIsOutsideOfTheScene) {
    TestScene scene = corner(ofKind(MaterialKind::Mirror));
    scene.background = {0.3f, 0.5f, 0.9f};
    scene.meshes.resize(1);
    expectNear(meanOfView(scene, Integrator::Albedo), dvec3(0.0), 0.0, "albedo");
    expectNear(normalOfColour(meanOfView(scene, Integrator::Normal)), dvec3(0.0), 0.0, "normal");
    expectNear(meanOfView(scene, Integrator::Depth), dvec3(0.0), 0.0, "depth");
}

// Two mirrors that face each other, a unit apart: the last one that maxDepth allows is shown.
TEST(LookThroughAMirror, EndsAtMaxDepth) {
    TestScene scene = emptyScene(1, 1);
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 0, 0.5};
    scene.camera.viewWidth = 1.0;
    addQuad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, ofKind(MaterialKind::Mirror));
    addQuad(scene, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, ofKind(MaterialKind::Mirror));
    for (const int depth : {1, 2, 7, 32}) {
        scene.settings.maxDepth = depth;
        expectNear(meanOfView(scene, Integrator::Depth), dvec3(depth - 0.5), 1e-5, "depth");
        expectNear(meanOfView(scene, Integrator::Albedo), dvec3(1.0), 0.0, "albedo");
        expectNear(normalOfColour(meanOfView(scene, Integrator::Normal)),
                   dvec3(0, 0, depth % 2 == 1 ? 1 : -1), 1e-6, "normal");
    }
}

// The path integrator's choices: with a lamp behind the glass and nothing else, a sample has light where its albedo is
// that of the lamp.
TEST(LookThroughGlass, IsOfWhatThePathSees) {
    TestScene scene = corner(ofKind(MaterialKind::Dielectric));
    scene.settings.samplesPerPixel = 5;
    scene.settings.maxDepth = 2;
    scene.meshes.pop_back();
    addQuad(scene, {-9, -9, -20}, {18, 0, 0}, {0, 18, 0}, testing::lamp(glm::vec3(2.25f)));
    scene.materials.back().albedo = glm::vec3(1.0f);
    scene.meshes[1].materialIndex = testing::addMaterial(scene, diffuse(glm::vec3(0.0f)));
    const Film path = renderOnCpu(scene).film; // radiance in glass is 1.5^-2 of that
    const Film albedo = renderOnCpu(through(scene, Integrator::Albedo)).film;
    std::size_t mixed = 0;
    for (std::size_t i = 0; i < path.pixels.size(); ++i) {
        const double seen = static_cast<double>(albedo.pixels[i].sum.x);
        EXPECT_NEAR(static_cast<double>(path.pixels[i].sum.x), seen, 1e-5);
        mixed += seen > 0.5 && seen < 4.5 ? 1u : 0u;
    }
    EXPECT_GT(mixed, 10u);
}

// Without the setting, views are those of the first hit.
TEST(LookThroughAMirror, NeedsTheSetting) {
    TestScene scene = corner(ofKind(MaterialKind::Mirror));
    scene.settings.integrator = Integrator::Albedo;
    EXPECT_EQ(meanOf(renderOnCpu(scene).film.pixels[0]), glm::vec3(1.0f));
    scene.settings.areLayersThrough = true;
    scene.settings.integrator = Integrator::Id;
    TestScene plain = scene;
    plain.settings.areLayersThrough = false;
    EXPECT_EQ(testing::differingPixels(renderOnCpu(scene).film, renderOnCpu(plain).film), 0u);
}

} // namespace
} // namespace hyalite::core::look_through
