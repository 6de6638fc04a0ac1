// The path integrator: one path a sample, with next-event estimation at diffuse and rough surfaces, combined with what
// scattered rays find by multiple importance sampling, and Russian roulette. Kajiya, "The Rendering Equation", SIGGRAPH
// 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9 and 10. Twin:
// host/reference/path.h, where the same happens vertex by vertex.
//
// `maxDepth` bounds the segments of a path from the eye to the light, so that neither technique finds longer paths than
// the other.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = hasEmission;
const bool hasBounces = true;
const bool carriesRadiance = true;
const bool dispersesLight = (scattering & scattersAtDispersion) != 0u;
const bool hasChains = hasSpecular;
const bool sendsShadowRays = true;
const bool goesOn = true;
const bool showsFeatures = false;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/specular.glsl"

const uint firstRouletteDepth = 4u; // segments before Russian roulette begins

vec2 lobeChoice() {
    return unitFloats(sampleBits(pairKeys(path.key.pixel, frame.seed, lobePair(path.key.depth)), path.key.sampleIndex));
}

void begin() {
    beginTransparency();
    beginLight();
    path.scatterPdf = 0.0;
    beginInMedia();
}

// Returns what the sample has gained.
vec3 addRadiance(vec3 weight, vec3 radiance) {
    vec3 added = withoutTiny(weight * radiance);
    if (path.key.depth > 1u)
        added = lesser(added, vec3(frame.radianceLimit));
    path.radiance = path.radiance + added;
    traceEvent(traceRadiance, 0u, path.radiance);
    return added;
}

// The vertex that the path was at before its ray, as the light tree sees it.
LitPoint litPoint(const Vertex vertex) {
    bool isTransmitting = scattering != 0u && isLitFromBehind(fetchMaterial(vertex.material & ~seenFromBehind));
    return LitPoint(vertex.surface.position, vertex.surface.normal, isTransmitting);
}

// Emission of the surface at the hit, with the multiple importance weight against a light sample of the same point.
void addEmission(const Ray ray, const Hit hit, const Surface surface, const MaterialRecord material) {
    vec3 direction = ray.direction;
    float facing = -dotProduct(direction, surface.geometricNormal);
    float cosine = emitsBehind(material) ? abs(facing) : facing;
    if (material.emitterPdf <= 0.0 || cosine <= 0.0)
        return;
    float weight = 1.0;
    if (path.scatterPdf > 0.0) {
        float pdf;
        // Every emitting sphere is an emitter, unless its radius is 0, and then nothing hits it.
        if ((lighting & lightsBySpheres) == 0u || isTriangle(hit.primitive)) {
            float areaPdf = material.emitterPdf;
            if (hasLightTree)
                areaPdf = pdfOfEmitter(fetchTriangle(hit.record).flags >> triangleEmitterShift, areaPdf,
                                       litPoint(path.vertex));
            pdf = solidAnglePdf(areaPdf, hit.distance, cosine);
        } else {
            SphereRecord sphere = fetchSphere(hit.record);
            float areaPdf = pdfOfEmitter(sphere.emitter, material.emitterPdf, litPoint(path.vertex));
            pdf = pdfSphereLight(ray.origin, direction, hit.distance, sphere.centre, sphere.radius,
                                 surface.normal * normalSignOf(sphere), areaPdf);
        }
        weight = powerHeuristic(path.scatterPdf, pdf);
    }
    vec3 added = addRadiance(path.throughput * weight, material.emission);
    meetLight(added, lightEmission, material.lightGroup);
}

// Radiance from outside the scene, with the multiple importance weight against a light sample in that direction.
void addEnvironment(vec3 direction) {
    if ((lighting & lightsByEnvironment) == 0u) {
        vec3 added = addRadiance(path.throughput, frame.background);
        meetLight(added, lightBackground, frame.environmentGroup);
        return;
    }
    EnvironmentLight found = environmentFrom(direction);
    float pdf = found.pdf * frame.environmentProbability;
    float weight = path.scatterPdf > 0.0 ? powerHeuristic(path.scatterPdf, pdf) : 1.0;
    vec3 added = addRadiance(path.throughput * weight, found.radiance);
    meetLight(added, lightBackground, frame.environmentGroup);
}

