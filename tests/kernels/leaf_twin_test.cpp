// Each function of shaders/*.glsl against its twin in host/reference: the same bits for the same input.
#include "host/packing/microfacet_energy.h"
#include "host/packing/pixel_filter.h"
#include "tests/fixtures/leaves.h"
#include "tests/kernels/probe_device.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <ostream>
#include <string>

namespace hyalite::core::testing {
namespace {

using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;

// Of equal components of different sign, as 0 and -0, either may be the largest.
vec3 pointWithoutNegativeZero(Draw &draw) { return draw.point() + vec3(0.0f); }

// ---- Random numbers

TEST(RandomTwin, SamplePixel) {
    for (const std::uint32_t samplerKind : {layout::samplerCentre, layout::samplerSobol}) {
        const auto call = [&](Draw &draw, Words &input, Words &expected) {
            const std::uint32_t x = draw.index(5000);
            const uvec2 pixel(x, draw.index(5000));
            const std::uint32_t sampleIndex = draw.chance(2) ? draw.index(64) : draw.word();
            const std::uint32_t seed = draw.word();
            input << pixel << sampleIndex << seed;
            expected << reference::samplePixel<float>(samplerKind, pixel, sampleIndex, seed);
        };
        expectTwin(probeSamplePixel, call, {{}, samplerKind});
    }
}

// ---- Camera

TEST(CameraTwin, PrimaryDirection) {
    Draw views;
    for (int view = 0; view < 4; ++view) {
        ProbeScene scene;
        scene.frame.imageWidth = 1 + views.index(4000);
        scene.frame.imageHeight = 1 + views.index(4000);
        scene.frame.imagePlane = views.direction();
        scene.frame.pixelRight = 1e-3f * views.direction();
        scene.frame.pixelUp = 1e-3f * views.direction();
        const auto call = [&](Draw &draw, Words &input, Words &expected) {
            const std::uint32_t x = draw.index(scene.frame.imageWidth);
            const uvec2 pixel(x, draw.index(scene.frame.imageHeight));
            const float offsetX = draw.chance(8) ? 0.0f : draw.unit();
            const vec2 offset(offsetX, draw.chance(8) ? 0.5f : draw.unit());
            input << pixel << offset;
            expected << reference::primaryDirection<float>(scene.frame, pixel, offset);
        };
        expectTwin(probePrimaryDirection, call, scene);
    }
}

// ---- Boxes

struct Box {
    vec3 lower;
    vec3 upper;
};

/// Often flat in some axis.
Box drawBox(Draw &draw) {
    const vec3 a = draw.point();
    vec3 b = draw.point();
    for (int axis = 0; axis < 3; ++axis)
        if (draw.chance(6))
            b[axis] = a[axis];
    return {glm::min(a, b), glm::max(a, b)};
}

/// Often on a face, an edge or a corner of the box.
vec3 drawOrigin(Draw &draw, const Box &box) {
    vec3 origin = draw.point();
    for (int axis = 0; axis < 3; ++axis)
        if (draw.chance(6))
            origin[axis] = draw.chance(2) ? box.lower[axis] : box.upper[axis];
    return origin;
}

// ---- Instances

/// The members that leaves read. Rows may be much longer than others, but are not 0.
layout::InstanceRecord drawInstance(Draw &draw, Words &input) {
    const auto row = [&] { return draw.direction() * (draw.chance(4) ? 0x1p-12f : 1.0f); };
    layout::InstanceRecord instance{};
    instance.toX = row();
    instance.toY = row();
    instance.toZ = row();
    const vec3 offset = draw.point();
    instance.offsetX = offset.x;
    instance.offsetY = offset.y;
    instance.offsetZ = offset.z;
    instance.slack = glm::abs(draw.point()) * 0x1p-20f;
    input << instance.toX << instance.toY << instance.toZ << offset << instance.slack;
    return instance;
}

// ---- Triangles

struct Triangle {
    vec3 v0;
    vec3 v1;
    vec3 v2;
};

/// Sometimes a needle, or without area.
Triangle drawTriangle(Draw &draw) {
    Triangle triangle{draw.point(), {}, {}};
    triangle.v1 = draw.point();
    triangle.v2 = draw.point();
    switch (draw.index(16)) {
    case 0:
        triangle.v2 = triangle.v1;
        break;
    case 1:
        triangle.v2 = 0.5f * (triangle.v0 + triangle.v1);
        break;
    default:
        break;
    }
    return triangle;
}

/// A point of the triangle's plane, often on an edge or a vertex.
vec3 drawTarget(Draw &draw, const Triangle &triangle) {
    switch (draw.index(4)) {
    case 0:
        return triangle.v1;
    case 1:
        return 0.5f * (triangle.v0 + triangle.v2);
    default:
        const float u = draw.unit();
        return reference::trianglePoint(triangle.v0, triangle.v1, triangle.v2, u, draw.unit());
    }
}

TEST(TriangleTwin, IntersectTriangle) {
    std::size_t hitCount = 0;
    expectTwin(probeIntersectTriangle, [&](Draw &draw, Words &input, Words &expected) {
        const Triangle triangle = drawTriangle(draw);
        vec3 origin = draw.point();
        const vec3 target = drawTarget(draw, triangle);
        vec3 direction = draw.chance(8) ? draw.direction() : draw.towards(origin, target);
        if (draw.chance(8)) { // along an axis, so that edge functions are exactly 0
            const int axis = static_cast<int>(draw.index(3));
            direction = vec3(draw.chance(2) ? -0.0f : 0.0f);
            direction[axis] = draw.chance(2) ? -1.0f : 1.0f;
            origin = target - direction * draw.coordinate();
        }
        const vec3 lower = glm::min(glm::min(triangle.v0, triangle.v1), triangle.v2);
        const vec3 upper = glm::max(glm::max(triangle.v0, triangle.v1), triangle.v2);
        input << origin << direction << lower << upper << triangle.v0 << triangle.v1 << triangle.v2;
        const reference::TriangleHit<float> hit = intersectTriangle(
            reference::makeTriangleRay(origin, direction),
            reference::makeBoxRay(origin, direction, lower, upper), triangle.v0, triangle.v1, triangle.v2);
        hitCount += hit.distance > 0.0f ? 1u : 0u;
        expected << (hit.distance == 0.0f ? 0.0f : hit.distance) << hit.u << hit.v;
    });
    EXPECT_GT(hitCount, probeInputCount / 8);
    EXPECT_LT(hitCount, probeInputCount / 8 * 7);
}

TEST(TriangleTwin, IntersectPair) {
    std::size_t hitCount = 0;
    expectTwin(probeIntersectPair, [&](Draw &draw, Words &input, Words &expected) {
        const Triangle triangle = drawTriangle(draw);
        const reference::JoinedTriangles<float> pair{triangle.v0,  triangle.v1,   triangle.v2,
                                                     draw.point(), draw.index(3), draw.index(3)};
        const vec3 origin = draw.point();
        const vec3 target = draw.chance(2) ? drawTarget(draw, triangle)
                                           : drawTarget(draw, {triangle.v1, triangle.v0, pair.secondApex});
        const vec3 direction = draw.chance(8) ? draw.direction() : draw.towards(origin, target);
        const vec3 lower =
            glm::min(glm::min(pair.begin, pair.end), glm::min(pair.firstApex, pair.secondApex));
        const vec3 upper =
            glm::max(glm::max(pair.begin, pair.end), glm::max(pair.firstApex, pair.secondApex));
        const bool takesFirst = !draw.chance(8);
        const bool takesSecond = !draw.chance(8);
        input << origin << direction << lower << upper << pair.begin << pair.end << pair.firstApex
              << pair.secondApex << pair.firstCorner << pair.secondCorner << (takesFirst ? 1u : 0u)
              << (takesSecond ? 1u : 0u);
        const reference::PairHit<float> found = intersectPair(
            reference::makeTriangleRay(origin, direction),
            reference::makeBoxRay(origin, direction, lower, upper), pair, takesFirst, takesSecond);
        hitCount += found.hit.distance > 0.0f ? 1u : 0u;
        expected << (found.hit.distance == 0.0f ? 0.0f : found.hit.distance) << found.hit.u << found.hit.v
                 << (found.isSecond ? 1u : 0u) + (found.isBoth ? 2u : 0u) +
                        (found.hit.distance > 0.0f && found.hit.isBehind ? 4u : 0u);
    });
    EXPECT_GT(hitCount, probeInputCount / 8);
    EXPECT_LT(hitCount, probeInputCount / 8 * 7);
}

// ---- Spheres

TEST(SphereTwin, IntersectSphere) {
    std::size_t hitCount = 0;
    expectTwin(probeIntersectSphere, [&](Draw &draw, Words &input, Words &expected) {
        const vec3 centre = draw.point();
        const float radius = draw.chance(8) ? 940.0f : 0.01f + 10.0f * draw.unit();
        vec3 origin = draw.point();
        vec3 direction = draw.chance(4) ? draw.direction() : draw.towards(origin, centre);
        if (draw.chance(8)) // grazing
            origin = centre + radius * draw.direction();
        if (draw.chance(8))
            direction = draw.direction();
        const bool startsOnSphere = draw.chance(2);
        input << origin << direction << centre << radius << std::uint32_t{startsOnSphere};
        const float distance = reference::intersectSphere(origin, direction, centre, radius, startsOnSphere);
        hitCount += distance > 0.0f ? 1u : 0u;
        expected << distance;
    });
    EXPECT_GT(hitCount, probeInputCount / 8);
    EXPECT_LT(hitCount, probeInputCount / 8 * 7);
}

// ---- Glass

TEST(DielectricTwin, RefractRay) {
    std::size_t totalCount = 0;
    expectTwin(probeRefractRay, [&](Draw &draw, Words &input, Words &expected) {
        const vec3 facing = draw.direction();
        vec3 direction = draw.chance(16) ? -facing : draw.direction();
        if (reference::dotProduct(direction, facing) > 0.0f)
            direction = -direction;
        const float index = draw.chance(8) ? 1.0f : 1.0f + 1.5f * draw.unit();
        const bool isEntering = draw.chance(2);
        input << direction << facing << index << std::uint32_t{isEntering};
        const reference::Refraction<float> refraction =
            reference::refractRay(direction, facing, index, isEntering);
        totalCount += refraction.isTotal ? 1u : 0u;
        expected << refraction.direction << refraction.reflectance << refraction.transmittance
                 << std::uint32_t{refraction.isTotal};
    });
    EXPECT_GT(totalCount, probeInputCount / 16);
}

// ---- Surfaces

Words &operator<<(Words &words, const reference::Surface<float> &surface) {
    return words << surface.position << surface.error << surface.normal << surface.geometricNormal;
}

// ---- Sampling

vec2 unitPair(Draw &draw) {
    const float x = draw.chance(64) ? 0.0f : draw.unit();
    return {x, draw.chance(64) ? 1.0f - 0x1p-24f : draw.unit()};
}

/// An environment of random texels, packed as the host does.
PackedScene sceneUnderSky() {
    Draw draw;
    Scene scene;
    scene.environment.radiance = Image(37, 19);
    for (vec3 &pixel : scene.environment.radiance.pixels())
        pixel = draw.chance(3) ? vec3(0.0f) : vec3(draw.unit(), draw.unit() * 9.0f, draw.unit());
    scene.environment.rotateDegrees = 123.0;
    return packScene(scene, buildBvh(TreeKind::None, std::vector<BuildTriangle>{}, 1));
}

TEST(EnvironmentTwin, FromADirection) {
    const PackedScene packed = sceneUnderSky();
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        const vec3 direction = draw.direction();
        const auto light = reference::environmentFrom(reference::SceneView<float>(packed), direction);
        input << direction;
        expected << light.radiance << light.pdf;
    };
    expectTwin(probeEnvironmentFrom, call, {.frame = packed.frame, .lookups = packed.lookups});
}

TEST(EnvironmentTwin, Sampled) {
    const PackedScene packed = sceneUnderSky();
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        const std::uint32_t x = draw.word();
        const uvec2 bits(x, draw.word());
        const auto light = reference::sampleEnvironment(reference::SceneView<float>(packed), bits);
        input << bits;
        expected << light.direction << light.radiance << light.pdf;
    };
    expectTwin(probeSampleEnvironment, call, {.frame = packed.frame, .lookups = packed.lookups});
}

