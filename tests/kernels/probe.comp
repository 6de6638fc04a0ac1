// Entry kernel of the kernel tests: calls one function of shaders/*.glsl for each input. Inputs and outputs are
// words, in the order of the function's parameters and of the fields of its result.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#define MEMORY_TEXELS 0
#define TRAVERSAL_SKIP_LIST 0
#include "shaders/layout/layout.h"
#include "shaders/layout/buffers.h"
#include "tests/kernels/probe.h"

layout(local_size_x_id = 0) in;

#include "shaders/memory/bindings.glsl"
#include "shaders/memory/scene_data.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"

layout(set = 0, binding = bindingProbeInputs, std430) readonly buffer InputBuffer { uint inputWords[]; };
layout(set = 0, binding = bindingProbeOutputs, std430) writeonly buffer OutputBuffer { uint outputWords[]; };

layout(constant_id = constantProbedFunction) const uint probedFunction = 0u;
layout(constant_id = constantInputWords) const uint inputWordCount = 1u;
layout(constant_id = constantOutputWords) const uint outputWordCount = 1u;

uint inputCursor;
uint outputCursor;

uint takeUint() { return inputWords[inputCursor++]; }

float takeFloat() { return uintBitsToFloat(takeUint()); }

vec2 takeVec2() {
    float x = takeFloat();
    return vec2(x, takeFloat());
}

vec3 takeVec3() {
    vec2 xy = takeVec2();
    return vec3(xy, takeFloat());
}

uvec2 takeUvec2() {
    uint x = takeUint();
    return uvec2(x, takeUint());
}

uvec3 takeUvec3() {
    uvec2 xy = takeUvec2();
    return uvec3(xy, takeUint());
}

void give(uint value) { outputWords[outputCursor++] = value; }

void give(float value) { give(floatBitsToUint(value)); }

void give(vec2 value) {
    give(value.x);
    give(value.y);
}

void give(vec3 value) {
    give(value.xy);
    give(value.z);
}

void give(uvec3 value) {
    give(value.x);
    give(value.y);
    give(value.z);
}

void give(Surface surface) {
    give(surface.position);
    give(surface.error);
    give(surface.normal);
    give(surface.geometricNormal);
}

BoxRay takeBoxRay(vec3 origin, vec3 direction) {
    vec3 lower = takeVec3();
    return makeBoxRay(origin, direction, lower, takeVec3());
}

// The members that are read.
InstanceRecord takeInstance() {
    InstanceRecord instance;
    instance.toX = takeVec3();
    instance.toY = takeVec3();
    instance.toZ = takeVec3();
    vec3 offset = takeVec3();
    instance.offsetX = offset.x;
    instance.offsetY = offset.y;
    instance.offsetZ = offset.z;
    instance.slack = takeVec3();
    return instance;
}