// Russian roulette: long paths with a small throughput end at random, and the others gain their weight.
bool survivesRoulette() {
    if (path.key.depth < firstRouletteDepth)
        return true;
    float index = hasDielectric ? mediumIndex(mediumAround(path.mediaInside)) : 1.0;
    // Radiance in glass is larger by the square of the refractive index; the path will lose that factor on its way out.
    float survival = lesser(largestComponent(path.throughput) * (index * index), 1.0);
    if (unitFloat(vertexBits(pairChoice).y) >= survival)
        return false;
    path.throughput *= divide(1.0, survival);
    return true;
}

// Textures that say what a path does at a hit. Those that only the BSDF needs are looked up when it is made.
uint texturesBeforeLight(const MaterialRecord material) {
    uint wanted = texturesEmission | texturesTransmission;
    if (showsBaseColour(material))
        wanted |= texturesBaseColour;
    if (!isMixture(material)) // so that it may be specular
        wanted |= texturesRoughness;
    return wanted;
}

// The material of the hit at `position`, with the wanted textures applied. The lookups are a loop: they count as steps.
MaterialRecord materialHit(const Hit hit, const MaterialRecord material, uint wanted, vec3 position) {
    stepsTaken += uint(bitCount(wanted & texturing & texturesOfLobes));
    return hitMaterial(hit, material, wanted, position);
}

// A path has left the scene.
void leaveScene(vec3 direction) {
    if (seesThrough())
        path.transparency = meanComponent(path.throughput);
    else
        addEnvironment(direction);
}

// At a mirror or smooth glass, or where a surface that holds a medium lies in glass of higher priority.
void scatterSpecular(const Answer answer, const Surface surface,
                     const MaterialRecord material, uint materialIndex) {
    if (!survivesRoulette())
        return;
    if (hasDielectric && holdsMedium(material)) {
        scatterSmoothDielectric(answer, surface, materialIndex);
    } else {
        if (scattering != 0u)
            weaken(mirrorReflectance(material, abs(dotProduct(request.ray.direction, surface.normal))));
        reflectRay(answer, surface, surface.normal);
    }
}

// Moves the path to a vertex that is lit, and asks for its turn there.
void moveToVertex(uint primitive, Surface surface,
                  const MaterialRecord material, uint materialIndex, bool isBehind) {
    if (isBehind) {
        if (isBlackBehind(material))
            return;
        surface.normal = -surface.normal;
        surface.geometricNormal = -surface.geometricNormal;
    }
    path.vertex = Vertex(surface, primitive, materialIndex | (isBehind ? seenFromBehind : 0u));
    request.kind = requestTurn;
}

void shadePath(const Answer answer) {
    traceNearestHit(answer.hit);
    if (hasDielectric)
        weaken(transmittance(path.mediaInside, answer.hit.distance));
    if (answer.hit.primitive == noPrimitive) {
        leaveScene(request.ray.direction);
        return;
    }
    uint materialIndex;
    Surface surface = hitSurface(answer.hit, request.ray.origin, request.ray.direction, materialIndex);
    MaterialRecord material = fetchMaterial(materialIndex);
    material = materialHit(answer.hit, material, texturesBeforeLight(material), surface.position);
    traceEvent(traceSurfacePosition, 0u, surface.position);
    traceEvent(traceSurfaceNormal, 0u, surface.normal);
    traceEvent(traceThroughput, 0u, path.throughput);
    if (seesThrough() && catchesShadows(material)) {
        path.transparency = meanComponent(path.throughput);
        return;
    }
    if (alphaKind == alphaOfBackground)
        endSeeingThrough();
    if (showsBaseColour(material)) {
        vec3 added = addRadiance(path.throughput, material.albedo);
        meetLight(added, lightEmission, material.lightGroup);
        return;
    }
    if (hasEmission)
        addEmission(request.ray, answer.hit, surface, material);
    if (path.key.depth >= frame.maxDepth)
        return;
    bool isBehind = dotProduct(request.ray.direction, surface.geometricNormal) > 0.0;
    if (scattering != 0u ? !isSpecularHere(path.mediaInside, material, materialIndex, !isBehind)
                         : !hasSpecular || !isSpecular(material))
        moveToVertex(answer.hit.primitive, surface, material, materialIndex, isBehind);
    else
        scatterSpecular(answer, surface, material, materialIndex);
}

