// Lookups in textures, and what is made of them, against closed forms.
#include "host/base/error.h"
#include "host/scene/validate.h"
#include "tests/fixtures/radiance_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"

#include <limits>

namespace hyalite::core::testing {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec2;
using glm::vec3;

/// A quad from (-1, -1, 0) to (1, 1, 0) that wears the texture in one slot.
TestScene quadScene(std::uint32_t slot, Texture texture) {
    TestScene scene(sceneOf(texturedQuad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})));
    scene.textures = {std::move(texture)};
    scene.materials[0].albedo = vec3(1.0f);
    scene.materials[0].textures[slot] = TextureUse{};
    if (slot == layout::slotRoughness || slot == layout::slotMetallic)
        scene.materials[0].kind = MaterialKind::Principled;
    return scene;
}

/// Looks up what the quad's material has in a slot.
class Lookup {
  public:
    explicit Lookup(const TestScene &scene, std::uint32_t slot = layout::slotBaseColour)
        : packed_(packed(scene)), row_(reference::textureRow(packed_.materials[0].textures, slot)) {}

    template <class Real> [[nodiscard]] reference::Vec3<Real> at(Real u, Real v) const {
        const reference::Vec2<Real> uv(u, v);
        return reference::lookUpTexture(reference::SceneView<Real>(packed_), row_,
                                        reference::SurfaceUv<Real>{uv, uv});
    }

  private:
    PackedScene packed_;
    std::uint32_t row_;
};

/// Four by two pixels, each of its own red and green.
Texture numbered() {
    return drawnTexture(4, 2, [](int x, int y) {
        return levels(static_cast<std::uint32_t>(10 + 60 * x), static_cast<std::uint32_t>(100 * y), 255);
    });
}

TEST(Texture, ShowsPixelsInTheirMiddlesAndBlendsBetween) {
    const Lookup lookup(quadScene(layout::slotBaseColour, numbered()));
    for (std::uint32_t x = 0; x < 4; ++x)
        for (std::uint32_t y = 0; y < 2; ++y) {
            const dvec3 found = lookup.at((x + 0.5) / 4.0, 1.0 - (y + 0.5) / 2.0);
            EXPECT_NEAR(found.x, lightOf(10 + 60 * x), 1e-7) << x << ", " << y;
            EXPECT_NEAR(found.y, lightOf(100 * y), 1e-7) << x << ", " << y;
            EXPECT_EQ(found.z, 1.0);
        }
    EXPECT_NEAR(lookup.at(0.25, 0.75).x, 0.5 * (lightOf(10) + lightOf(70)), 1e-7);
    EXPECT_NEAR(lookup.at(0.3125, 0.625).x, 0.25 * lightOf(10) + 0.75 * lightOf(70), 1e-7)
        << "three quarters of the way";
    EXPECT_NEAR(lookup.at(0.125, 0.5).y, 0.5 * lightOf(100), 1e-7);
    EXPECT_NEAR(lookup.at(0.0, 0.75).x, 0.5 * (lightOf(10) + lightOf(190)), 1e-7) << "the image repeats";
    EXPECT_NEAR(lookup.at(0.125, 0.0).y, 0.5 * lightOf(100), 1e-7);
}

TEST(Texture, RepeatsForEver) {
    const Lookup lookup(quadScene(layout::slotBaseColour, numbered()));
    for (const float u : {0.0f, 0.25f, 0.5f, 0.875f})
        for (const float whole : {-3.0f, 1.0f, 64.0f}) {
            EXPECT_EQ(lookup.at(u + whole, 0.25f), lookup.at(u, 0.25f));
            EXPECT_EQ(lookup.at(0.25f, u + whole), lookup.at(0.25f, u));
        }
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float odd :
         {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 3e38f, -3e38f, -1e-9f})
        EXPECT_EQ(lookup.at(odd, odd), lookup.at(0.0f, 0.0f)) << odd;
}

TEST(Texture, FractionsAreLessThanOne) {
    EXPECT_EQ(reference::fractionOf(-1e-9f), 0.0f) << "1 - 1e-9 is rounded to 1";
    EXPECT_EQ(reference::fractionOf(-0.25f), 0.75f);
    EXPECT_EQ(reference::fractionOf(std::nextafter(1.0f, 0.0f)), std::nextafter(1.0f, 0.0f));
}