// ---- Textures

/// A material with a texture of 8-bit colours, one of floats, one of numbers, a normal map, and one's alpha, in this
/// order of rows.
PackedScene texturedScene() {
    Draw draw;
    Scene scene;
    for (const uvec2 size : {uvec2(13, 7), uvec2(5, 9), uvec2(1, 1), uvec2(64, 32)}) {
        Texture &texture = scene.textures.emplace_back();
        texture.width = static_cast<int>(size.x);
        texture.height = static_cast<int>(size.y);
        texture.hasAlpha = true;
        for (std::uint32_t i = 0; i < size.x * size.y; ++i)
            texture.levels.push_back(draw.word());
    }
    scene.textures[1].levels.clear();
    for (std::uint32_t i = 0; i < 45; ++i)
        scene.textures[1].values.push_back(
            vec3(draw.unit(), draw.unit() * 1e6f, draw.chance(2) ? 0.0f : 1e-6f));
    Material &material = scene.materials.emplace_back();
    material.kind = MaterialKind::Principled;
    material.textures[layout::slotBaseColour] = TextureUse{0, {2.5f, -3.0f}, {0.125f, 0.3f}};
    material.textures[layout::slotEmission] = TextureUse{1, {1.0f, 1.0f}, {0.0f, 0.0f}};
    material.textures[layout::slotRoughness] = TextureUse{2, {1.0f, 1.0f}, {0.0f, 0.0f}};
    material.textures[layout::slotNormal] = TextureUse{3, {1.0f, 0.5f}, {0.0f, 0.0f}};
    material.textures[layout::slotOpacity] = TextureUse{3, {1.0f, 1.0f}, {0.5f, 0.0f}};
    material.normalStrength = 1.5f;
    scene.spheres.push_back({});
    return packScene(scene, buildBvh(TreeKind::None, std::vector<BuildTriangle>{}, 1));
}