void main() {
    loadConstants();
    inputCursor = gl_GlobalInvocationID.x * inputWordCount;
    outputCursor = gl_GlobalInvocationID.x * outputWordCount;
    switch (probedFunction) {
    case probeLookUpTexture: {
        uint row = takeUint();
        vec2 first = takeVec2();
        give(lookUpTexture(row, SurfaceUv(first, takeVec2())));
        break;
    }
    case probeTriangleUv: {
        vec2 uv0 = takeVec2();
        vec2 uv1 = takeVec2();
        vec2 uv2 = takeVec2();
        float u = takeFloat();
        give(triangleUv(Coordinates(uv0, uv1, uv2), u, takeFloat()));
        break;
    }
    case probeSphereUv:
        give(sphereUv(takeVec3()));
        break;
    case probeMappedNormal: {
        TriangleRecord triangle;
        triangle.v0 = takeVec3();
        triangle.v1 = takeVec3();
        triangle.v2 = takeVec3();
        vec2 uv0 = takeVec2();
        vec2 uv1 = takeVec2();
        Tangent tangent = triangleTangent(triangle, Coordinates(uv0, uv1, takeVec2()));
        give(tangent.alongU);
        give(tangent.alongV);
        vec3 normal = takeVec3();
        give(mappedNormal(normal, tangent, takeUint(), SurfaceUv(uv0, uv0)));
        give(mappedNormal(normal, sphereTangent(normal), takeUint(), SurfaceUv(uv1, uv1)));
        break;
    }
    case probeVisibleNormal: {
        vec3 direction = takeVec3();
        vec3 normal = takeVec3();
        give(visibleNormal(direction, normal, takeVec3()));
        break;
    }
    case probeDotProduct: {
        vec3 a = takeVec3();
        give(dotProduct(a, takeVec3()));
        break;
    }
    case probeCrossProduct: {
        vec3 a = takeVec3();
        give(crossProduct(a, takeVec3()));
        break;
    }
    case probeVectorLength:
        give(vectorLength(takeVec3()));
        break;
    case probeUnitVector:
        give(unitVector(takeVec3()));
        break;
    case probeMirrorDirection: {
        vec3 direction = takeVec3();
        give(mirrorDirection(direction, takeVec3()));
        break;
    }
    case probeLargestComponent:
        give(largestComponent(takeVec3()));
        break;
    case probeSmallestComponent:
        give(smallestComponent(takeVec3()));
        break;
    case probeHashKeys:
        give(hashKeys(takeUvec3()));
        break;
    case probeOwenScramble: {
        uint x = takeUint();
        give(owenScramble(x, takeUint()));
        break;
    }
    case probeSecondSobolCoordinate:
        give(secondSobolCoordinate(takeUint()));
        break;
    case probeUnitFloat:
        give(unitFloat(takeUint()));
        break;
    case probeSamplePixel: {
        uvec2 pixel = takeUvec2();
        uint sampleIndex = takeUint();
        give(samplePixel(pixel, sampleIndex, takeUint()));
        break;
    }
    case probePrimaryDirection: {
        uvec2 pixel = takeUvec2();
        give(primaryDirection(pixel, takeVec2()));
        break;
    }
    case probeMakeBoxRay: {
        vec3 origin = takeVec3();
        BoxRay ray = takeBoxRay(origin, takeVec3());
        give(ray.inverse);
        give(ray.origin);
        give(ray.pad);
        break;
    }
    case probeBoxInterval: {
        vec3 origin = takeVec3();
        BoxRay ray = takeBoxRay(origin, takeVec3());
        vec3 lower = takeVec3();
        give(boxInterval(ray, lower, takeVec3()));
        break;
    }
    case probePlacedBoxInterval: {
        vec3 origin = takeVec3();
        BoxRay ray = takeBoxRay(origin, takeVec3());
        PlacedBoxRay placedRay = makePlacedBoxRay(ray, takeInstance());
        vec3 middle = takeVec3();
        give(placedBoxInterval(placedRay, middle, takeVec3()));
        break;
    }
    case probePlacedPoint: {
        InstanceRecord instance = takeInstance();
        give(placedPoint(instance, takeVec3()));
        break;
    }
    case probePlacedNormal: {
        InstanceRecord instance = takeInstance();
        give(placedNormal(instance, takeVec3()));
        break;
    }
    case probeMakeTriangleRay: {
        vec3 origin = takeVec3();
        TriangleRay ray = makeTriangleRay(origin, takeVec3());
        give(ray.origin);
        give(ray.axis);
        give(ray.shear);
        break;
    }
    case probeIntersectTriangle: {
        vec3 origin = takeVec3();
        vec3 direction = takeVec3();
        BoxRay boxRay = takeBoxRay(origin, direction);
        vec3 v0 = takeVec3();
        vec3 v1 = takeVec3();
        TriangleHit hit = intersectTriangle(makeTriangleRay(origin, direction), boxRay, v0, v1, takeVec3());
        give(hit.distance == 0.0 ? 0.0 : hit.distance); // of either sign, as min and max leave it
        give(hit.u);
        give(hit.v);
        break;
    }
    case probeIntersectPair: {
        vec3 origin = takeVec3();
        vec3 direction = takeVec3();
        BoxRay boxRay = takeBoxRay(origin, direction);
        JoinedTriangles pair;
        pair.begin = takeVec3();
        pair.end = takeVec3();
        pair.firstApex = takeVec3();
        pair.secondApex = takeVec3();
        pair.firstCorner = takeUint();
        pair.secondCorner = takeUint();
        bool takesFirst = takeUint() != 0u;
        bool takesSecond = takeUint() != 0u;
        PairHit found = intersectPair(makeTriangleRay(origin, direction), boxRay, pair, takesFirst, takesSecond);
        give(found.hit.distance == 0.0 ? 0.0 : found.hit.distance);
        give(found.hit.u);
        give(found.hit.v);
        give((found.isSecond ? 1u : 0u) + (found.isBoth ? 2u : 0u) +
             (found.hit.distance > 0.0 && found.hit.isBehind ? 4u : 0u));
        break;
    }
    case probeTrianglePoint:
    case probeTrianglePointError: {
        vec3 v0 = takeVec3();
        vec3 v1 = takeVec3();
        vec3 v2 = takeVec3();
        vec2 uv = takeVec2();
        give(probedFunction == probeTrianglePoint ? trianglePoint(v0, v1, v2, uv.x, uv.y)
                                                  : trianglePointError(v0, v1, v2, uv.x, uv.y));
        break;
    }
    case probeIntersectSphere: {
        vec3 origin = takeVec3();
        vec3 direction = takeVec3();
        vec3 centre = takeVec3();
        float radius = takeFloat();
        give(intersectSphere(origin, direction, makeSphereShape(centre, radius), takeUint() != 0u));
        break;
    }
    case probeRefractRay: {
        vec3 direction = takeVec3();
        vec3 facing = takeVec3();
        float index = takeFloat();
        Refraction refraction = refractRay(direction, facing, index, takeUint() != 0u);
        give(refraction.direction);
        give(refraction.reflectance);
        give(refraction.transmittance);
        give(refraction.isTotal ? 1u : 0u);
        break;
    }
    case probeSphereSurface: {
        vec3 origin = takeVec3();
        vec3 direction = takeVec3();
        float distance = takeFloat();
        SphereRecord sphere;
        sphere.centre = takeVec3();
        sphere.materialAndSide = takeUint();
        give(sphereSurface(origin, direction, distance, sphere));
        break;
    }
    case probeTriangleSurface: {
        TriangleRecord triangle;
        triangle.v0 = takeVec3();
        triangle.v1 = takeVec3();
        triangle.v2 = takeVec3();
        NormalRecord normals;
        normals.n0 = takeVec3();
        normals.n1 = takeVec3();
        normals.n2 = takeVec3();
        vec2 uv = takeVec2();
        give(triangleSurface(triangle, normals, uv.x, uv.y));
        break;
    }
    case probeOffsetRayOrigin: {
        Surface surface;
        surface.position = takeVec3();
        surface.error = takeVec3();
        surface.geometricNormal = takeVec3();
        give(offsetRayOrigin(surface, takeVec3()));
        break;
    }
    case probeDivide: {
        float a = takeFloat();
        give(divide(a, takeFloat()));
        break;
    }
    case probeSquareRoot:
        give(squareRoot(takeFloat()));
        break;
    case probeSampleBits: {
        uvec2 pixel = takeUvec2();
        uint seed = takeUint();
        uvec3 keys = pairKeys(pixel, seed, takeUint());
        uvec2 bits = sampleBits(keys, takeUint());
        give(bits.x);
        give(bits.y);
        break;
    }
    case probeSineCosine: {
        SineCosine angle = sineCosine(takeFloat());
        give(angle.sine);
        give(angle.cosine);
        break;
    }
    case probeExpNegative:
        give(expNegative(takeFloat()));
        break;
    case probeSampleCosine: {
        vec3 normal = takeVec3();
        vec3 direction = sampleCosine(normal, takeVec2());
        give(direction);
        give(pdfCosine(direction.z));
        break;
    }
    case probeSampleTriangle:
        give(sampleTriangle(takeVec2()));
        break;
    case probeSampleCone: {
        vec3 axis = takeVec3();
        float squaredRadius = takeFloat();
        float height = coneHeight(squaredRadius, takeFloat());
        give(height);
        give(sampleCone(axis, height, takeVec2()));
        give(pdfCone(height));
        break;
    }
    case probeSampleSphere:
        give(sampleSphere(takeVec2()));
        break;
    case probePowerHeuristic: {
        float a = takeFloat();
        give(powerHeuristic(a, takeFloat()));
        break;
    }
    case probeFresnelDielectric: {
        vec3 direction = takeVec3();
        vec3 facing = takeVec3();
        DielectricFresnel glass = fresnelDielectric(direction, facing, takeFloat());
        give(glass.refracted);
        give(glass.reflectance);
        break;
    }
    case probeMedia: {
        uint inside = takeUint();
        uint material = takeUint();
        give(mediumAround(inside));
        give(mediumCount(inside, material));
        give(enterMedium(inside, material));
        give(leaveMedium(inside, material));
        break;
    }
    case probeAtan2Turns: {
        float y = takeFloat();
        give(atan2Turns(y, takeFloat()));
        break;
    }
    case probeSpotFalloff: {
        vec3 toSpot = takeVec3();
        vec3 axis = takeVec3();
        float cosineOuter = takeFloat();
        give(spotFalloff(toSpot, axis, cosineOuter, takeFloat()));
        break;
    }
    case probeEnvironmentFrom: {
        EnvironmentLight light = environmentFrom(takeVec3());
        give(light.radiance);
        give(light.pdf);
        break;
    }
    case probeSampleEnvironment: {
        EnvironmentLight light = sampleEnvironment(takeUvec2());
        give(light.direction);
        give(light.radiance);
        give(light.pdf);
        break;
    }
    case probePrimaryRay: {
        uvec2 pixel = takeUvec2();
        PrimaryRay ray = primaryRay(pixel, takeUint());
        give(ray.origin);
        give(ray.direction);
        break;
    }
    case probeConductorReflectance: {
        float cosine = takeFloat();
        vec3 index = takeVec3();
        give(conductorReflectance(cosine, index, takeVec3()));
        give(schlickReflectance(cosine, index, index.y));
        break;
    }
    case probeFacets: {
        vec3 view = takeVec3();
        float alpha = takeFloat();
        vec2 u = takeVec2();
        vec3 light = takeVec3();
        float stretchView = stretchOf(view, alpha);
        vec3 facet = sampleGgxVndf(view, alpha, u);
        float pdf = ggxD(facet, alpha);
        give(stretchView);
        give(facet);
        give(pdf);
        give(pdfReflection(pdf, view, stretchView));
        give(smithG2OverG1(view.z, stretchView, light.z, stretchOf(light, alpha)));
        give(halfVector(view, light));
        break;
    }
    case probeFacetsAcross: {
        vec3 view = takeVec3();
        vec3 light = takeVec3();
        float alpha = takeFloat();
        float eta = takeFloat();
        vec3 facet = halfVectorOfRefraction(view, light, eta);
        give(facet);
        give(pdfRefraction(ggxD(facet, alpha), view, stretchOf(view, alpha), dotProduct(view, facet),
                               dotProduct(light, facet), eta));
        break;
    }
    case probeEnergy: {
        float cosine = takeFloat();
        float roughness = takeFloat();
        Energy energy = energyOf(cosine, roughness);
        Energy average = averageEnergy(roughness);
        give(energy.white);
        give(energy.grazing);
        give(average.white);
        give(average.grazing);
        vec3 colour = takeVec3();
        give(energyAt(energy, colour.x, colour.y));
        give(multiScatterReflectance(colour, average.white));
        give(glassEnergy(cosine, roughness, takeFloat()));
        break;
    }
    case probeBsdf: {
        MaterialRecord material;
        material.kindAndSides = takeUint();
        material.albedo = takeVec3();
        material.conductorIndex = takeVec3();
        material.conductorExtinction = takeVec3();
        material.averageReflectance = takeVec3();
        material.alpha = takeFloat();
        material.metallic = takeFloat();
        material.transmission = takeFloat();
        material.normalReflectance = takeFloat();
        material.clearcoat = takeFloat();
        material.clearcoatAlpha = takeFloat();
        material.dielectricColour = takeVec3();
        material.dielectricWeight = takeFloat();
        material.anisotropy = takeFloat();
        material.anisotropyCosine = takeFloat();
        material.anisotropySine = takeFloat();
        material.sheenColour = vec3(0.0); // its table is at a place that only scenes have
        vec3 direction = takeVec3();
        vec3 normal = takeVec3();
        vec3 geometricNormal = takeVec3();
        SurfaceAxes axes;
        axes.tangent = takeVec3();
        axes.coatNormal = takeVec3();
        bool isBehind = takeUint() != 0u;
        float eta = takeFloat();
        vec2 choice = takeVec2();
        Bsdf rough = makeBsdf(material, direction, normal, geometricNormal, axes, isBehind, eta, choice.x);
        vec3 drawn = sampleBsdf(rough, takeVec2(), choice.y);
        BsdfEval scattered = evalBsdf(rough, drawn);
        BsdfEval lit = evalBsdf(rough, takeVec3());
        give(drawn);
        give(scattered.value);
        give(scattered.pdf);
        give(lit.value);
        give(lit.pdf);
        break;
    }
    case probeSolidAnglePdf: {
        float areaPdf = takeFloat();
        float distance = takeFloat();
        give(solidAnglePdf(areaPdf, distance, takeFloat()));
        break;
    }
    case probePdfSphereLight: {
        vec3 position = takeVec3();
        vec3 direction = takeVec3();
        float distance = takeFloat();
        vec3 centre = takeVec3();
        float radius = takeFloat();
        vec3 outward = takeVec3();
        give(pdfSphereLight(position, direction, distance, centre, radius, outward, takeFloat()));
        break;
    }
    }
}