TEST(Texture, IsScaledThenMoved) {
    TestScene scene = quadScene(layout::slotBaseColour, numbered());
    const Lookup plain(scene);
    scene.materials[0].textures[layout::slotBaseColour]->scale = {2.0f, -1.0f};
    scene.materials[0].textures[layout::slotBaseColour]->offset = {0.25f, 0.5f};
    EXPECT_EQ(Lookup(scene).at(0.25f, 0.125f), plain.at(0.75f, 0.375f));
}

TEST(Texture, OnlyColoursAreEncoded) {
    const Texture grey = drawnTexture(1, 1, [](int, int) { return levels(51, 51, 51, 102); });
    EXPECT_NEAR(Lookup(quadScene(layout::slotBaseColour, grey)).at(0.5, 0.5).x, lightOf(51), 1e-8);
    EXPECT_NEAR(Lookup(quadScene(layout::slotEmission, grey), layout::slotEmission).at(0.5, 0.5).x,
                lightOf(51), 1e-8);
    for (const std::uint32_t slot :
         {layout::slotRoughness, layout::slotMetallic, layout::slotNormal, layout::slotOpacity})
        EXPECT_NEAR(Lookup(quadScene(slot, grey), slot).at(0.5, 0.5).x, 0.2, 1e-7) << slot;
    Texture withAlpha = grey;
    withAlpha.hasAlpha = true;
    EXPECT_NEAR(Lookup(quadScene(layout::slotOpacity, withAlpha), layout::slotOpacity).at(0.5, 0.5).x, 0.4,
                1e-7);
}

TEST(Texture, IsDecodedWhereAllAreSmallEnough) {
    TestScene scene = quadScene(layout::slotBaseColour, drawnTexture(5, 3, [](int x, int y) {
                                    return levels(static_cast<std::uint32_t>(40 * x),
                                                  static_cast<std::uint32_t>(90 * y), 7);
                                }));
    const auto isOfLevels = [&](std::size_t maxDecoded) {
        const Bvh bvh = buildBvh(TreeKind::Midpoint, buildTriangles(scene), 8);
        return (packScene(scene, bvh, {.maxDecoded = maxDecoded}).texturing & layout::texturesLevels) != 0;
    };
    EXPECT_FALSE(isOfLevels(5 * 3 * 16));
    EXPECT_TRUE(isOfLevels(5 * 3 * 16 - 1));
    // As light and as a number it is decoded twice, as numbers once.
    scene.materials[0].textures[layout::slotRoughness] = scene.materials[0].textures[layout::slotBaseColour];
    scene.materials[0].textures[layout::slotMetallic] = scene.materials[0].textures[layout::slotBaseColour];
    EXPECT_FALSE(isOfLevels(2 * 5 * 3 * 16));
    EXPECT_TRUE(isOfLevels(2 * 5 * 3 * 16 - 1));
}

TEST(Texture, OfFloatsIsTakenAsItIs) {
    Texture bright;
    bright.width = 2;
    bright.height = 1;
    bright.values = {{100.0f, 0.5f, 0.0f}, {300.0f, 0.0f, 1e-6f}};
    const Lookup lookup(quadScene(layout::slotEmission, bright), layout::slotEmission);
    EXPECT_EQ(lookup.at(0.25f, 0.5f), bright.values[0]);
    EXPECT_EQ(lookup.at(0.5f, 0.5f).x, 200.0f);
}

TEST(Texture, GoesRoundSpheresAsSeenFromOutside) {
    using reference::sphereUv;
    EXPECT_EQ(sphereUv<float>({0, 0, 2}), vec2(0.5f, 0.5f)) << "the image's middle is at +z";
    EXPECT_EQ(sphereUv<float>({2, 0, 0}), vec2(0.75f, 0.5f)) << "and what is right of it on the right";
    EXPECT_EQ(sphereUv<float>({-2, 0, 0}), vec2(0.25f, 0.5f));
    EXPECT_EQ(sphereUv<float>({0, 3, 0}).y, 1.0f);
    EXPECT_EQ(sphereUv<float>({0, -3, 0}).y, 0.0f);
}

