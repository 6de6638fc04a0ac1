#include "tests/kernels/leaf_inputs.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>

namespace hyalite::core::testing {

using namespace leaves;
using glm::vec2;
using glm::vec3;
using glm::vec4;

namespace {

#include "leaf_words.h"

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Mostly a coordinate, sometimes so large or so small that squares leave the range of floats.
float number(Draw &draw) {
    if (!draw.chance(24))
        return draw.coordinate();
    const int exponent = 20 + static_cast<int>(draw.index(90));
    return std::ldexp(draw.chance(2) ? -1.0f - draw.unit() : 1.0f + draw.unit(),
                      draw.chance(2) ? exponent : -exponent);
}

/// Also infinities and NaN.
float anyNumber(Draw &draw) {
    constexpr std::array special{infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 0.0f, -0.0f};
    return draw.chance(12) ? special[draw.index(special.size())] : number(draw);
}

float positive(Draw &draw) { return std::abs(number(draw)); }

/// In [0, 1].
float share(Draw &draw) { return draw.chance(8) ? static_cast<float>(draw.index(3)) * 0.5f : draw.unit(); }

/// In [0, 1).
float random(Draw &draw) { return draw.chance(32) ? 0.0f : draw.chance(32) ? 1.0f - 0x1p-24f : draw.unit(); }

vec2 randomPair(Draw &draw) {
    const float x = random(draw);
    return {x, random(draw)};
}

vec3 colour(Draw &draw) {
    const float red = share(draw);
    const float green = share(draw);
    return {red, green, share(draw)};
}

vec3 vectorOf(float (*component)(Draw &), Draw &draw) {
    const float x = component(draw);
    const float y = draw.chance(12) ? x : component(draw); // ties
    return {x, y, draw.chance(12) ? y : component(draw)};
}

float alpha(Draw &draw) { return draw.chance(8) ? 0.0016f : 0.002f + 0.998f * draw.unit(); }

float refractiveIndex(Draw &draw) {
    return draw.chance(16) ? 10.0f : 1.01f + (draw.chance(2) ? 1.5f : 8.9f) * draw.unit();
}

/// Above the plane, and not so low that float32 has nothing to say.
vec3 above(Draw &draw) {
    vec3 v = draw.direction();
    v.z = std::abs(v.z) + 0.001f;
    return unitVector(v);
}

float textureCoordinate(Draw &draw) {
    constexpr std::array special{0.0f, 1.0f, -1.0f, 0.5f, 3e38f, -3e38f, -1e-8f, 0.99999994f};
    return draw.chance(12)  ? special[draw.index(special.size())]
           : draw.chance(4) ? anyNumber(draw) * 1000.0f
                            : draw.unit();
}

uint lengthOf(const auto &array) { return static_cast<uint>(array.size()); }

/// Of unit length except for rounding, and not on the side of `direction`.
vec3 against(const vec3 &direction, Draw &draw) {
    const vec3 v = draw.chance(16) ? -direction : draw.direction();
    return dotProduct(v, direction) > 0.0f ? -v : v;
}

} // namespace

/// What the parameters of one call have to do with each other: a ray, what it is aimed at, and the texture of a lookup.
struct Situation {
    explicit Situation(const LeafScene &leafScene) : scene(leafScene.view), packed(leafScene.view.packed) {
        for (const layout::MaterialRecord &material : packed.materials)
            for (uint slot = 0; material.textures != 0 && slot < layout::textureSlotCount; ++slot)
                if (hasTexture<float>(scene, material.textures, slot))
                    textureRows.push_back(textureRow(material.textures, slot));
        for (uint i = 0; i < packed.emitters.size(); ++i)
            if (packed.emitters[i].kind == layout::emitterSphere)
                sphereEmitters.push_back(i);
            else if (packed.emitters[i].kind == layout::emitterTriangle)
                triangleEmitters.push_back(i);
            else if (packed.emitters[i].kind == layout::emitterProfiled)
                profiledEmitters.push_back(i);
    }

    const auto &some(const auto &array) { return array[draw.index(lengthOf(array))]; }
    uint indexIn(const auto &array) { return draw.index(lengthOf(array)); }

