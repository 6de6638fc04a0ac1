// Views of what primary rays meet, and ambient occlusion. Twin: host/reference/view.h.
//
// Ambient occlusion is the share of a white sky that a point sees, weighted by the cosine to its normal, with
// everything further away than `occlusionDistance` left out: Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998.
//
// The shadow of a shadow catcher is the share of its direct light that other surfaces keep from it, by luminance: of a
// matt surface in its place, the sum of light samples that are blocked over the sum of all. A sample is 1, the light
// that an empty scene would send, and what of it is blocked. Glass dims it by `shadowThroughGlass`; other shadow
// catchers do not: their shadows are in the picture that they stand for.
//
// Normals, depths and albedos may look through mirrors and clear glass (isLookedThrough), as auxiliary layers of
// denoisers do: they are those of the first other surface of the path that the path integrator would follow, or of the
// last one that maxDepth allows. The albedo is multiplied by the colours of mirrors and glass on the way; the depth is
// the length of the path; normals are turned towards the ray. Paths that leave the scene show 0. Features of the
// denoiser are all three, of one path.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

layout(constant_id = constantView) const uint view = viewNormal;
layout(constant_id = constantLooksThrough) const bool looksThrough = false;

const bool lightPassesGlass = false;
const bool raysHaveTargets = false;
const bool hasBounces = view == viewShadow; // a ray to the light
const bool carriesRadiance = false;
const bool dispersesLight = false;
const bool hasChains = view == viewShadow || looksThrough;
const bool sendsShadowRays = view == viewOcclusion;
const bool goesOn = false;
const bool showsFeatures = view == viewFeatures;
const bool showsAlbedo = view == viewAlbedo || showsFeatures;
const bool addsLengths = view == viewDepth || showsFeatures; // of segments, in the radiance

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/specular.glsl"

// Textures that say whether a material is looked through, and what it reflects.
const uint texturesOfClearness = texturesRoughness | texturesMetallic | texturesTransmission |
                                 1u << slotDielectricWeight | 1u << slotDielectricColour |
                                 (showsAlbedo
                                      ? texturesBaseColour | texturesIridescence | texturesDiffuseTransmission
                                      : 0u);

// Those that say what albedo a surface shows.
const uint texturesOfAlbedo =
    texturesBaseColour | ((scattering & scattersAtIridescent) != 0u ? texturesMetallic | texturesIridescence : 0u) |
    ((scattering & scattersAtDiffuseTransmission) != 0u
         ? texturesMetallic | texturesTransmission | texturesDiffuseTransmission
         : 0u);

void begin() {
    if (showsFeatures) { // of lanes without a sample
        path.lightWeight = vec3(0.0);
        path.scatterPdf = 0.0;
    }
    if (looksThrough)
        beginInMedia();
    else
        askPrimary();
}

void show(vec3 value) {
    path.radiance = value;
    traceEvent(traceRadiance, 0u, value);
}

// The surface as it is seen from the ray's side.
Surface facing(Surface surface, vec3 direction) {
    if (dotProduct(direction, surface.geometricNormal) > 0.0) {
        surface.normal = -surface.normal;
        surface.geometricNormal = -surface.geometricNormal;
    }
    return surface;
}

// Sends a ray on towards the light, `left` away.
void goToLight(uint primitive, const Surface surface, float left,
               uint target) {
    vec3 direction = path.scatterDirection;
    path.scatterPdf = left;
    path.key.depth = 2u;
    askNearest(offsetRayOrigin(surface, direction), direction, primitive);
    request.ray.target = target;
}