TEST(Texture, ChangesNothingWhereItIsWhite) {
    TestScene plain =
        quadScene(layout::slotBaseColour, drawnTexture(5, 3, [](int, int) { return levels(255, 255, 255); }));
    plain.camera.position = {0, 0, 3};
    plain.camera.width = 24;
    plain.camera.height = 24;
    plain.background = vec3(0.7f, 0.8f, 0.9f);
    plain.materials[0].albedo = {0.25f, 0.5f, 0.75f};
    plain.materials[0].emission = {0.5f, 0.25f, 0.125f};
    plain.settings.integrator = Integrator::Path;
    plain.settings.samplesPerPixel = 4;
    plain.spheres.push_back({{0, 0, 0.5}, 0.3, 0, false});
    TestScene textured = plain;
    plain.materials[0].textures = {};
    textured.materials[0].textures[layout::slotEmission] = TextureUse{};
    const auto imageOf = [](const TestScene &scene) {
        return reference::render(packed(scene), scene.settings, Crop{0, 24, 0, 24}).film.toImage().pixels();
    };
    EXPECT_EQ(imageOf(textured), imageOf(plain)) << "in any bit";
}

/// Looks straight at the quad, which fills the picture, from one side.
void lookAtQuad(TestScene &scene, double z) {
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.position = {0, 0, z};
    scene.camera.direction = {0, 0, -z};
    scene.camera.viewWidth = 2.0;
    scene.camera.width = 8;
    scene.camera.height = 8;
}

TEST(Texture, TheMeanOfAChequerboardIsThatOfItsLight) {
    const Texture board = drawnTexture(
        6, 6, [](int x, int y) { return (x + y) % 2 == 0 ? levels(250, 200, 30) : levels(20, 90, 130); });
    TestScene scene = quadScene(layout::slotBaseColour, board);
    lookAtQuad(scene, 5.0);
    scene.settings.integrator = Integrator::Albedo;
    scene.settings.samplesPerPixel = 256;
    expectRadiance(scene, 0.5 * (lightOf(200) + lightOf(90)), 2e-3);
    // In a furnace, where light comes from everywhere, it is what the quad sends back.
    scene.settings.integrator = Integrator::Path;
    scene.settings.maxDepth = 2;
    scene.background = vec3(2.0f);
    expectRadiance(scene, 2.0 * 0.5 * (lightOf(200) + lightOf(90)), 2e-3);
}

// ---- Normal maps

Texture flatMapTowards(const dvec3 &normal) {
    const auto level = [](double x) { return static_cast<std::uint32_t>(std::lround(127.5 + 127.5 * x)); };
    return drawnTexture(2, 2,
                        [&](int, int) { return levels(level(normal.x), level(normal.y), level(normal.z)); });
}

vec3 normalSeen(const TestScene &scene, const vec3 &origin, const vec3 &direction) {
    const PackedScene packedScene = packed(scene);
    const reference::Ray<float> ray{origin, direction};
    const auto hit = reference::closestHit(packedScene, ray);
    EXPECT_NE(hit.primitive, layout::noPrimitive);
    std::uint32_t materialIndex;
    return reference::hitSurface(reference::SceneView<float>(packedScene), hit, ray.origin, ray.direction,
                                 materialIndex)
        .normal;
}

void expectNear(const vec3 &found, const dvec3 &expected, double tolerance) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], tolerance) << "component " << i;
}