float drawUv(Draw &draw) {
    constexpr float odd[] = {0.0f,
                             1.0f,
                             -1.0f,
                             0.5f,
                             3e38f,
                             -3e38f,
                             -1e-8f,
                             0.99999994f,
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()};
    return draw.chance(8) ? odd[draw.index(10)] : draw.chance(4) ? draw.coordinate() * 1000.0f : draw.unit();
}

vec2 drawUvs(Draw &draw) {
    const float u = drawUv(draw);
    return {u, drawUv(draw)};
}

TEST(TextureTwin, LookUpTexture) {
    const PackedScene packed = texturedScene();
    constexpr std::uint32_t slots[] = {layout::slotBaseColour, layout::slotEmission, layout::slotRoughness,
                                       layout::slotNormal, layout::slotOpacity};
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        const std::uint32_t row = reference::textureRow(packed.materials[0].textures, slots[draw.index(5)]);
        const reference::SurfaceUv<float> uvs{drawUvs(draw), drawUvs(draw)};
        input << row << uvs.first << uvs.second;
        expected << reference::lookUpTexture(reference::SceneView<float>(packed), row, uvs);
    };
    expectTwin(probeLookUpTexture, call, {.textures = packed.textures, .texturing = packed.texturing});
}

TEST(NormalMapTwin, MappedNormal) {
    const PackedScene packed = texturedScene();
    const std::uint32_t row = reference::textureRow(packed.materials[0].textures, layout::slotNormal);
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        layout::TriangleRecord triangle{};
        triangle.v0 = draw.point();
        triangle.v1 = draw.point();
        triangle.v2 = draw.chance(16) ? triangle.v1 : draw.point();
        reference::Coordinates<float> at{drawUvs(draw), drawUvs(draw), drawUvs(draw)};
        if (draw.chance(16))
            at.uv2 = at.uv1;
        const vec3 normal = draw.direction();
        input << triangle.v0 << triangle.v1 << triangle.v2 << at.uv0 << at.uv1 << at.uv2 << normal << row
              << row;
        const auto tangent = reference::triangleTangent<float>(triangle, at);
        expected << tangent.alongU << tangent.alongV
                 << reference::mappedNormal(reference::SceneView<float>(packed), normal, tangent, row,
                                            {at.uv0, at.uv0})
                 << reference::mappedNormal(reference::SceneView<float>(packed), normal,
                                            reference::sphereTangent(normal), row, {at.uv1, at.uv1});
    };
    expectTwin(probeMappedNormal, call, {.textures = packed.textures, .texturing = packed.texturing});
}