void shadeHit(const Answer answer) {
    beginHitLight();
    shadePath(answer);
    endHitLight();
}

// Continues the path from its vertex, in the direction that was sampled when the vertex was lit.
void scatter() {
    vec3 direction = path.scatterDirection;
    if (!(path.scatterPdf > 0.0) || !survivesRoulette())
        return;
    traceEvent(traceScatter, floatBitsToUint(path.scatterPdf), direction);
    path.bounces += 1u;
    continueRay(offsetRayOrigin(surfaceAt(), direction), direction, path.vertex.primitive);
}

// How a vertex scatters: its BSDF, and the media on both sides.
struct Scatterer {
    Bsdf bsdf;
    float lobe; // random number, in [0, 1)
    vec3 geometricNormal;
    Crossing crossing;
    bool isWindow; // what shines through is seen by the scattered ray, as what it is
};

Scatterer scattererAt(const Ray ray, const Hit hit) {
    uint materialIndex = path.vertex.material & ~seenFromBehind;
    bool isBehind = (path.vertex.material & seenFromBehind) != 0u;
    MaterialRecord material = materialHit(hit, fetchMaterial(materialIndex),
                                          texturesOfLobes | texturesBaseColour, path.vertex.surface.position);
    vec3 geometricNormal = surfaceAt().geometricNormal;
    Crossing crossing = Crossing(path.mediaInside, path.mediaInside, 1.0, true, false);
    if ((scattering & (scattersAtRoughGlass | scattersAtDiffuseTransmission)) != 0u && holdsMedium(material))
        crossing = crossingOf(path.mediaInside, materialIndex, !isBehind);
    if (crossing.isDispersing && !isReflectedWhole(crossing, true))
        disperse();
    vec2 lobe = lobeChoice();
    vec3 normal = path.vertex.surface.normal;
    SurfaceAxes axes = hitAxes(hit, ray.origin, ray.direction, material, normal, isBehind);
    Bsdf bsdf = makeBsdf(material, ray.direction, normal, geometricNormal, axes, isBehind, crossing.eta, lobe.x);
    if (crossing.isDispersing && !path.isDispersed)
        bsdf.tint = bsdf.tint * waveOfSample().colour;
    bool isWindow = alphaKind == alphaThroughGlass && seesThrough() && isClearGlass(material);
    return Scatterer(bsdf, lobe.y, geometricNormal, crossing, isWindow);
}