TEST(NormalMap, TurnsNormalsTowardsUAndV) {
    const dvec3 tilted = glm::normalize(dvec3(0.3, 0.2, 1.0));
    const TestScene scene = quadScene(layout::slotNormal, flatMapTowards(tilted));
    expectNear(normalSeen(scene, {0.2f, 0.1f, 5}, {0, 0, -1}), tilted, 0.006);
    // From behind it is the same normal, which those who shade turn round.
    expectNear(normalSeen(scene, {0.2f, 0.1f, -5}, {0, 0, 1}), tilted, 0.006);
    // u may grow to any side, and v against it.
    TestScene mirrored = scene;
    for (vec2 &uv : mirrored.meshes[0].uvs)
        uv = {7.0f - 3.0f * uv.x, uv.y};
    expectNear(normalSeen(mirrored, {0.2f, 0.1f, 5}, {0, 0, -1}), {-tilted.x, tilted.y, tilted.z}, 0.006);
    TestScene turned = scene;
    for (vec2 &uv : turned.meshes[0].uvs)
        uv = {uv.y, -uv.x};
    expectNear(normalSeen(turned, {0.2f, 0.1f, 5}, {0, 0, -1}), {-tilted.y, tilted.x, tilted.z}, 0.006);
    TestScene strong = scene;
    strong.materials[0].normalStrength = 2.0f;
    expectNear(normalSeen(strong, {0.2f, 0.1f, 5}, {0, 0, -1}), glm::normalize(tilted * dvec3(2.0, 2.0, 1.0)),
               0.01);
}

TEST(NormalMap, TurnsNormalsOfSpheres) {
    const dvec3 tilted = glm::normalize(dvec3(0.3, 0.2, 1.0));
    TestScene scene = quadScene(layout::slotNormal, flatMapTowards(tilted));
    scene.meshes.clear();
    scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false});
    expectNear(normalSeen(scene, {0, 0, 5}, {0, 0, -1}), tilted, 0.006);
    expectNear(normalSeen(scene, {5, 0, 0}, {-1, 0, 0}), {tilted.z, tilted.y, -tilted.x}, 0.006);
    expectNear(normalSeen(scene, {0, 5, 0}, {0, -1, 0}), {0, 1, 0}, 1e-6);
}

TEST(NormalMap, LeavesNormalsWhereCoordinatesAreOfNoUse) {
    const TestScene scene = quadScene(layout::slotNormal, flatMapTowards({0.6, 0.0, 0.8}));
    for (const vec2 &scale : {vec2(0.0f), vec2(1.0f, 0.0f), vec2(0.0f, 1.0f), vec2(3e38f, 0.0f)}) {
        TestScene flat = scene;
        for (vec2 &uv : flat.meshes[0].uvs)
            uv *= scale;
        expectNear(normalSeen(flat, {0.2f, 0.1f, 5}, {0, 0, -1}), {0, 0, 1}, 1e-6);
    }
    TestScene without = scene;
    without.meshes[0].triangleUvs.assign(2, glm::uvec3(TriangleMesh::noUv));
    expectNear(normalSeen(without, {0.2f, 0.1f, 5}, {0, 0, -1}), {0, 0, 1}, 1e-6);
}

TEST(NormalMap, FacesTheViewerAndReflectsUpwards) {
    Random random(7);
    Tally facing("mapped normals that face away", random.seed());
    Tally upward("reflections into the surface", random.seed());
    for (int i = 0; i < 20000; ++i) {
        const vec3 up(random.direction());
        const vec3 normal(random.direction());
        const vec3 direction(random.direction());
        const vec3 visible = reference::visibleNormal(direction, normal, up);
        const float side = reference::dotProduct(direction, up) > 0 ? -1.0f : 1.0f;
        facing.check(side * reference::dotProduct(direction, visible) < 0.0f);
        upward.check(side * reference::dotProduct(reference::mirrorDirection(direction, visible), up) > 0.0f);
    }
    facing.expectNone();
    upward.expectNone();
}

// ---- Cut-outs

/// Opaque in its left half.
Texture halfOpaque() {
    return drawnTexture(64, 1, [](int x, int) { return levels(255, 255, 255, x < 32 ? 255 : 0); });
}

TEST(CutOut, RaysGoOnWhereNothingIs) {
    TestScene scene = quadScene(layout::slotOpacity, halfOpaque());
    scene.textures[0].hasAlpha = true;
    addQuad(scene.meshes.emplace_back(), {-9, -9, -2}, {18, 0, 0}, {0, 18, 0});
    const PackedScene packedScene = packed(scene);
    const auto distanceAt = [&](float x) {
        return reference::closestHit(packedScene, reference::Ray<float>{{x, 0.1f, 5}, {0, 0, -1}}).distance;
    };
    EXPECT_EQ(distanceAt(-0.5f), 5.0f);
    EXPECT_EQ(distanceAt(0.5f), 7.0f);
    reference::NoCounter counter;
    const auto isShadowed = [&](float x) {
        const reference::Ray<float> ray{{x, 0.1f, -1}, {0, 0, 1}};
        return reference::isAnythingBefore(reference::SceneView<float>(packedScene), ray, 10.0f,
                                           layout::noPrimitive, counter);
    };
    EXPECT_TRUE(isShadowed(-0.5f));
    EXPECT_FALSE(isShadowed(0.5f));
}

