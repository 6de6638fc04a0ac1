// Surfaces that are not there for every ray: cut out, blended and culled ones, by closed forms. And what meshes and
// textures of glTF show, likewise.
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyalite::core {
namespace {

using testing::texturedQuad;

/// A camera that looks along -z at the square from -1 to 1, without light.
TestScene emptyScene(int samplesPerPixel = 1024) {
    TestScene scene;
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 0, 5};
    scene.camera.direction = {0, 0, -1};
    scene.camera.viewWidth = 2.0;
    scene.camera.width = 4;
    scene.camera.height = 4;
    scene.settings.samplesPerPixel = samplesPerPixel;
    scene.settings.integrator = Integrator::Path;
    return scene;
}

/// Emits 1, blended.
Material alphaTestedLamp(float opacity) {
    Material material;
    material.albedo = glm::vec3(0.0f);
    material.emission = glm::vec3(1.0f);
    material.twoSided = true;
    material.alphaMode = AlphaMode::Blend;
    material.opacity = opacity;
    return material;
}

TriangleMesh wall(float z, std::uint32_t material = 0) {
    return texturedQuad({-2, -2, z}, {4, 0, 0}, {0, 4, 0}, material);
}

/// The mean radiance of both renderers.
void expectMean(const TestScene &scene, double expected, double tolerance) {
    for (const Film &film : {testing::renderOnDevice(scene).film, testing::renderOnCpu(scene).film}) {
        double sum = 0.0;
        double count = 0.0;
        for (const layout::FilmPixel &pixel : film.pixels) {
            sum += pixel.sum.x;
            count += pixel.sampleCount;
        }
        EXPECT_NEAR(sum / count, expected, tolerance);
    }
}

TEST(Blended, ShowsItsShareOfWhatLiesBehind) {
    TestScene scene = emptyScene();
    scene.background = glm::vec3(3.0f);
    scene.materials = {alphaTestedLamp(0.25f)};
    scene.meshes = {wall(0.0f)};
    expectMean(scene, 0.25 * 1.0 + 0.75 * 3.0, 0.02);
}

TEST(Blended, CountsEachOfSeveralLayersAndEqualOnesToo) {
    for (const float distance : {0.5f, 0.0f}) { // 0: duplicates
        TestScene scene = emptyScene();
        scene.materials = {alphaTestedLamp(0.5f)};
        scene.meshes = {wall(0.0f), wall(distance)};
        expectMean(scene, 0.75, 0.01);
    }
}

TEST(Blended, DoesNotDependOnTheOrderOfTriangles) {
    TestScene scene = emptyScene(64);
    scene.background = glm::vec3(0.5f);
    scene.materials = {alphaTestedLamp(0.5f), alphaTestedLamp(0.3f)};
    scene.materials[1].emission = {0.0f, 2.0f, 5.0f};
    scene.meshes = {wall(0.0f), wall(1.0f, 1)};
    const Film wanted = testing::renderOnCpu(scene).film;
    scene.settings.tree = TreeKind::None;
    EXPECT_EQ(testing::differingPixels(testing::renderOnCpu(scene).film, wanted), 0u);
    EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene).film, wanted), 0u);
}

TEST(Blended, CastsItsShareOfAShadow) {
    TestScene scene = emptyScene();
    scene.materials.resize(2);
    scene.materials[0].albedo = glm::vec3(1.0f);
    scene.materials[1] = alphaTestedLamp(0.4f);
    scene.materials[1].emission = glm::vec3(0.0f);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = {0, -1, -1};
    sun.power = glm::dvec3(3.14159265358979 * std::sqrt(2.0)); // the wall's radiance is 1
    scene.lights = {sun};
    scene.meshes = {wall(0.0f), texturedQuad({-9, 3, 0.1f}, {18, 0, 0}, {0, 0, 9}, 1)};
    scene.settings.maxDepth = 2;
    expectMean(scene, 0.6, 0.02);
    scene.settings.integrator = Integrator::Whitted;
    expectMean(scene, 0.6, 0.02);
}