TEST(CameraTwin, PrimaryRay) {
    for (const std::uint32_t camera :
         {layout::cameraPinhole, layout::cameraLens, layout::cameraOrthographic, layout::cameraPanorama}) {
        Draw views;
        PackedScene packed;
        packed.camera = camera;
        packed.frame.eye = views.point();
        packed.frame.imageWidth = 1 + views.index(4000);
        packed.frame.imageHeight = 1 + views.index(4000);
        packed.frame.imagePlane = views.direction();
        packed.frame.pixelRight = 1e-3f * views.direction();
        packed.frame.pixelUp = 1e-3f * views.direction();
        packed.frame.lensScale = 5.0f;
        packed.frame.focusDistance = 7.0f;
        const auto call = [&](Draw &draw, Words &input, Words &expected) {
            const std::uint32_t x = draw.index(packed.frame.imageWidth);
            const uvec2 pixel(x, draw.index(packed.frame.imageHeight));
            const std::uint32_t sample = draw.index(65536);
            const auto ray = reference::primaryRay<float>(packed, layout::samplerSobol, pixel, sample);
            input << pixel << sample;
            expected << ray.origin << ray.direction;
        };
        expectTwin(probePrimaryRay, call, {.frame = packed.frame, .camera = camera});
    }
}

TEST(CameraTwin, PrimaryRayThroughTheFilterOfPixels) {
    for (const std::uint32_t camera : {layout::cameraPinhole, layout::cameraPanorama}) {
        Draw views;
        PackedScene packed;
        packed.camera = camera;
        packed.frame.imageWidth = 1 + views.index(9); // rays go around the panorama
        packed.frame.imageHeight = 1 + views.index(9);
        packed.frame.imagePlane = views.direction();
        packed.frame.pixelRight = views.direction();
        packed.frame.pixelUp = views.direction();
        packed.lookups.resize(3);
        packFilter(packed);
        const auto call = [&](Draw &draw, Words &input, Words &expected) {
            const std::uint32_t x = draw.index(packed.frame.imageWidth);
            const uvec2 pixel(x, draw.index(packed.frame.imageHeight));
            const std::uint32_t sample = draw.index(65536);
            const auto ray = reference::primaryRay<float>(packed, layout::samplerFiltered, pixel, sample);
            EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-6f);
            input << pixel << sample;
            expected << ray.origin << ray.direction;
        };
        expectTwin(probePrimaryRay, call,
                   {.frame = packed.frame,
                    .samplerKind = layout::samplerFiltered,
                    .lookups = packed.lookups,
                    .camera = camera});
    }
}

// ---- BSDFs

/// Above the plane, and not so low that float32 has nothing to say.
vec3 drawAbove(Draw &draw) {
    vec3 v = draw.direction();
    v.z = std::abs(v.z) + 0.001f;
    return reference::unitVector(v);
}

float drawAlpha(Draw &draw) { return draw.chance(8) ? 0.0016f : 0.002f + 0.998f * draw.unit(); }

vec3 drawColour(Draw &draw) {
    const float red = draw.unit();
    const float green = draw.unit();
    return {red, green, draw.chance(8) ? 0.0f : draw.unit()};
}

TEST(EnergyTwin, OfTheTable) {
    const PackedScene &packed = reference::sceneOfAllMaterials();
    const reference::SceneView<float> scene(packed);
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        const float cosine = draw.chance(16) ? 1.0f : draw.unit();
        const float roughness = draw.chance(16) ? 1.0f : draw.unit();
        const vec3 colour = drawColour(draw);
        const float index = draw.chance(16) ? 10.0f : 1.0f + (draw.chance(2) ? 1.5f : 9.0f) * draw.unit();
        const float eta = draw.chance(2) ? index : 1.0f / index;
        const auto energy = reference::energyOf(scene, cosine, roughness);
        const auto average = reference::averageEnergy(scene, roughness);
        input << cosine << roughness << colour << eta;
        expected << energy.white << energy.grazing << average.white << average.grazing
                 << reference::energyAt(energy, colour.x, colour.y)
                 << reference::multiScatterReflectance(colour, average.white)
                 << reference::glassEnergy(scene, cosine, roughness, eta);
    };
    expectTwin(probeEnergy, call, {.lookups = packed.lookups});
}