TEST(CutOut, WhatIsCutAwayNeitherShinesNorShades) {
    // A floor under a lamp of which a half is cut away, as it is under half of the lamp.
    TestScene half = quadScene(layout::slotOpacity, halfOpaque());
    half.textures[0].hasAlpha = true;
    half.materials[0].twoSided = true;
    half.materials[0].emission = vec3(3.0f);
    half.materials[0].albedo = vec3(0.0f);
    half.materials.push_back({});
    TriangleMesh &floor = half.meshes.emplace_back();
    addQuad(floor, {-0.1f, -0.1f, -1.5f}, {0.2f, 0, 0}, {0, 0.2f, 0});
    floor.materialIndex = 1;
    half.settings.integrator = Integrator::Path;
    half.settings.samplesPerPixel = 256;
    half.settings.maxDepth = 2;
    half.camera.kind = CameraKind::Orthographic;
    half.camera.position = {0, 0, -0.5};
    half.camera.direction = {0, 0, -1};
    half.camera.viewWidth = 0.02;
    half.camera.width = half.camera.height = 8;
    TestScene smaller = half;
    smaller.materials[0].textures = {};
    smaller.meshes[0] = texturedQuad({-1, -1, 0}, {1, 0, 0}, {0, 2, 0});
    const Estimate cut = estimate(half);
    const Estimate whole = estimate(smaller);
    EXPECT_GT(whole.mean, 0.1);
    EXPECT_LT(std::abs(cut.mean - whole.mean), 4.0 * std::hypot(cut.error, whole.error));
}

// ---- Light

TEST(EmissionTexture, LightsAsItsBrightPartsDo) {
    // Squares that shine, on a board as large as the squares that do not, and the same as meshes of their own.
    const auto isBright = [](int x, int y) { return (x + 2 * y) % 3 == 0; };
    constexpr int side = 96; // pixels: the blurred edges are thin
    TestScene board =
        quadScene(layout::slotEmission, drawnTexture(side, side, [&](int x, int y) {
                      return isBright(x * 4 / side, 3 - y * 4 / side) ? levels(255, 255, 255) : 0u;
                  }));
    board.materials[0].albedo = vec3(0.0f);
    board.materials[0].emission = vec3(4.0f);
    board.materials.push_back({});
    TriangleMesh floor;
    addQuad(floor, {-0.1f, -0.1f, 0.7f}, {0, 0.2f, 0}, {0.2f, 0, 0});
    floor.materialIndex = 1;
    board.settings.integrator = Integrator::Path;
    board.settings.samplesPerPixel = 1024;
    board.settings.maxDepth = 2;
    board.camera.kind = CameraKind::Orthographic;
    board.camera.position = {0, 0, 0.5};
    board.camera.direction = {0, 0, 1};
    board.camera.viewWidth = 0.02;
    board.camera.width = board.camera.height = 8;
    TestScene squares = board;
    squares.meshes.clear();
    squares.materials[0].textures = {};
    TriangleMesh &shining = squares.meshes.emplace_back();
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            if (isBright(x, y))
                addQuad(shining,
                        {-1.0f + 0.5f * static_cast<float>(x), -1.0f + 0.5f * static_cast<float>(y), 0},
                        {0.5f, 0, 0}, {0, 0.5f, 0});
    board.meshes.push_back(floor);
    squares.meshes.push_back(floor);
    const Estimate found = estimate(board);
    const Estimate expected = estimate(squares);
    EXPECT_GT(expected.mean, 0.1);
    EXPECT_NEAR(found.mean, expected.mean, 0.004 * expected.mean);
    EXPECT_LT(std::abs(found.mean - expected.mean),
              4.0 * std::hypot(found.error, expected.error) + 0.002 * expected.mean);
}