// Samples the direction in which the path continues, as the share of its throughput.
void sampleScattering(const Scatterer scatterer, vec3 diffuseOfLight, bool isLightBeyond) {
    vec3 wi = sampleBsdf(scatterer.bsdf, unitFloats(vertexBits(pairScatter)), scatterer.lobe);
    vec3 direction = unitVector(toWorld(scatterer.bsdf.frame, wi));
    BsdfEval scattered = evalBsdf(scatterer.bsdf, wi);
    bool isBeyond = dotProduct(scatterer.geometricNormal, direction) <= 0.0;
    bool isPossible = scattered.pdf > 0.0 && isBeyond == (wi.z <= 0.0);
    path.scatterDirection = direction;
    path.scatterPdf = isPossible ? scattered.pdf : 0.0;
    if (hasLightClasses && !isLightDiffuse) {
        aimLight(diffuseOfLight, isLightBeyond);
        scatterLight(diffuseShare(scatterer.bsdf, wi, scattered.value), isBeyond);
    } else {
        scatterLight(vec3(1.0), false);
    }
    if (scatterer.crossing.isDispersing && isBeyond && scatterer.bsdf.kind == bsdfGlass)
        path.isDispersed = true;
    if (!(scatterer.isWindow && isBeyond))
        endSeeingThrough();
    if (hasDielectric)
        path.mediaInside = isBeyond ? scatterer.crossing.beyond : scatterer.crossing.before;
    weaken(isPossible ? scattered.value * divide(1.0, scattered.pdf) : vec3(0.0));
}

// At a vertex: samples a light, and the direction in which the path continues.
void lightVertex(const Answer answer) {
    Scatterer scatterer = scattererAt(request.ray, answer.hit);
    EmitterChoice choice = chooseEmitter(litPoint(path.vertex), vertexBits(pairChoice).x);
    LightSample light = sampleEmitter(choice, path.vertex.surface.position, vertexBits(pairLight));
    vec3 wi = toLocal(scatterer.bsdf.frame, light.direction);
    bool isBeyond = dotProduct(scatterer.geometricNormal, light.direction) <= 0.0;
    BsdfEval lit = evalBsdf(scatterer.bsdf, wi);
    bool isLit = largestComponent(light.radiance) > 0.0 && lit.pdf > 0.0 && isBeyond == (wi.z <= 0.0);
    if (scatterer.isWindow && isLit && isBeyond)
        isLit = fetchEmitter(choice.index).kind != emitterEnvironment;
    float share = light.pdf > 0.0 ? powerHeuristic(light.pdf, lit.pdf) : 1.0;
    path.lightWeight = path.throughput * (light.radiance * (lit.value * share));
    if (hasDielectric) {
        path.mediaInside = isBeyond ? scatterer.crossing.beyond : scatterer.crossing.before;
        path.lightWeight *= transmittance(path.mediaInside, light.distance);
    }
    vec3 diffuse = vec3(0.0);
    if (hasLightClasses && !isLightDiffuse)
        diffuse = diffuseShare(scatterer.bsdf, wi, lit.value);
    sampleScattering(scatterer, diffuse, isBeyond);
    if (!isLit) {
        traceEvent(traceVisibility, visibilityUnlit, vec3(choice.index));
        scatter();
        return;
    }
    path.lightIndex = choice.index;
    askVisibility(light.direction, light.distance, light.target);
}

void addLight(const Answer answer) {
    bool isVisible = answer.hit.primitive == noPrimitive;
    traceEvent(traceVisibility, isVisible ? visibilityClear : visibilityBlocked, vec3(path.lightIndex));
    if (isVisible) {
        vec3 added = addRadiance(path.lightWeight, vec3(1.0));
        if (hasLightPlanes)
            addSampledLight(added, lightGroupOf(fetchEmitter(path.lightIndex)));
    }
    scatter();
}

// Steps of the search for an emitter, in a turn of all rays.
uint stepsOfTurn() {
    // Of the light tree, this is the usual depth, too.
    uint emitters = emitterCount > 1u ? RAYS * uint(findMSB(emitterCount) + 1) : 0u;
    uint texels = (lighting & lightsByEnvironment) != 0u
                      ? RAYS * uint(findMSB(frame.environmentWidth) + findMSB(frame.environmentHeight) + 2)
                      : 0u;
    const uint stepsPerProfile = 12u; // of a usual one
    uint profiles = (lighting & lightsByProfiles) != 0u ? RAYS * stepsPerProfile : 0u;
    return emitters + texels + profiles;
}

#include "shaders/drive/drive.glsl"

void main() { integrate(); }