    void begin() {
        v0 = draw.point();
        v1 = draw.point();
        v2 = draw.point();
        apex = draw.point();
        if (draw.chance(16))
            v2 = draw.chance(2) ? v1 : 0.5f * (v0 + v1); // without area
        const vec3 target = drawTarget();
        radius = draw.chance(8) ? 940.0f : 0.01f + 10.0f * draw.unit();
        centre = draw.chance(2) ? draw.point() : target + (radius * draw.unit()) * draw.direction();
        origin = draw.point();
        if (draw.chance(8)) // grazing
            origin = centre + radius * draw.direction();
        direction =
            draw.chance(8) ? draw.direction() : draw.towards(origin, draw.chance(4) ? centre : target);
        if (draw.chance(8)) { // along an axis, so that edge functions are exactly 0
            const int axis = static_cast<int>(draw.index(3));
            direction = vec3(draw.chance(2) ? -0.0f : 0.0f);
            direction[axis] = draw.chance(2) ? -1.0f : 1.0f;
            origin = target - direction * draw.coordinate();
        }
        lower = glm::min(glm::min(v0, v1), glm::min(v2, apex));
        upper = glm::max(glm::max(v0, v1), glm::max(v2, apex));
        texture = some(textureRows);
        lamp = some(sphereEmitters);
    }

    /// A point of the plane of the triangle, or of the one beside it, often on an edge or a vertex.
    vec3 drawTarget() {
        const vec3 &last = draw.chance(4) ? apex : v2;
        switch (draw.index(4)) {
        case 0:
            return v1;
        case 1:
            return 0.5f * (v0 + last);
        default:
            const float u = draw.unit();
            return trianglePoint(v0, v1, last, u, draw.unit() * (draw.chance(2) ? 1.0f - u : 1.0f));
        }
    }

    uint textureWidth() { return textureWords<float>(scene, texture).y & 0xFFFFu; }
    uint textureHeight() { return textureWords<float>(scene, texture).y >> 16u; }

    /// The first interval of gamma of the first light with a profile.
    uint gammaRow() {
        const uint first = packed.frame.lightProfiles;
        return first + packed.lookups[first].word + 1;
    }
    uint gammaCount() { return packed.lookups[gammaRow() - 1].word & 0xFFFFu; }

    vec4 tangent() { return {draw.direction(), draw.chance(8) ? 0.0f : draw.chance(2) ? -1.0f : 1.0f}; }

    BoxRay<float> boxRay() { return makeBoxRay(origin, direction, lower, upper); }

    Hit<float> hit() {
        Hit<float> made{};
        made.distance = std::abs(draw.coordinate());
        made.primitive = draw.index(layout::minFirstTriangleId);
        if (draw.chance(2))
            made.primitive = packed.frame.firstTriangleId + draw.index(200);
        made.record =
            isTriangle<float>(scene, made.primitive) ? indexIn(packed.triangles) : indexIn(packed.spheres);
        made.u = draw.unit();
        made.v = draw.unit() * (1.0f - made.u);
        made.instance = draw.chance(2) ? indexIn(packed.instances) : layout::noInstance;
        return made;
    }

    Bsdf<float> bsdf() {
        MaterialRecord<float> made(some(packed.materials));
        made.clearcoat = draw.chance(2) ? 0.0f : made.clearcoat;
        const vec3 normal = draw.direction();
        const vec3 along = -against(-normal, draw);
        const SurfaceAxes<float> axes{draw.direction(), normal};
        return makeBsdf<float>(scene, made, along, normal, normal, axes, draw.chance(4),
                               draw.chance(2) ? 0.4f + 0.5f * draw.unit() : 1.1f + draw.unit(), draw.unit());
    }

    MaterialRecord<float> texturedMaterial() {
        for (;;)
            if (const layout::MaterialRecord &one = some(packed.materials); one.textures != 0)
                return one;
    }

    /// Often where the ray begins, or in the lamp.
    vec3 position() {
        const layout::SphereRecord &sphere = packed.spheres[packed.emitters[lamp].record];
        return draw.chance(2)   ? origin
               : draw.chance(2) ? sphere.centre + sphere.radius * draw.unit() * draw.direction()
                                : draw.point();
    }

    Draw draw;
    const SceneView<float> &scene;
    const PackedScene &packed;
    std::vector<uint> textureRows, sphereEmitters, triangleEmitters, profiledEmitters;