TEST(EmissionTexture, IsAimedAtByItsMean) {
    TestScene scene =
        quadScene(layout::slotEmission,
                  drawnTexture(2, 1, [](int x, int) { return x == 0 ? levels(255, 255, 255) : 0u; }));
    scene.materials[0].emission = vec3(6.0f);
    scene.materials.push_back({});
    scene.materials[1].emission = vec3(1.0f);
    scene.meshes.push_back(texturedQuad({-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 1));
    scene.settings.integrator = Integrator::Path;
    const PackedScene packedScene = packed(scene);
    ASSERT_EQ(packedScene.emitters.size(), 4u);
    EXPECT_NEAR(packedScene.emitters[0].probability, 3.0 / 8.0, 1e-6)
        << "half of the quad's power, of three quarters";
    EXPECT_NEAR(packedScene.emitters[3].probability, 1.0 / 8.0, 1e-6);
}

// ---- What is refused

TEST(Texture, IsRefusedWhereItCannotBeWorn) {
    const auto refusalOf = [](const TestScene &scene) -> std::string {
        try {
            validateScene(scene, "test");
        } catch (const Error &error) {
            return error.what();
        }
        return {};
    };
    const TestScene fine = quadScene(layout::slotBaseColour, numbered());
    EXPECT_EQ(refusalOf(fine), "");
    TestScene scene = fine;
    scene.meshes[0].triangleUvs.clear();
    EXPECT_NE(refusalOf(scene).find("no texture coordinates"), std::string::npos) << refusalOf(scene);
    scene = fine;
    scene.meshes[0].triangleUvs[1].y = 4;
    EXPECT_NE(refusalOf(scene).find("texture coordinates of triangle 1"), std::string::npos)
        << refusalOf(scene);
    scene = fine;
    scene.materials[0].kind = MaterialKind::Mirror;
    EXPECT_NE(refusalOf(scene).find("textures"), std::string::npos);
    scene = fine;
    scene.materials[0].textures[layout::slotBaseColour]->textureIndex = 1;
    EXPECT_NE(refusalOf(scene).find("texture"), std::string::npos);
    scene = quadScene(layout::slotOpacity, numbered());
    scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false});
    EXPECT_NE(refusalOf(scene).find("only meshes are cut out"), std::string::npos) << refusalOf(scene);
    Texture floats;
    floats.width = floats.height = 1;
    floats.values = {vec3(1e25f)};
    EXPECT_NE(refusalOf(quadScene(layout::slotBaseColour, floats)).find("of floats"), std::string::npos);
    scene = quadScene(layout::slotEmission, floats);
    scene.materials[0].emission = vec3(1e10f);
    EXPECT_NE(refusalOf(scene).find("emission times"), std::string::npos) << refusalOf(scene);
}

TEST(Texture, IsPartOfTheScenesHashAndOfNothingElse) {
    const TestScene fine = quadScene(layout::slotBaseColour, numbered());
    const PackedScene with = packed(fine);
    EXPECT_EQ(with.texturing, layout::texturesBaseColour | layout::texturesCoordinates);
    TestScene other = fine;
    other.textures[0].levels[3] ^= 1u;
    EXPECT_NE(packed(other).contentHash(), with.contentHash());
    other = fine;
    other.meshes[0].uvs[0].x = 0.5f;
    EXPECT_NE(packed(other).contentHash(), with.contentHash());
    EXPECT_EQ(packed(fine, TreeKind::Sah, 1).contentHash(), with.contentHash());
    Scene without = fine;
    without.materials[0].textures = {};
    const PackedScene plain = packed(without);
    EXPECT_EQ(plain.texturing, layout::texturesCoordinates);
    without.meshes[0].uvs[0].x = 0.5f;
    EXPECT_NE(packed(without).contentHash(), plain.contentHash()) << "the integrator uv shows them";
    without.meshes[0].triangleUvs.clear();
    without.meshes[0].uvs.clear();
    EXPECT_EQ(packed(without).texturing, 0u);
    EXPECT_TRUE(packed(without).textures.empty());
}

} // namespace
} // namespace hyalite::core::testing
