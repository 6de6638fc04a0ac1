// The classic integrator: direct light with shadows on diffuse surfaces, both branches at glass, all of it
// deterministic. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.
// Twin: host/reference/whitted.h, where the same happens ray by ray.
//
// Glass splits a path in two: it goes on with the refracted ray, and its reflection is another path of the sample,
// which is followed after it.
#version 450
#extension GL_GOOGLE_include_directive : require

#define SPLITS_RAYS 1
#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = hasDielectric;
const bool raysHaveTargets = false;
const bool hasBounces = false;
const bool hasChains = hasSpecular;
const bool sendsShadowRays = true;
const bool goesOn = hasSpecular || lightCount > 1u;
const bool showsFeatures = false;

#include "shaders/kernels/stages.glsl"

void begin() {
    path.pending.count = 0u;
    beginTransparency();
    beginInMedia();
}

// Ends a path; the sample may have another one pending.
void endPath() {
    if (hasDielectric && path.pending.count > 0u)
        request.kind = requestResume;
}

// Follows a pending ray, which was reflected.
void resume() {
    PendingRay ray = popPendingRay();
    endSeeingThrough();
    path.throughput = ray.throughput;
    path.key.depth = ray.depth;
    path.medium = ray.medium;
    askNearest(ray.origin, ray.direction, ray.excluded);
}

void reflectRay(uint primitive, const Surface surface, uint medium) {
    vec3 direction = mirrorDirection(request.ray.direction, surface.normal);
    endSeeingThrough();
    path.key.depth += 1u;
    path.medium = medium;
    path.rays.z += 1u;
    askNearest(offsetRayOrigin(surface, direction), direction, primitive);
}

PendingRay reflectedRay(vec3 direction, uint primitive, const Surface surface,
                        float reflectance, uint medium) {
    PendingRay reflected;
    reflected.direction = mirrorDirection(direction, surface.normal);
    reflected.origin = offsetRayOrigin(surface, reflected.direction);
    reflected.excluded = primitive;
    reflected.depth = path.key.depth + 1u;
    reflected.medium = medium;
    reflected.throughput = path.throughput * reflectance;
    return reflected;
}

// Each branch makes its own ray. A branch that only copies would become selections, which lavapipe merges a second time
// under the mask of the enclosing loop; it computes common parts of the branches once.
void pushReflectedRay(vec3 direction, uint primitive, const Surface surface, float reflectance,
                      uint medium) {
    uint level = path.pending.count;
    path.pending.count = level + 1u;
    if (pendingInRegisters == 0u)
        storePendingRay(level * pathCount() + path.key.index,
                        reflectedRay(direction, primitive, surface, reflectance, medium));
    [[unroll]] for (uint i = 0u; i < pendingInRegisters; ++i)
        if (i == level)
            path.pending.levels[i] = reflectedRay(direction, primitive, surface, reflectance, medium);
}

void splitAtGlass(uint primitive, const Surface surface,
                  const MaterialRecord material, uint materialIndex, bool isEntering) {
    vec3 direction = request.ray.direction;
    vec3 facing = isEntering ? surface.normal : -surface.normal;
    Refraction refraction = refractRay(direction, facing, material.refractiveIndex, isEntering);
    traceEvent(traceReflectance, refraction.isTotal ? 1u : 0u, vec3(refraction.reflectance));
    uint mediumOfReflection = isEntering ? path.medium : materialIndex;
    if (refraction.isTotal) {
        reflectRay(primitive, surface, mediumOfReflection);
        return;
    }
    // The reflected ray waits; the path continues with the refracted one.
    pushReflectedRay(direction, primitive, surface, refraction.reflectance, mediumOfReflection);
    path.rays.z += 1u;

    path.throughput = path.throughput * refraction.transmittance;
    path.key.depth += 1u;
    path.medium = isEntering ? materialIndex : noMaterial;
    path.rays.w += 1u;
    askNearest(offsetRayOrigin(surface, refraction.direction), refraction.direction, primitive);
}

// Radiance of rays that leave the scene.
vec3 radianceAround(vec3 direction) {
    if ((lighting & lightsByEnvironment) != 0u)
        return environmentRadianceAt(environmentPlace(direction));
    return frame.background;
}

void leaveScene(vec3 direction, vec3 tint) {
    if (seesThrough())
        path.transparency = meanComponent(path.throughput * tint);
    else
        path.radiance = path.radiance + withoutTiny(path.throughput * tint) * radianceAround(direction);
    traceEvent(traceRadiance, 0u, path.radiance);
}

void addRadiance(vec3 added) {
    path.radiance = path.radiance + added;
    traceEvent(traceRadiance, 0u, path.radiance);
}

// Moves the path to a surface that its lights light.
void moveToVertex(uint primitive, Surface surface,
                  const MaterialRecord material) {
    if (isTwoSided(material) && dotProduct(request.ray.direction, surface.geometricNormal) > 0.0) {
        surface.normal = -surface.normal;
        surface.geometricNormal = -surface.geometricNormal;
    }
    path.vertex = Vertex(surface, primitive, 0u);
    path.lightWeight = path.throughput * (material.albedo * inversePi);
    path.lightIndex = 0u;
    request.kind = requestTurn;
}