    vec3 v0{}, v1{}, v2{}, apex{}; ///< two triangles with a common edge
    vec3 centre{};
    float radius = 0.0f;
    vec3 origin{}, direction{};
    vec3 lower{}, upper{}; ///< of the triangles
    uint texture = 0;      ///< row of its TextureRecord
    uint lamp = 0;         ///< index of the emitter of a sphere
};

namespace {

using Row = std::function<void(Situation &, Words &)>;

struct InputRow {
    /// Several with commas between them: "TYPE LEAF.PARAMETER", also with fields after it, "TYPE STRUCT.FIELD",
    /// "TYPE NAME" of any parameter or field, or "TYPE". The first of these that there is counts.
    const char *names;
    Row row;
};

using S = Situation;

Row by(auto make) {
    return [make](S &s, Words &words) {
        if constexpr (std::is_invocable_v<decltype(make), S &>)
            words << make(s);
        else
            words << make(s.draw);
    };
}

const std::vector<InputRow> inputRows{
    // Numbers.
    {"float", by(number)},
    {"vec2", by([](S &s) { return vec2(vectorOf(number, s.draw)); })},
    {"vec3", by([](S &s) { return vectorOf(number, s.draw); })},
    {"vec4", by([](S &s) { return s.tangent(); })},
    {"float a, float b, float fractionOf.x, float wrapped.x, float withoutSubnormals.x, float withoutTiny.x, "
     "float withLargest.x",
     by(anyNumber)},
    {"vec3 a, vec3 b, vec3 withoutSubnormals.v, vec3 withoutTiny.v, vec3 largestComponent.v, "
     "vec3 smallestComponent.v, vec3 largest",
     by([](S &s) { return vectorOf(anyNumber, s.draw); })},
    {"float distance, float squaredDistance, float squaredRadius, float expNegative.x, float roughInverse.x, "
     "float neighbour, float own, float variance, float luminance, float sum, float squares, float pad",
     by(positive)},
    {"vec3 variance, vec3 varianceA, vec3 varianceB, vec3 expNegative.x",
     by([](S &s) { return vectorOf(positive, s.draw); })},
    {"float u, float v, float choice, float chance", by(random)},
    {"vec2 u, vec2 weights, vec2 offset", by(randomPair)},
    {"float share, float across, float along, float above, float height, float cosine, float viewCosine, "
     "float facetCosine, float lightCosine, float viewHeight, float lightHeight, float stretchWo, "
     "float stretchLight, float sine, float sineA, float sineB, float sineNormals, float roughness, "
     "float metal, float metallic, float plastic, float transmission, float clearcoat, float opacity, "
     "float alphaCutoff, float clearcoatNormalStrength, float dielectricWeight, float normalReflectance, "
     "float anisotropy, float white, float grazing, float normal, float power, float energy, float average, "
     "float factor, float diffuseTransmission, float pdf, float areaPdf, float probability, "
     "float emitterPdf",
     by(share)},
    {"float energyPlace.position",
     by([](S &s) { return s.draw.chance(2) ? share(s.draw) : anyNumber(s.draw); })},
    {"vec2 place", by([](S &s) {
         return vec2{share(s.draw), share(s.draw)};
     })},
    {"float cosineA, float cosineB, float cosineOuter, float cosineNormals, float cosineEmission, "
     "float anisotropyCosine, float anisotropySine",
     by([](S &s) { return 2.0f * share(s.draw) - 1.0f; })},
    {"float sineCosine.turns",
     by([](S &s) { return (s.draw.chance(2) ? 16.0f : 1.0f) * share(s.draw) - 8.0f; })},
    {"float exponential.x", by([](S &s) { return 172.0f * share(s.draw) - 86.0f; })},
    {"float negativeLog.x", by([](S &s) { return lesser(positive(s.draw), s.draw.unit() + 0x1p-24f); })},
    {"float alpha, float clearcoatAlpha, float sheenAlpha", by(alpha)},
    {"vec2 alphas", by([](S &s) {
         return vec2{alpha(s.draw), alpha(s.draw)};
     })},
    {"float wavelength", by([](S &s) { return 0.35f + 0.4f * s.draw.unit(); })},
    {"float centre", by([](S &s) { return 0.4f + 0.25f * s.draw.unit(); })},
    {"float reach", by([](S &s) { return 0.02f + 0.06f * s.draw.unit(); })},
    {"float bend", by([](S &s) { return 5.0f * s.draw.unit() - 1.0f; })},
    {"float dispersion", by([](S &s) { return s.draw.chance(2) ? 0.0f : 0.2f * s.draw.unit(); })},
    {"float eta",
     by([](S &s) { return s.draw.chance(2) ? 1.0f / refractiveIndex(s.draw) : refractiveIndex(s.draw); })},
    {"float index, float refractiveIndex", by(refractiveIndex)},
    {"float iridescence, float film", by([](S &s) { return 0.8f * share(s.draw); })},
    {"float bare", by([](S &s) { return 2.0f * share(s.draw) - 1.0f; })},
    {"float iridescenceIndex", by([](S &s) { return 1.0f + 2.0f * share(s.draw); })},
    {"float iridescenceThickness, float iridescenceThicknessMinimum",
     by([](S &s) { return 1500.0f * share(s.draw); })},
    {"float waveCosine.turns", by([](S &s) { return 1000.0f * share(s.draw) * share(s.draw); })},
    {"vec3 amplitude", by([](S &s) { return 2.0f * colour(s.draw) - 1.0f; })},
    {"vec4 colourOfWaves.waves",
     by([](S &s) { return vec4(s.draw.direction(), 2.0f * share(s.draw) - 1.0f); })},
    {"uint gaussNode.i", by([](S &s) { return s.draw.index(4); })},
    {"float falloffScale",
     by([](S &s) { return (s.draw.chance(2) ? -1.0f : 1.0f) / (s.draw.unit() + 1e-6f); })},
    {"vec3 colour, vec3 texel, vec3 average, vec3 metalAverage, vec3 albedo, vec3 segmentTint, "
     "vec3 averageReflectance, vec3 dielectricColour, vec3 sheenColour, vec3 dielectric, vec3 reflectance, "
     "vec3 diffuseTransmissionColour, vec3 colourBeyond, "
     "vec3 schlickReflectance.normal, "
     "vec3 LookupRow.value",
     by(colour)},
    {"vec3 emission, vec3 index, vec3 extinction, vec3 conductorIndex, vec3 conductorExtinction, vec3 "
     "estimate, "
     "vec3 first, vec3 second, vec3 diffuseShare.value",
     by([](S &s) { return 5.0f * colour(s.draw); })},

    // Words.
    {"uint", by([](S &s) { return s.draw.word(); })},
    {"uvec2", by([](S &s) {
         return uvec2{s.draw.word(), s.draw.word()};
     })},
    {"uvec3", by([](S &s) {
         return uvec3{s.draw.word(), s.draw.word(), s.draw.word()};
     })},
    {"uvec4", by([](S &s) {
         return uvec4{s.draw.word(), s.draw.word(), s.draw.word(), s.draw.word()};
     })},
    {"bool", by([](S &s) { return s.draw.chance(2); })},
    {"uint axis, uint corner, uint firstCorner, uint secondCorner, uint wrap",
     by([](S &s) { return s.draw.index(3); })},
    {"uint kind", by([](S &s) { return s.draw.index(layout::emitterProfiled + 1); })},
    {"uint kindAndSides", by([](S &s) {
         return s.draw.index(layout::materialGltf + 1) | (s.draw.word() & ~layout::materialKindMask);
     })},
    {"uint view", by([](S &s) { return s.draw.index(layout::viewPlace + 2); })},
    {"uint material", by([](S &s) { return s.draw.index(layout::maxMedia); })},
    {"uint nodeCount", by([](S &s) { return 2 + s.draw.index(layout::energyCosines); })},
    {"uvec2 pixel", by([](S &s) {
         return uvec2{s.draw.index(s.packed.frame.imageWidth), s.draw.index(s.packed.frame.imageHeight)};
     })},
    {"uvec2 size", by([](S &s) {
         return uvec2{1 + s.draw.index(5000), 1 + s.draw.index(5000)};
     })},

    // Vectors of unit length.
    {"vec3 normal, vec3 n, vec3 n0, vec3 n1, vec3 n2, vec3 d, vec3 outward, vec3 axis, vec3 toSpot, vec3 "
     "toViewer, "
     "vec3 coatNormal, vec3 offsetRayOrigin.direction, vec3 "
     "environmentPlace.direction, "
     "vec3 environmentFrom.direction",
     by([](S &s) { return s.draw.direction(); })},
    {"vec3 tangent, vec3 alongU, vec3 alongV, vec3 placedNormal.normal",
     by([](S &s) { return s.draw.chance(8) ? vec3(0.0f) : s.draw.direction(); })},
    {"vec3 m, vec3 w, vec3 wo, vec3 facet", by(above)},
    {"vec3 wi", by([](S &s) { return s.draw.chance(3) ? -above(s.draw) : above(s.draw); })},
    {"vec3 facing, vec3 geometricNormal", by([](S &s) { return against(s.direction, s.draw); })},
    {"Frame", by([](S &s) { return makeOrthonormalBasis(s.draw.direction()); })},

    // A ray, and what it is aimed at.
    {"vec3 direction", by([](S &s) { return s.direction; })},
    {"vec3 origin", by([](S &s) { return s.origin; })},
    {"vec3 position", by([](S &s) { return s.position(); })},
    {"vec3 v0, vec3 begin", by([](S &s) { return s.v0; })},
    {"vec3 v1, vec3 end", by([](S &s) { return s.v1; })},
    {"vec3 v2, vec3 firstApex", by([](S &s) { return s.v2; })},
    {"vec3 v3, vec3 secondApex", by([](S &s) { return s.apex; })},
    {"vec3 lower", by([](S &s) { return s.lower; })},
    {"vec3 upper", by([](S &s) { return s.upper; })},
    {"vec3 middle", by([](S &s) { return 0.5f * (s.lower + s.upper); })},
    {"vec3 extent", by([](S &s) { return 0.5f * (s.upper - s.lower); })},
    {"vec3 centre", by([](S &s) { return s.centre; })},
    {"float radius", by([](S &s) { return s.radius; })},
    {"vec3 edges", by([](S &s) {
         const vec3 edges = s.draw.point();
         return s.draw.chance(2) ? abs(edges) : s.draw.chance(2) ? -abs(edges) : edges;
     })},
    {"vec3 error, vec3 slack",
     by([](S &s) { return s.draw.chance(4) ? vec3(0.0f) : abs(s.draw.point()) * 0x1p-20f; })},
    {"vec3 toX, vec3 toY, vec3 toZ",
     by([](S &s) { return s.draw.direction() * (s.draw.chance(4) ? 0x1p-12f : 1.0f); })},
    {"BoxRay", by([](S &s) { return s.boxRay(); })},
    {"TriangleRay", by([](S &s) { return makeTriangleRay(s.origin, s.direction); })},
    {"PlacedBoxRay", by([](S &s) {
         return makePlacedBoxRay<float>(s.boxRay(), InstanceRecord<float>(s.some(s.packed.instances)));
     })},
    {"SphereShape", by([](S &s) { return makeSphereShape(s.centre, s.radius); })},

    // What the scene has.
    {"Hit", by([](S &s) { return s.hit(); })},
    {"uint primitive", by([](S &s) { return s.draw.chance(8) ? s.draw.word() : s.hit().primitive; })},
    {"uint triangleRecord, uint record", by([](S &s) { return s.indexIn(s.packed.triangles); })},
    {"uint materialIndex", by([](S &s) { return s.indexIn(s.packed.materials); })},
    {"uint materialAndSide", by([](S &s) {
         return s.indexIn(s.packed.materials) | (s.draw.chance(2) ? layout::sphereFacesInward : 0u);
     })},
    {"Bsdf", by([](S &s) { return s.bsdf(); })},
    {"SineCosine", by([](S &s) { return sineCosine(s.draw.unit()); })},
    {"Iridescence", by([](S &s) {
         const MaterialRecord<float> made(s.some(s.packed.materials));
         return s.draw.chance(2) ? filmOnGlass<float>(made, 0.5f + s.draw.unit(), s.draw.chance(2))
                                 : filmOnOpaque<float>(made, share(s.draw), colour(s.draw));
     })},
    {"DielectricFresnel",
     by([](S &s) { return fresnelDielectric<float>(-above(s.draw), above(s.draw), 0.5f + s.draw.unit()); })},
    {"SheenFit", by([](S &s) { return sheenFit(alpha(s.draw)); })},
    {"EmitterRecord sampleProfiled.emitter",
     by([](S &s) -> EmitterRecord<float> { return s.packed.emitters[s.some(s.profiledEmitters)]; })},
    {"uint profileShare.index", by([](S &s) { return s.draw.index(lengthOf(s.profiledEmitters)); })},
    {"vec3 profileShare.axis", by([](S &s) { return s.direction; })},
    {"vec3 profileShare.toLight", by([](S &s) {
         return s.draw.chance(2) ? s.draw.direction() : s.draw.chance(2) ? s.direction : -s.direction;
     })},
    {"uint profilePlace.first", by([](S &s) { return s.gammaRow(); })},
    {"uint profilePlace.count", by([](S &s) { return 1 + s.draw.index(s.gammaCount()); })},
    {"float profilePlace.turns", by([](S &s) { return (s.draw.chance(2) ? 0.5f : 1.0f) * share(s.draw); })},
    {"uint EmitterChoice.index",
     by([](S &s) { return s.draw.chance(4) ? s.lamp : s.indexIn(s.packed.emitters); })},
    {"uint pdfOfEmitter.index",
     by([](S &s) { return s.draw.chance(8) ? layout::noEmitter : s.indexIn(s.packed.emitters); })},
    {"EmitterRecord sampleSphereLight.emitter",
     by([](S &s) -> EmitterRecord<float> { return s.packed.emitters[s.lamp]; })},
    {"EmitterRecord sampleTriangleLight.emitter",
     by([](S &s) -> EmitterRecord<float> { return s.packed.emitters[s.some(s.triangleEmitters)]; })},
    {"uint splitLights.first", by([](S &s) { return s.draw.index(lengthOf(s.packed.lightNodes) / 2) * 2; })},

    // Lookups.
    {"vec2 uv0, vec2 uv1, vec2 uv2, vec2 first, vec2 second", by([](S &s) {
         return vec2{textureCoordinate(s.draw), textureCoordinate(s.draw)};
     })},
    {"uint parameter, uint other, uint mapSlot",
     by([](S &s) { return s.draw.index(layout::textureSlotCount); })},
    {"uint slots, uint textureSlots", by([](S &s) { return s.draw.chance(2) ? ~0u : s.draw.word(); })},
    {"uint textures", by([](S &s) { return s.some(s.packed.materials).textures; })},
    {"MaterialRecord texturedMaterial.material", by([](S &s) { return s.texturedMaterial(); })},
    {"uint row", by([](S &s) { return s.texture; })},
    {"uint textureWords.row, uint coordinatesAt.row, uint fetchTangent.row",
     by([](S &s) { return s.draw.index(lengthOf(s.packed.textures) - 1); })},
    {"uint textureWord.row, uint tableRow",
     by([](S &s) { return s.draw.chance(2) ? layout::srgbTableRow : layout::linearTableRow; })},
    {"uint textureWord.index, uint level", by([](S &s) { return s.draw.index(256); })},
    {"uvec4 description", by([](S &s) { return textureWords(s.scene, s.texture); })},
    {"uint textureTexel.x", by([](S &s) { return s.draw.index(s.textureWidth()); })},
    {"uint textureTexel.y", by([](S &s) { return s.draw.index(s.textureHeight()); })},
    {"float texelPair.x",
     by([](S &s) { return share(s.draw) * static_cast<float>(s.textureWidth()) + 0.5f; })},
    {"uint texelPair.size", by([](S &s) { return s.textureWidth(); })},
    {"uint environmentTexel.x", by([](S &s) { return s.draw.index(s.packed.frame.environmentWidth); })},
    {"uint environmentTexel.y, uint environmentRow.y",
     by([](S &s) { return s.draw.index(s.packed.frame.environmentHeight); })},
    {"uvec2 pdfEnvironment.pixel", by([](S &s) {
         return uvec2{s.draw.index(s.packed.frame.environmentWidth),
                      s.draw.index(s.packed.frame.environmentHeight)};
     })},
    {"uint searchTexels.first", by([](S &s) {
         return s.packed.frame.environmentTexels +
                s.draw.index(s.packed.frame.environmentHeight) * s.packed.frame.environmentWidth;
     })},
    {"uint searchTexels.count", by([](S &s) { return 1 + s.draw.index(s.packed.frame.environmentWidth); })},
};

/// Where the scene has records of a struct, half of them are its own.
const std::vector<InputRow> sceneRecords{
    {"SphereRecord", by([](S &s) -> SphereRecord<float> { return s.some(s.packed.spheres); })},
    {"TriangleRecord", by([](S &s) -> TriangleRecord<float> { return s.some(s.packed.triangles); })},
    {"NormalRecord", by([](S &s) -> NormalRecord<float> { return s.some(s.packed.normals); })},
    {"InstanceRecord", by([](S &s) -> InstanceRecord<float> { return s.some(s.packed.instances); })},
    {"MaterialRecord", by([](S &s) -> MaterialRecord<float> { return s.some(s.packed.materials); })},
    {"LookupRow", by([](S &s) -> LookupRow<float> { return s.some(s.packed.lookups); })},
    {"EmitterRecord", by([](S &s) -> EmitterRecord<float> { return s.some(s.packed.emitters); })},
    {"LightNode", by([](S &s) -> LightNode<float> { return s.some(s.packed.lightNodes); })},
};

struct NamedRow {
    Row row;
    bool isUsed = false;
};

std::map<std::string, NamedRow> namedRows(const std::vector<InputRow> &rows) {
    std::map<std::string, NamedRow> named;
    for (const InputRow &one : rows) {
        const std::string names = one.names;
        for (std::size_t at = 0; at < names.size();) {
            const std::size_t end = std::min(names.find(", ", at), names.size());
            if (!named.emplace(names.substr(at, end - at), NamedRow{one.row}).second)
                throw std::logic_error("two rows for " + names.substr(at, end - at));
            at = end + 2;
        }
    }
    return named;
}

std::map<std::string, NamedRow> &rowsByName() {
    static std::map<std::string, NamedRow> rows = namedRows(inputRows);
    return rows;
}

const Row *find(std::map<std::string, NamedRow> &rows, const std::string &name) {
    const auto found = rows.find(name);
    if (found == rows.end())
        return nullptr;
    found->second.isUsed = true;
    return &found->second.row;
}

/// `path` leads to it from the leaf, `owner` is the struct that it is a field of.
Row rowOf(const LeafVariable &variable, const std::string &path, const std::string &owner) {
    for (const std::string &name :
         {variable.type + " " + path, variable.type + " " + owner + "." + variable.name,
          variable.type + " " + variable.name, variable.type})
        if (const Row *row = find(rowsByName(), name))
            return *row;
    const LeafStruct *record = leafStruct(variable.type);
    if (record == nullptr)
        throw std::logic_error("no row of inputs for " + variable.type + " " + path);
    std::vector<Row> fields;
    for (const LeafVariable &field : record->fields)
        fields.push_back(rowOf(field, path + "." + field.name, record->name));
    static std::map<std::string, NamedRow> records = namedRows(sceneRecords);
    const Row *ofScene = find(records, variable.type);
    return [fields, own = ofScene != nullptr ? *ofScene : Row{}](S &s, Words &words) {
        if (own && s.draw.chance(2))
            return own(s, words);
        for (const Row &field : fields)
            field(s, words);
    };
}

std::vector<Row> rowsOf(const LeafProbe &probe) {
    std::vector<Row> rows;
    for (const LeafVariable &parameter : probe.parameters)
        rows.push_back(rowOf(parameter, probe.name + "." + parameter.name, ""));
    return rows;
}

} // namespace

LeafInputs::LeafInputs(const LeafProbe &probe, const LeafScene &scene)
    : situation_(std::make_unique<Situation>(scene)), rows_(rowsOf(probe)) {}

LeafInputs::~LeafInputs() = default;

void LeafInputs::draw(Words &words) {
    situation_->begin();
    for (const Row &row : rows_)
        row(*situation_, words);
}

std::vector<std::string> unusedInputRows() {
    for (const LeafProbe &probe : leafProbes())
        static_cast<void>(rowsOf(probe));
    std::vector<std::string> unused;
    for (const auto &[name, row] : rowsByName())
        if (!row.isUsed)
            unused.push_back(name);
    return unused;
}

} // namespace hyalite::core::testing