// On a shadow catcher: aims at a light. `lightIndex`: how the light is seen so far, visibility...
void catchShadow(uint primitive, const Surface surface) {
    LitPoint point = LitPoint(surface.position, surface.normal, false);
    EmitterChoice choice = chooseEmitter(point, vertexBits(pairChoice).x);
    LightSample light = sampleEmitter(choice, surface.position, vertexBits(pairLight));
    float cosine = dotProduct(surface.normal, light.direction);
    bool isLit = cosine > 0.0 && dotProduct(surface.geometricNormal, light.direction) > 0.0;
    float unblocked = isLit ? withoutTiny(luminance(light.radiance) * cosine) : 0.0;
    show(vec3(1.0, unblocked, unblocked));
    if (!(unblocked > 0.0))
        return;
    path.rays.y += 1u;
    path.scatterDirection = light.direction;
    path.lightIndex = visibilityClear;
    goToLight(primitive, surface, light.distance, light.target);
}

// The nearest surface on the way to the light is known.
void passToLight(const Answer answer) {
    float left = path.scatterPdf;
    bool isThere = answer.hit.primitive == noPrimitive || answer.hit.distance >= left ||
                   answer.hit.primitive == request.ray.target;
    float unblocked = path.radiance.y;
    if (isThere) {
        bool isDimmed = path.lightIndex == visibilityDimmed;
        float blocked = isDimmed ? unblocked * (1.0 - frame.shadowThroughGlass) : 0.0;
        traceEvent(traceVisibility, path.lightIndex, vec3(0.0));
        show(vec3(1.0, unblocked, blocked));
        return;
    }
    uint materialIndex;
    Surface surface = hitSurface(answer.hit, request.ray.origin, request.ray.direction, materialIndex);
    MaterialRecord material = fetchMaterial(materialIndex);
    bool isDimming = isGlass(material) || isThinGlass(material);
    if (!isDimming && !catchesShadows(material)) {
        traceEvent(traceVisibility, visibilityBlocked, vec3(0.0));
        return;
    }
    if (isDimming)
        path.lightIndex = visibilityDimmed;
    goToLight(answer.hit.primitive, surface, left - answer.hit.distance, request.ray.target);
}

// Thin glass: chooses reflection or passes straight through.
void scatterThinGlass(const Answer answer, const Surface surface,
                      const MaterialRecord material) {
    vec3 direction = request.ray.direction;
    vec3 reflectance = schlickReflectance(abs(dotProduct(direction, surface.normal)), dielectricReflectance(material),
                                          material.dielectricWeight);
    if (unitFloat(vertexBits(pairChoice).x) < largestComponent(reflectance)) {
        reflectRay(answer, surface, surface.normal);
        return;
    }
    weaken(glassTint(material));
    continueRay(offsetRayOrigin(surface, direction), direction, answer.hit.primitive);
}

// Whether the material may be looked through with its textures, which only take from metal and glass: before they are
// looked up. Rough glass may have its own index around it.
bool mayBeLookedThrough(MaterialRecord material) {
    if (material.textures != 0u && isTextured(material.textures, slotRoughness))
        material.alpha = clearAlpha;
    return holdsMedium(material) || isLookedThrough(material);
}

// Sends the ray on, and returns true, if the surface is looked through.
bool lookThrough(const Answer answer, const Surface surface,
                 uint materialIndex) {
    MaterialRecord material = fetchMaterial(materialIndex);
    if (path.key.depth >= frame.maxDepth || !mayBeLookedThrough(material))
        return false;
    stepsTaken += uint(bitCount(texturesOfClearness & texturing));
    material = hitMaterial(answer.hit, material, texturesOfClearness, surface.position);
    vec3 direction = request.ray.direction;
    bool isBehind = dotProduct(direction, surface.geometricNormal) > 0.0;
    bool isClear =
        isSpecularHere(path.mediaInside, material, materialIndex, !isBehind) || isLookedThrough(material);
    if (!isClear || (isBehind && isMixture(material) && isBlackBehind(material)))
        return false;
    if (addsLengths)
        show(path.radiance + vec3(answer.hit.distance));
    bool isMetal = isLookedAtAsMetal(material);
    if (hasDielectric && holdsMedium(material) && !isMetal) {
        if (scatterSmoothDielectric(answer, surface, materialIndex))
            weaken(glassTint(material));
    } else if (isThinGlass(material) && !isMetal) {
        scatterThinGlass(answer, surface, material);
    } else {
        float cosine = abs(dotProduct(direction, surface.normal));
        weaken(isMixture(material) ? metalReflectance(material, cosine) : mirrorReflectance(material, cosine));
        reflectRay(answer, surface, surface.normal);
    }
    return true;
}