TEST(CutOut, IsThereFromItsCutoffOn) {
    for (const float cutoff : {0.3f, 0.300001f, 0.9f}) {
        TestScene scene = emptyScene(4);
        scene.materials = {alphaTestedLamp(0.3f)};
        scene.materials[0].alphaMode = AlphaMode::CutOut;
        scene.materials[0].alphaCutoff = cutoff;
        scene.meshes = {wall(0.0f)};
        expectMean(scene, 0.3f < cutoff ? 0.0 : 1.0, 0.0);
    }
}

TEST(CutOut, FollowsTheColoursOfVertices) {
    TestScene scene = emptyScene(64);
    scene.materials = {alphaTestedLamp(1.0f)};
    scene.materials[0].alphaMode = AlphaMode::CutOut;
    TriangleMesh mesh = wall(0.0f);
    mesh.colours.values = {glm::vec4(1, 1, 1, 0), glm::vec4(1, 1, 1, 1), glm::vec4(1, 1, 1, 1),
                           glm::vec4(1, 1, 1, 0)}; // opacity grows from left to right
    mesh.colours.corners = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes = {mesh};
    const Film film = testing::renderOnCpu(scene).film;
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        EXPECT_EQ(film.pixels[i].sum.x > 0.0f, i % 4 >= 2) << i;
    expectMean(scene, 0.5, 0.0);
}

TEST(Opaque, HasNoOpacity) {
    TestScene scene = emptyScene(4);
    scene.materials = {alphaTestedLamp(0.1f)};
    scene.materials[0].alphaMode = AlphaMode::Opaque;
    scene.meshes = {wall(0.0f)};
    expectMean(scene, 1.0, 0.0);
}

TEST(Culled, IsNotThereFromBehind) {
    for (const bool isCulled : {false, true})
        for (const bool isBehind : {false, true}) {
            TestScene scene = emptyScene(4);
            scene.background = glm::vec3(7.0f);
            scene.materials = {alphaTestedLamp(1.0f)};
            scene.materials[0].isCulled = isCulled;
            scene.meshes = {isBehind ? texturedQuad({2, -2, 0}, {-4, 0, 0}, {0, 4, 0}) : wall(0.0f)};
            expectMean(scene, isCulled && isBehind ? 7.0 : 1.0, 0.0);
        }
}

TEST(Culled, CastsNoShadowFromBehind) {
    for (const float facing : {1.0f, -1.0f}) {
        TestScene scene = emptyScene(4);
        scene.materials.resize(2);
        scene.materials[0].albedo = glm::vec3(1.0f);
        scene.materials[1].isCulled = true;
        Light sun;
        sun.kind = LightKind::Directional;
        sun.direction = {0, -1, -1};
        sun.power = glm::dvec3(3.14159265358979 * std::sqrt(2.0));
        scene.lights = {sun};
        // A roof above the camera's sight, seen by shadow rays from below.
        scene.meshes = {wall(0.0f), texturedQuad({-9 * facing, 3, 0.1f}, {18 * facing, 0, 0}, {0, 0, 9}, 1)};
        scene.settings.integrator = Integrator::Whitted;
        // Winding: for facing = 1 the normal is -y: it faces the shadow rays.
        expectMean(scene, facing > 0.0f ? 0.0 : 1.0, 1e-5);
    }
}

TEST(VertexColours, TintTheBaseColour) {
    TestScene scene = emptyScene(16);
    scene.settings.integrator = Integrator::Albedo;
    scene.materials.resize(1);
    scene.materials[0].albedo = {0.5f, 1.0f, 1.0f};
    TriangleMesh mesh = wall(0.0f);
    mesh.colours.values.assign(4, glm::vec4(0.5f, 0.25f, 1.0f, 1.0f));
    mesh.colours.corners = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes = {mesh};
    expectMean(scene, 0.25, 1e-6);
}

TEST(Unlit, ShowsItsBaseColourInTheDark) {
    for (const Integrator integrator : {Integrator::Path, Integrator::Whitted}) {
        TestScene scene = emptyScene(4);
        scene.settings.integrator = integrator;
        scene.materials.resize(1);
        scene.materials[0].kind = MaterialKind::Gltf;
        scene.materials[0].albedo = glm::vec3(0.75f);
        scene.materials[0].isUnlit = true;
        scene.meshes = {wall(0.0f)};
        expectMean(scene, 0.75, 0.0);
    }
}