TEST(BsdfTwin, DrawnAndEvaluated) {
    PackedScene packed = reference::sceneOfAllMaterials();
    packed.scattering &= ~layout::scattersAtSheen;
    const reference::SceneView<float> scene(packed);
    const auto call = [&](Draw &draw, Words &input, Words &expected) {
        layout::MaterialRecord material{};
        constexpr std::array<std::uint32_t, 6> kinds{
            layout::materialDiffuse,   layout::materialDielectric,
            layout::materialConductor, layout::materialPrincipled,
            layout::materialGltf,      layout::materialGltf | layout::materialIsThin};
        material.kindAndSides = kinds[draw.index(6)];
        material.albedo = drawColour(draw);
        material.conductorIndex = drawColour(draw) * 2.0f;
        material.conductorExtinction = drawColour(draw) * 5.0f + vec3(0.01f);
        material.averageReflectance = drawColour(draw);
        material.alpha = drawAlpha(draw);
        material.metallic = draw.chance(3) ? 0.0f : draw.unit();
        material.transmission = draw.chance(2) ? 0.0f : draw.unit();
        material.normalReflectance = 0.08f * draw.unit();
        material.clearcoat = material.transmission > 0.0f || draw.chance(2) ? 0.0f : draw.unit();
        material.clearcoatAlpha = drawAlpha(draw);
        material.dielectricColour = drawColour(draw) * (draw.chance(4) ? 20.0f : 1.0f);
        material.dielectricWeight = draw.chance(3) ? 1.0f : draw.unit();
        material.anisotropy = draw.chance(3) ? 0.0f : draw.unit();
        material.anisotropyCosine = 0.6f;
        material.anisotropySine = -0.8f;
        const vec3 geometricNormal = draw.direction();
        const vec3 normal = draw.chance(2) ? geometricNormal : draw.direction();
        vec3 direction = draw.direction();
        if (reference::dotProduct(direction, geometricNormal) > 0.0f)
            direction = -direction;
        reference::SurfaceAxes<float> axes{draw.chance(8) ? vec3(0.0f) : draw.direction(), normal};
        if (reference::dotProduct(direction, axes.coatNormal) > 0.0f)
            axes.coatNormal = geometricNormal;
        const bool isBehind = draw.chance(4);
        const float eta = draw.chance(2) ? 0.4f + 0.5f * draw.unit() : 1.1f + draw.unit();
        const vec2 choice = unitPair(draw);
        const vec2 u = unitPair(draw);
        const vec3 light = draw.chance(4) ? -drawAbove(draw) : drawAbove(draw);
        input << material.kindAndSides << material.albedo << material.conductorIndex
              << material.conductorExtinction << material.averageReflectance << material.alpha
              << material.metallic << material.transmission << material.normalReflectance
              << material.clearcoat << material.clearcoatAlpha << material.dielectricColour
              << material.dielectricWeight << material.anisotropy << material.anisotropyCosine
              << material.anisotropySine << direction << normal << geometricNormal << axes.tangent
              << axes.coatNormal << static_cast<std::uint32_t>(isBehind) << eta << choice << u << light;
        const auto rough = reference::makeBsdf<float>(scene, material, direction, normal, geometricNormal,
                                                      axes, isBehind, eta, choice.x);
        const vec3 drawn = reference::sampleBsdf(scene, rough, u, choice.y);
        const auto scattered = reference::evalBsdf(scene, rough, drawn);
        const auto lit = reference::evalBsdf(scene, rough, light);
        expected << drawn << scattered.value << scattered.pdf << lit.value << lit.pdf;
    };
    expectTwin(probeBsdf, call, {.lookups = packed.lookups, .scattering = packed.scattering});
}

// ---- Functions that read nothing beside their parameters

struct LeafTwin {
    const char *name;
    std::uint32_t function; ///< of the probe kernel
    TwinCall call;
};

void PrintTo(const LeafTwin &twin, std::ostream *stream) { *stream << twin.name; }

class LeafTwins : public ::testing::TestWithParam<LeafTwin> {};

TEST_P(LeafTwins, HaveTheSameBits) { expectTwin(GetParam().function, GetParam().call); }