// The features beside the albedo: members that views have no other use for.
void showBeside(vec3 normal, float depth) {
    path.lightWeight = normalColour(normal);
    path.scatterPdf = depth;
}

// What a path that has left the scene shows: a normal has no length.
vec3 ofNothing() {
    if (showsFeatures)
        showBeside(vec3(0.0), 0.0);
    if (looksThrough && view == viewNormal)
        return normalColour(vec3(0.0));
    return vec3(view == viewOcclusion ? 1.0 : 0.0);
}

// What the surface at the end of the path shows.
void showSurface(const Answer answer, const Surface surface,
                 uint materialIndex) {
    if (view == viewNormal)
        show(normalColour(surface.normal));
    if (view == viewDepth)
        show(path.radiance + vec3(answer.hit.distance));
    if (view == viewId)
        show(idColour(answer.hit.primitive));
    if (view == viewCoordinates) {
        vec2 uv = hitUvs(answer.hit, surface.position).first;
        show(vec3(fractionOf(uv.x), fractionOf(uv.y), 0.0));
    }
    if (showsFeatures)
        showBeside(surface.normal, path.radiance.x + answer.hit.distance);
    if (showsAlbedo) {
        MaterialRecord material = hitMaterial(answer.hit, fetchMaterial(materialIndex), texturesOfAlbedo,
                                              surface.position);
        vec3 colour = albedoForViews(material, abs(dotProduct(request.ray.direction, surface.normal)));
        show(looksThrough ? withoutTiny(path.throughput * colour) : colour);
    }
    if (view == viewShadow && catchesShadows(fetchMaterial(materialIndex)))
        catchShadow(answer.hit.primitive, facing(surface, request.ray.direction));
    if (view >= viewObject)
        show(vec3(floatOf(numberOf(view, answer.hit.primitive, materialIndex))));
    if (view == viewOcclusion) {
        path.vertex = Vertex(facing(surface, request.ray.direction), answer.hit.primitive, materialIndex);
        request.kind = requestTurn;
    }
}

void shadeHit(const Answer answer) {
    traceNearestHit(answer.hit);
    if (view == viewShadow && path.key.depth > 1u) {
        passToLight(answer);
        return;
    }
    if (answer.hit.primitive == noPrimitive) {
        show(ofNothing());
        return;
    }
    uint materialIndex;
    Surface surface = hitSurface(answer.hit, request.ray.origin, request.ray.direction, materialIndex);
    traceEvent(traceSurfacePosition, 0u, surface.position);
    traceEvent(traceSurfaceNormal, 0u, surface.normal);
    if (looksThrough) {
        if (hasDielectric)
            weaken(transmittance(path.mediaInside, answer.hit.distance));
        if (lookThrough(answer, surface, materialIndex))
            return;
        surface = facing(surface, request.ray.direction);
    }
    showSurface(answer, surface, materialIndex);
}

// Sends a ray to a random point of the sky.
void lightVertex(const Answer answer) {
    uvec2 bits = sampleBits(pairKeys(path.key.pixel, frame.seed, occlusionPair), path.key.sampleIndex);
    vec3 direction = sampleCosine(path.vertex.surface.normal, unitFloats(bits));
    if (dotProduct(surfaceAt().geometricNormal, direction) > 0.0)
        askVisibility(direction, frame.occlusionDistance, noPrimitive);
}

// The ray has reached the sky, or was blocked.
void addLight(const Answer answer) {
    bool isVisible = answer.hit.primitive == noPrimitive;
    traceEvent(traceVisibility, isVisible ? visibilityClear : visibilityBlocked, vec3(0.0));
    if (isVisible)
        show(vec3(1.0));
}

uint stepsOfTurn() { return 0u; }

#include "shaders/drive/drive.glsl"

void main() { integrate(); }