void shadeHit(const Answer answer) {
    traceNearestHit(answer.hit);
    // Tint of the glass that the ray was in, fetched once.
    vec3 tint = vec3(1.0);
    if (hasDielectric && path.medium != noMaterial)
        tint = fetchMaterial(path.medium).segmentTint;
    vec3 direction = request.ray.direction;
    if (answer.hit.primitive == noPrimitive) {
        leaveScene(direction, tint);
        endPath();
        return;
    }
    uint materialIndex;
    Surface surface = hitSurface(answer.hit, request.ray.origin, direction, materialIndex);
    MaterialRecord material = hitMaterial(answer.hit, fetchMaterial(materialIndex),
                                          texturesBaseColour | texturesEmission, surface.position);
    bool isEntering = dotProduct(direction, surface.normal) < 0.0;
    bool isClear = hasDielectric && isGlassForWhitted(material);
    if (hasDielectric)
        path.throughput = withoutTiny(path.throughput * (isClear && !isEntering ? material.segmentTint : tint));
    traceEvent(traceSurfacePosition, 0u, surface.position);
    traceEvent(traceSurfaceNormal, 0u, surface.normal);
    traceEvent(traceThroughput, 0u, path.throughput);
    if (seesThrough() && catchesShadows(material)) {
        path.transparency = meanComponent(path.throughput);
        endPath();
        return;
    }
    if (alphaKind == alphaOfBackground)
        endSeeingThrough();
    if (showsBaseColour(material)) {
        addRadiance(path.throughput * material.albedo);
        endPath();
        return;
    }
    bool isSeenFromFront = dotProduct(direction, surface.geometricNormal) < 0.0;
    if (hasEmission && (isSeenFromFront || emitsBehind(material)))
        addRadiance(path.throughput * material.emission);
    endPath();
    if (!hasSpecular || isDiffuseForWhitted(material)) {
        moveToVertex(answer.hit.primitive, surface, material);
    } else if (path.key.depth < frame.maxDepth) {
        if (isClear) {
            splitAtGlass(answer.hit.primitive, surface, material, materialIndex, isEntering);
        } else {
            path.throughput = withoutTiny(path.throughput * mirrorReflectanceForWhitted(material));
            reflectRay(answer.hit.primitive, surface, path.medium);
        }
    }
}

// The next light, if there is one.
void goToNextLight() {
    path.lightIndex += 1u;
    request.kind = requestTurn;
    if (path.lightIndex == lightCount) {
        request.kind = requestEnd;
        endPath();
    }
}

// Sends a shadow ray to the next light, if it is on the front side of the surface.
void lightVertex(const Answer answer) {
    if (path.lightIndex == lightCount) { // there is none
        endPath();
        return;
    }
    LightRecord light = lightAt(path.lightIndex);
    vec3 toLight = light.position - path.vertex.surface.position;
    float distance = vectorLength(toLight);
    vec3 direction = toLight * divide(1.0, distance);
    if ((lighting & lightsByDirections) != 0u && light.kind == lightDirectional) {
        distance = unbounded;
        direction = -light.axis;
    }
    Surface surface = surfaceAt();
    if (dotProduct(surface.normal, direction) > 0.0 && dotProduct(surface.geometricNormal, direction) > 0.0) {
        askVisibility(direction, distance, noPrimitive);
        return;
    }
    traceEvent(traceVisibility, visibilityUnlit, vec3(path.lightIndex));
    goToNextLight();
}

void addLight(const Answer answer) {
    bool isVisible = answer.hit.primitive == noPrimitive;
    bool isDimmed = hasDielectric && answer.isDimmed;
    traceEvent(traceVisibility, isVisible ? (isDimmed ? visibilityDimmed : visibilityClear) : visibilityBlocked,
               vec3(path.lightIndex));
    if (isVisible) {
        LightRecord light = lightAt(path.lightIndex);
        float squaredDistance = answer.hit.distance * answer.hit.distance;
        float cosine = dotProduct(path.vertex.surface.normal, request.ray.direction);
        bool isDirectional = (lighting & lightsByDirections) != 0u && light.kind == lightDirectional;
        vec3 irradiance = light.intensity * (isDirectional ? cosine : divide(cosine, squaredDistance));
        if ((lighting & lightsBySpots) != 0u && light.kind == lightSpot)
            irradiance *= spotFalloff(request.ray.direction, light.axis, light.cosineOuter, light.falloffScale);
        if ((lighting & lightsByProfiles) != 0u && lightKindOf(light) == lightProfiled)
            irradiance *= spotFalloff(request.ray.direction, light.axis, light.cosineOuter, light.falloffScale) *
                          profileShare(profileOf(light), request.ray.direction, light.axis);
        vec3 reflected = path.lightWeight * irradiance;
        if (isDimmed)
            reflected *= frame.shadowThroughGlass;
        addRadiance(reflected);
    }
    goToNextLight();
}

uint stepsOfTurn() { return 0u; }

#include "shaders/drive/drive.glsl"

void main() { integrate(); }