const LeafTwin leafTwins[] = {
    {"VectorDotProduct", probeDotProduct,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 a = draw.point();
         const vec3 b = draw.point();
         input << a << b;
         expected << reference::dotProduct(a, b);
     }},
    {"VectorCrossProduct", probeCrossProduct,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 a = draw.point();
         const vec3 b = draw.chance(16) ? a * 3.0f : draw.point();
         input << a << b;
         expected << reference::crossProduct(a, b);
     }},
    {"VectorVectorLength", probeVectorLength,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 v = draw.point();
         input << v;
         expected << reference::vectorLength(v);
     }},
    {"VectorUnitVector", probeUnitVector,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 v = draw.point();
         input << v;
         expected << reference::unitVector(v);
     }},
    {"VectorMirrorDirection", probeMirrorDirection,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 direction = draw.direction();
         const vec3 normal = draw.chance(16) ? -direction : draw.direction();
         input << direction << normal;
         expected << reference::mirrorDirection(direction, normal);
     }},
    {"VectorLargestComponent", probeLargestComponent,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 v = pointWithoutNegativeZero(draw);
         input << v;
         expected << reference::largestComponent(v);
     }},
    {"VectorSmallestComponent", probeSmallestComponent,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 v = pointWithoutNegativeZero(draw);
         input << v;
         expected << reference::smallestComponent(v);
     }},
    {"RandomHashKeys", probeHashKeys,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t x = draw.word();
         const std::uint32_t y = draw.word();
         const uvec3 keys(x, y, draw.word());
         input << keys;
         expected << reference::hashKeys(keys);
     }},
    {"RandomOwenScramble", probeOwenScramble,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t x = draw.word();
         const std::uint32_t key = draw.word();
         input << x << key;
         expected << reference::owenScramble(x, key);
     }},
    {"RandomSecondSobolCoordinate", probeSecondSobolCoordinate,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t x = draw.word();
         input << x;
         expected << reference::secondSobolCoordinate(x);
     }},
    {"RandomUnitFloat", probeUnitFloat,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t x = draw.word();
         input << x;
         expected << reference::unitFloat<float>(x);
     }},
    {"BoxMakeBoxRay", probeMakeBoxRay,
     [](Draw &draw, Words &input, Words &expected) {
         const Box bounds = drawBox(draw);
         const vec3 origin = drawOrigin(draw, bounds);
         const vec3 direction = draw.direction();
         input << origin << direction << bounds.lower << bounds.upper;
         const reference::BoxRay<float> ray =
             reference::makeBoxRay(origin, direction, bounds.lower, bounds.upper);
         expected << ray.inverse << ray.origin << ray.pad;
     }},
    {"BoxBoxInterval", probeBoxInterval,
     [](Draw &draw, Words &input, Words &expected) {
         const Box box = drawBox(draw);
         const vec3 origin = drawOrigin(draw, box);
         const vec3 direction = draw.direction();
         const vec3 lower = box.lower - vec3(1.0f);
         const vec3 upper = box.upper + vec3(1.0f);
         input << origin << direction << lower << upper << box.lower << box.upper;
         const vec2 interval =
             boxInterval(reference::makeBoxRay(origin, direction, lower, upper), box.lower, box.upper);
         expected << interval.x << interval.y;
     }},
    {"InstancePlacedBoxInterval", probePlacedBoxInterval,
     [](Draw &draw, Words &input, Words &expected) {
         const Box box = drawBox(draw);
         const vec3 origin = drawOrigin(draw, box);
         const vec3 direction = draw.direction();
         const vec3 lower = box.lower - vec3(1.0f);
         const vec3 upper = box.upper + vec3(1.0f);
         input << origin << direction << lower << upper;
         const layout::InstanceRecord instance = drawInstance(draw, input);
         const vec3 middle = 0.5f * (box.lower + box.upper);
         const vec3 extent = 0.5f * (box.upper - box.lower);
         input << middle << extent;
         const auto placed = reference::makePlacedBoxRay<float>(
             reference::makeBoxRay(origin, direction, lower, upper), instance);
         const vec2 interval = reference::placedBoxInterval(placed, middle, extent);
         expected << interval.x << interval.y;
     }},
    {"InstancePlacedPoint", probePlacedPoint,
     [](Draw &draw, Words &input, Words &expected) {
         const layout::InstanceRecord instance = drawInstance(draw, input);
         const vec3 point = draw.point();
         input << point;
         expected << reference::placedPoint<float>(instance, point);
     }},
    {"InstancePlacedNormal", probePlacedNormal,
     [](Draw &draw, Words &input, Words &expected) {
         const layout::InstanceRecord instance = drawInstance(draw, input);
         const vec3 normal = draw.chance(8) ? vec3(0.0f) : draw.direction();
         input << normal;
         expected << reference::placedNormal<float>(instance, normal);
     }},
    {"TriangleMakeTriangleRay", probeMakeTriangleRay,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 origin = draw.point();
         const vec3 direction = draw.direction();
         input << origin << direction;
         const reference::TriangleRay<float> ray = reference::makeTriangleRay(origin, direction);
         expected << ray.origin << static_cast<std::uint32_t>(ray.axis) << ray.shear;
     }},
    {"TriangleTrianglePoint", probeTrianglePoint,
     [](Draw &draw, Words &input, Words &expected) {
         const Triangle triangle = drawTriangle(draw);
         const vec2 uv(draw.unit(), draw.unit());
         input << triangle.v0 << triangle.v1 << triangle.v2 << uv;
         expected << reference::trianglePoint(triangle.v0, triangle.v1, triangle.v2, uv.x, uv.y);
     }},
    {"TriangleTrianglePointError", probeTrianglePointError,
     [](Draw &draw, Words &input, Words &expected) {
         const Triangle triangle = drawTriangle(draw);
         const vec2 uv(draw.unit(), draw.unit());
         input << triangle.v0 << triangle.v1 << triangle.v2 << uv;
         expected << reference::trianglePointError(triangle.v0, triangle.v1, triangle.v2, uv.x, uv.y);
     }},
    {"SurfaceSphereSurface", probeSphereSurface,
     [](Draw &draw, Words &input, Words &expected) {
         layout::SphereRecord sphere{};
         sphere.centre = draw.point();
         sphere.materialAndSide = draw.chance(2) ? layout::sphereFacesInward : 0u;
         const vec3 origin = draw.point();
         const vec3 direction = draw.direction();
         const float distance = std::abs(draw.coordinate());
         input << origin << direction << distance << sphere.centre << sphere.materialAndSide;
         expected << reference::sphereSurface<float>(origin, direction, distance, sphere);
     }},
    {"SurfaceTriangleSurface", probeTriangleSurface,
     [](Draw &draw, Words &input, Words &expected) {
         const Triangle drawn = drawTriangle(draw);
         layout::TriangleRecord triangle{};
         triangle.v0 = drawn.v0;
         triangle.v1 = drawn.v1;
         triangle.v2 = drawn.v2;
         layout::NormalRecord normals{};
         if (!draw.chance(4)) {
             normals.n0 = draw.direction();
             normals.n1 = draw.chance(8) ? normals.n0 : draw.direction();
             normals.n2 = draw.chance(8) ? -normals.n0 : draw.direction();
         }
         const vec2 uv(draw.unit(), draw.unit());
         input << triangle.v0 << triangle.v1 << triangle.v2 << normals.n0 << normals.n1 << normals.n2 << uv;
         expected << reference::triangleSurface<float>(triangle, normals, uv.x, uv.y);
     }},
    {"SurfaceOffsetRayOrigin", probeOffsetRayOrigin,
     [](Draw &draw, Words &input, Words &expected) {
         reference::Surface<float> surface{};
         surface.position = draw.point();
         surface.error = draw.chance(4) ? vec3(0.0f) : glm::abs(surface.position) * 0x1p-21f;
         surface.geometricNormal = draw.direction();
         const vec3 direction = draw.chance(8) ? -surface.geometricNormal : draw.direction();
         input << surface.position << surface.error << surface.geometricNormal << direction;
         expected << reference::offsetRayOrigin(surface, direction);
     }},
    {"RandomSampleBits", probeSampleBits,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t x = draw.index(32768);
         const uvec2 pixel(x, draw.index(32768));
         const std::uint32_t seed = draw.word();
         const std::uint32_t pair = draw.index(100);
         const std::uint32_t sample = draw.index(65536);
         input << pixel << seed << pair << sample;
         expected << reference::sampleBits(reference::pairKeys(pixel, seed, pair), sample);
     }},
    {"FunctionSineCosine", probeSineCosine,
     [](Draw &draw, Words &input, Words &expected) {
         const float turns = draw.chance(8) ? static_cast<float>(draw.index(17)) / 16.0f : draw.unit();
         const auto angle = reference::sineCosine(turns);
         input << turns;
         expected << angle.sine << angle.cosine;
     }},
    {"FunctionExpNegative", probeExpNegative,
     [](Draw &draw, Words &input, Words &expected) {
         const float x = draw.chance(4) ? std::abs(draw.coordinate()) : draw.unit() * 90.0f;
         input << x;
         expected << reference::expNegative(x);
     }},
    {"SamplingSampleCosine", probeSampleCosine,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 normal = draw.direction();
         const vec2 u = unitPair(draw);
         const vec3 direction = reference::sampleCosine(normal, u);
         input << normal << u;
         expected << direction << reference::pdfCosine(direction.z);
     }},
    {"SamplingSampleTriangle", probeSampleTriangle,
     [](Draw &draw, Words &input, Words &expected) {
         const vec2 u = unitPair(draw);
         input << u;
         expected << reference::sampleTriangle(u);
     }},
    {"SamplingSampleCone", probeSampleCone,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 axis = draw.direction();
         const float squaredDistance = 0.001f + draw.unit() * 1000.0f;
         const float squaredRadius = squaredDistance * draw.unit();
         const vec2 u = unitPair(draw);
         const float height = reference::coneHeight(squaredRadius, squaredDistance);
         input << axis << squaredRadius << squaredDistance << u;
         expected << height << reference::sampleCone(axis, height, u) << reference::pdfCone(height);
     }},
    {"SamplingSampleSphere", probeSampleSphere,
     [](Draw &draw, Words &input, Words &expected) {
         const vec2 u = unitPair(draw);
         input << u;
         expected << reference::sampleSphere(u);
     }},
    {"SamplingPowerHeuristic", probePowerHeuristic,
     [](Draw &draw, Words &input, Words &expected) {
         const float a = std::abs(draw.coordinate()) + 1e-6f;
         const float b = draw.chance(8) ? 0.0f : std::abs(draw.coordinate());
         input << a << b;
         expected << reference::powerHeuristic(a, b);
     }},
    {"DielectricFresnelDielectric", probeFresnelDielectric,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 normal = draw.direction();
         vec3 direction = draw.direction();
         if (glm::dot(direction, normal) > 0.0f)
             direction = -direction;
         const float eta = draw.chance(2) ? 0.1f + draw.unit() : 1.0f + draw.unit() * 2.0f;
         const auto glass = reference::fresnelDielectric(direction, normal, eta);
         input << direction << normal << eta;
         expected << glass.refracted << glass.reflectance;
     }},
    {"MediaCountsAndPriorities", probeMedia,
     [](Draw &draw, Words &input, Words &expected) {
         const std::uint32_t inside = draw.word();
         const std::uint32_t material = draw.index(layout::maxMedia);
         input << inside << material;
         expected << reference::mediumAround(inside) << reference::mediumCount(inside, material)
                  << reference::enterMedium(inside, material) << reference::leaveMedium(inside, material);
     }},
    {"FunctionAtan2Turns", probeAtan2Turns,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 direction = draw.direction();
         const float y = draw.chance(2) ? direction.y : draw.coordinate();
         const float x = direction.x == 0.0f && y == 0.0f ? 1.0f : direction.x;
         input << y << x;
         expected << reference::atan2Turns(y, x);
     }},
    {"LightSpotFalloff", probeSpotFalloff,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 axis = draw.direction();
         const vec3 toSpot = draw.chance(4) ? -axis : draw.direction();
         const float cosineOuter = draw.unit() * 2.0f - 1.0f;
         const float scale = (draw.chance(2) ? -1.0f : 1.0f) / (draw.unit() + 1e-6f);
         input << toSpot << axis << cosineOuter << scale;
         expected << reference::spotFalloff(toSpot, axis, cosineOuter, scale);
     }},
    {"TextureTriangleUv", probeTriangleUv,
     [](Draw &draw, Words &input, Words &expected) {
         const reference::Coordinates<float> at{vec2(draw.point()), vec2(draw.point()), vec2(draw.point())};
         const float u = draw.unit();
         const float v = draw.unit();
         input << at.uv0 << at.uv1 << at.uv2 << u << v;
         expected << reference::triangleUv(at, u, v);
     }},
    {"TextureSphereUv", probeSphereUv,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 outward = draw.direction() * (draw.chance(2) ? 1.0f : 700.0f);
         input << outward;
         expected << reference::sphereUv(outward);
     }},
    {"NormalMapVisibleNormal", probeVisibleNormal,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 direction = draw.direction();
         const vec3 normal = draw.chance(16) ? direction : draw.direction();
         const vec3 up = draw.chance(4) ? normal : draw.direction();
         input << direction << normal << up;
         expected << reference::visibleNormal(direction, normal, up);
     }},
    {"ConductorReflectance", probeConductorReflectance,
     [](Draw &draw, Words &input, Words &expected) {
         const float cosine = draw.chance(16) ? 1.0f : draw.unit();
         const vec3 index = drawColour(draw) * 5.0f;
         const vec3 extinction = drawColour(draw) * 9.0f + vec3(0.01f);
         input << cosine << index << extinction;
         expected << reference::conductorReflectance(cosine, index, extinction)
                  << reference::schlickReflectance(cosine, index, index.y);
     }},
    {"MicrofacetReflecting", probeFacets,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 view = drawAbove(draw);
         const float alpha = drawAlpha(draw);
         const vec2 u = unitPair(draw);
         const vec3 light = drawAbove(draw);
         const float stretchView = reference::stretchOf(view, alpha);
         const vec3 facet = reference::sampleGgxVndf(view, alpha, u);
         const float pdf = reference::ggxD(facet, alpha);
         input << view << alpha << u << light;
         expected << stretchView << facet << pdf << reference::pdfReflection(pdf, view, stretchView)
                  << reference::smithG2OverG1(view.z, stretchView, light.z,
                                              reference::stretchOf(light, alpha))
                  << reference::halfVector(view, light);
     }},
    {"MicrofacetRefracting", probeFacetsAcross,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 view = drawAbove(draw);
         const vec3 light = -drawAbove(draw);
         const float alpha = drawAlpha(draw);
         const float eta = draw.chance(2) ? 0.4f + 0.5f * draw.unit() : 1.1f + draw.unit();
         const vec3 facet = reference::halfVectorOfRefraction(view, light, eta);
         input << view << light << alpha << eta;
         expected << facet
                  << reference::pdfRefraction(
                         reference::ggxD(facet, alpha), view, reference::stretchOf(view, alpha),
                         reference::dotProduct(view, facet), reference::dotProduct(light, facet), eta);
     }},
    {"EmitterSolidAngleDensity", probeSolidAnglePdf,
     [](Draw &draw, Words &input, Words &expected) {
         const float areaPdf = draw.unit();
         const float distance = std::abs(draw.coordinate());
         const float cosine = draw.unit() + 0x1p-24f;
         input << areaPdf << distance << cosine;
         expected << reference::solidAnglePdf(areaPdf, distance, cosine);
     }},
    {"EmitterSphereLightDensity", probePdfSphereLight,
     [](Draw &draw, Words &input, Words &expected) {
         const vec3 position = draw.point();
         const vec3 direction = draw.direction();
         const float distance = std::abs(draw.coordinate());
         const vec3 centre = draw.point();
         const float radius = draw.unit() * 10.0f + 0.001f;
         const vec3 outward = draw.direction();
         const float areaPdf = draw.unit();
         input << position << direction << distance << centre << radius << outward << areaPdf;
         expected << reference::pdfSphereLight(position, direction, distance, centre, radius, outward,
                                               areaPdf);
     }},
};

INSTANTIATE_TEST_SUITE_P(All, LeafTwins, ::testing::ValuesIn(leafTwins),
                         [](const auto &instance) { return std::string(instance.param.name); });

} // namespace
} // namespace hyalite::core::testing