/// The light of the four grey levels of an image whose texel `index`, beyond its edges too, is asked for.
double lightOfTexel(int index, Wrap wrap) {
    constexpr std::uint32_t greys[] = {0, 51, 153, 255};
    if (wrap == Wrap::Clamp)
        return testing::lightOf(greys[std::clamp(index, 0, 3)]);
    const int period = wrap == Wrap::Repeat ? 4 : 8;
    const int within = (index % period + period) % period;
    return testing::lightOf(greys[within < 4 ? within : 7 - within]);
}

/// A wall that shows those levels, seen by 64 pixels from u = -1.3 to 1.7.
TestScene greyWall(Wrap wrap, bool isNearest) {
    TestScene scene = emptyScene(1);
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.integrator = Integrator::Albedo;
    scene.camera.width = 64;
    scene.camera.height = 1;
    scene.camera.viewWidth = 4.0;
    const std::uint32_t greys[] = {0, 51, 153, 255};
    scene.textures = {testing::drawnTexture(
        4, 1, [&](int x, int) { return testing::levels(greys[x], greys[x], greys[x]); })};
    Material material;
    material.albedo = glm::vec3(1.0f);
    TextureUse use;
    use.scale = {3.0f, 1.0f};
    use.offset = {-1.3f, 0.0f};
    use.wrapU = wrap;
    use.isNearest = isNearest;
    material.textures[layout::slotBaseColour] = use;
    scene.materials = {material};
    scene.meshes = {wall(0.0f)};
    return scene;
}

TEST(Wraps, RepeatMirrorAndClamp) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp})
        for (const bool isNearest : {false, true}) {
            const TestScene scene = greyWall(wrap, isNearest);
            for (const Film &film : {testing::renderOnDevice(scene).film, testing::renderOnCpu(scene).film})
                for (int x = 0; x < 64; ++x) {
                    const double place = 4.0 * (3.0 * (x + 0.5) / 64.0 - 1.3) - 0.5; // in texels
                    const double low = std::floor(place);
                    if (isNearest && std::abs(place - low - 0.5) < 1e-4)
                        continue; // between two texels
                    const double share = isNearest ? std::round(place - low) : place - low;
                    const double first = lightOfTexel(static_cast<int>(low), wrap);
                    const double second = lightOfTexel(static_cast<int>(low) + 1, wrap);
                    EXPECT_NEAR(film.pixels[static_cast<std::size_t>(x)].sum.x,
                                first + (second - first) * share, 2e-5)
                        << x;
                }
        }
}

TEST(Shear, TurnsTexturesByAQuarter) {
    // u' = v, v' = -u: what was at the bottom is at the left.
    TestScene scene = emptyScene(1);
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.integrator = Integrator::Albedo;
    scene.textures = {
        testing::drawnTexture(2, 2, [](int x, int) { return x == 0 ? 0xFF000000u : 0xFFFFFFFFu; })};
    Material material;
    material.albedo = glm::vec3(1.0f);
    TextureUse use;
    use.scale = {0.0f, 0.0f};
    use.shear = {1.0f, -1.0f};
    use.isNearest = true;
    material.textures[layout::slotBaseColour] = use;
    scene.materials = {material};
    scene.meshes = {texturedQuad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
    const Film film = testing::renderOnCpu(scene).film;
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_EQ(film.pixels[i].sum.x, i < 8 ? 1.0f : 0.0f) << i; // u' = v > 0.5 in the upper half
}

TEST(SecondCoordinates, AreThoseOfTexturesThatAskForThem) {
    TestScene scene = emptyScene(1);
    scene.settings.integrator = Integrator::Albedo;
    scene.textures = {
        testing::drawnTexture(2, 1, [](int x, int) { return x == 0 ? 0xFF000000u : 0xFFFFFFFFu; })};
    Material material;
    material.albedo = glm::vec3(1.0f);
    TextureUse use;
    use.uvSet = 1;
    material.textures[layout::slotBaseColour] = use;
    scene.materials = {material};
    TriangleMesh mesh = wall(0.0f);
    mesh.secondUvs.values = {{0.75f, 0.5f}};
    mesh.secondUvs.corners = {glm::uvec3(0), glm::uvec3(0)};
    scene.meshes = {mesh};
    expectMean(scene, 1.0, 1e-6);
}

} // namespace
} // namespace hyalite::core
