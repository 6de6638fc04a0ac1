// The dispatch of BSDFs: which class a material is of, make its BSDF at a hit, sample it, evaluate it. A new lobe has
// its row in each of these functions; integrators ask here, and nowhere else.
#include "shaders/bsdf/iridescence.glsl"
#include "shaders/bsdf/bsdf_record.glsl"
#include "shaders/bsdf/dispersion.glsl"
#include "shaders/bsdf/diffuse.glsl"
#include "shaders/bsdf/opaque_ggx.glsl"
#include "shaders/bsdf/glass_ggx.glsl"
#include "shaders/bsdf/clearcoat.glsl"
#include "shaders/bsdf/sheen.glsl"
#include "shaders/bsdf/principled.glsl"
#include "shaders/bsdf/gltf.glsl"

// ---- Classes: what a ray may do where it meets a material

// Whether light passes the material, and is refracted.
bool isGlass(MaterialRecord material) {
    return kindOf(material) == materialDielectric ||
           ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled &&
            material.transmission > 0.0) ||
           ((scattering & scattersAtGltf) != 0u && kindOf(material) == materialGltf && material.transmission > 0.0 &&
            !isThin(material));
}

// Whether light passes thin glass.
bool isThinGlass(MaterialRecord material) {
    return (scattering & scattersAtThin) != 0u && kindOf(material) == materialGltf && material.transmission > 0.0 &&
           isThin(material);
}

// Whether light goes on in a medium beyond the surface: in glass, or in what absorbs it below a base that lets it
// through.
bool holdsMedium(MaterialRecord material) {
    return isGlass(material) || transmitsDiffusely(material) && !isThin(material) &&
                                    largestComponent(material.absorption) > 0.0;
}

const float clearAlpha = 0.0100001; // of a roughness of 0.1, whose square is rounded up

// Whether the material is seen through like a window's glass: that of a roughness up to 0.1.
bool isClearGlass(MaterialRecord material) {
    return (isGlass(material) || isThinGlass(material)) && material.alpha <= clearAlpha;
}

// Whether light from behind a surface that scatters counts, too. Textures only take from transmission: asked of the
// record without them, the answer is a bound.
bool isLitFromBehind(MaterialRecord material) {
    return (scattering & (scattersAtRoughGlass | scattersAtThin | scattersAtDiffuseTransmission)) != 0u &&
           (isGlass(material) || isThinGlass(material) || transmitsDiffusely(material));
}

// Whether the material shows its base colour, whatever the light.
bool showsBaseColour(MaterialRecord material) { return (scattering & scattersAtUnlit) != 0u && isUnlit(material); }

// Whether reflection and refraction have one direction each: mirrors, and conductors and glass of roughness 0. Only
// these are not lit by light samples.
bool isSpecular(MaterialRecord material) {
    return kindOf(material) != materialDiffuse && (kindOf(material) == materialMirror || material.alpha == 0.0);
}

// Whether the back side is black: that of scattering surfaces, unless they are two-sided, metal or glass.
bool isBlackBehind(MaterialRecord material) {
    return !isTwoSided(material) && (scattering == 0u || kindOf(material) != materialConductor && !isGlass(material) &&
                                                            !isThinGlass(material) && !transmitsDiffusely(material));
}

// Whether the material mixes lobes: principled ones and those of glTF, which are never specular.
bool isMixture(MaterialRecord material) {
    return ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled) ||
           ((scattering & scattersAtGltf) != 0u && kindOf(material) == materialGltf);
}

// Whether views that look through go on at the material, to what it mirrors or lets pass: mirrors, metals and glass of a
// roughness up to 0.1, and mixtures with three quarters of these, the share that Cycles asks for
// (kernel/film/denoising_passes.h).
bool isLookedThrough(MaterialRecord material) {
    if (isSpecular(material))
        return true;
    if (kindOf(material) == materialDiffuse || isUnlit(material) || material.alpha > clearAlpha)
        return false;
    float glass = (1.0 - material.metallic) * material.transmission;
    return !isMixture(material) || material.metallic + glass >= 0.75;
}

// Whether a material that is looked through is a metal rather than glass.
bool isLookedAtAsMetal(MaterialRecord material) {
    return material.metallic > (1.0 - material.metallic) * material.transmission;
}

// The Whitted integrator shows mixtures as diffuse, and rough metals as mirrors.
bool isDiffuseForWhitted(MaterialRecord material) {
    return kindOf(material) == materialDiffuse || isMixture(material);
}

bool isGlassForWhitted(MaterialRecord material) { return kindOf(material) == materialDielectric; }

// Reflectance of a mirror for the Whitted integrator: that of a metal is its colour.
vec3 mirrorReflectanceForWhitted(MaterialRecord material) {
    if ((scattering & scattersAtConductors) != 0u && kindOf(material) == materialConductor)
        return material.albedo;
    return vec3(1.0);
}

// Whether views show the material as white: mirrors and dielectrics.
bool isColourless(MaterialRecord material) {
    return kindOf(material) == materialMirror || kindOf(material) == materialDielectric;
}

// What views show of the colour of a material, seen at this cosine to its normal: below a film, metal has that of its
// reflection.
vec3 albedoForViews(MaterialRecord material, float cosine) {
    if (isColourless(material))
        return vec3(1.0);
    if (kindOf(material) != materialGltf || isUnlit(material))
        return material.albedo;
    vec3 colour = material.albedo;
    if (transmitsDiffusely(material)) {
        float share = (1.0 - material.metallic) * (1.0 - material.transmission) * material.diffuseTransmission;
        colour = mixtureOf(colour, material.diffuseTransmissionColour, share);
    }
    if (!isIridescent(material) || !(material.metallic > 0.0))
        return colour;
    return mixtureOf(colour, metalReflectance(material, cosine), material.metallic * material.iridescence);
}

// Reflectance of a specular material that is not glass, at this cosine of the angle of incidence.
vec3 mirrorReflectance(MaterialRecord material, float cosine) {
    if ((scattering & scattersAtConductors) == 0u || kindOf(material) != materialConductor)
        return vec3(1.0);
    return conductorReflectance(lesser(cosine, 1.0), material.conductorIndex, material.conductorExtinction);
}

// The colour that light has after passing the surface of a mixture's glass; that of other glass is colourless.
vec3 glassTint(MaterialRecord material) {
    if (!isMixture(material))
        return vec3(1.0);
    return kindOf(material) == materialGltf ? material.albedo : principledTint(material);
}

// ---- BSDFs

// Facets of a mixture's glass whose index is that of its surroundings have it instead: they bend and reflect nothing that
// can be seen, and light takes on their colour.
const float nearlyEqualIndex = 1.001;

// The BSDF where a ray in `direction` hits a surface. `geometricNormal`, a unit vector, is on the side of the viewer;
// the unit normal `normal` and that of `axes` are on the same side of the surface. `eta` is as in Bsdf; `choice`, in
// [0, 1), is random.
//
// On a smooth mesh a shading normal may face away from the viewer. Facets that turn away cannot be seen: lobes of
// facets take the geometric normal there. Lambert's lobe does not depend on the viewer, and keeps the shading normal,
// so that shading is smooth up to silhouettes, as in Cycles (kernel/closure/bsdf_diffuse.h). Directions below the
// geometric surface get nothing from either, so that a surface never reflects more than its albedo.
Bsdf makeBsdf(MaterialRecord material, vec3 direction, vec3 normal, vec3 geometricNormal, SurfaceAxes axes,
              bool isBehind, float eta, float choice) {
    Bsdf bsdf;
    bool isLambertian = scattering == 0u || kindOf(material) == materialDiffuse;
    bsdf.frame = makeOrthonormalBasis(isLambertian || dotProduct(direction, normal) < 0.0 ? normal : geometricNormal);
    bsdf.wo = viewerInFrame(bsdf.frame, -direction);
    bsdf.kind = bsdfOpaque;
    bsdf.alpha = material.alpha;
    bsdf.alphas = vec2(material.alpha);
    bsdf.roughness = squareRoot(material.alpha);
    bsdf.stretchWo = stretchOf(bsdf.wo, material.alpha);
    bsdf.isConductor = false;
    bsdf.index = material.conductorIndex;
    bsdf.extinction = material.conductorExtinction;
    bsdf.reflectance = material.albedo;
    bsdf.grazing = 1.0;
    bsdf.eta = eta != 1.0 ? eta : isBehind ? nearlyEqualIndex : divide(1.0, nearlyEqualIndex);
    bsdf.tint = vec3(1.0);
    bsdf.multiScatter = vec3(0.0);
    bsdf.diffuseBase = vec3(0.0);
    bsdf.plasticReflectance = 0.0;
    bsdf.plasticGrazing = 1.0;
    bsdf.thinTint = vec3(0.0);
    bsdf.thinProbability = 0.0;
    bsdf.diffuseTransmission = vec3(0.0);
    bsdf.diffuseTransmissionProbability = 0.0;
    bsdf.weight = 1.0;
    bsdf.specularProbability = 0.0;
    bsdf.iridescence = noIridescence();
    if ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled)
        return makePrincipled(bsdf, material, isBehind, choice);
    if ((scattering & scattersAtGltf) != 0u && kindOf(material) == materialGltf)
        return makeGltf(bsdf, material, axes, geometricNormal, -direction, isBehind, choice);
    if ((scattering & scattersAtRoughConductors) != 0u && kindOf(material) == materialConductor) {
        bsdf.isConductor = true;
        return addOpaqueLobes(bsdf, 1.0, 0.0, vec3(0.0), vec3(0.0), material.averageReflectance);
    }
    if ((scattering & scattersAtRoughGlass) != 0u && kindOf(material) == materialDielectric)
        return makeGlass(bsdf);
    bsdf.kind = bsdfDiffuse;
    return bsdf;
}

// Where neither tangents nor the normals of a clear coat are needed.
Bsdf makeBsdf(MaterialRecord material, vec3 direction, vec3 normal, vec3 geometricNormal, bool isBehind, float eta,
              float choice) {
    SurfaceAxes axes = SurfaceAxes(vec3(0.0), normal);
    return makeBsdf(material, direction, normal, geometricNormal, axes, isBehind, eta, choice);
}

// Samples a direction wi in the frame. It is 0 if the facet sends light to the wrong side. `u` in [0, 1)^2 and `choice`
// in [0, 1) are random. The pdf is evalBsdf(bsdf, wi).pdf.
vec3 sampleBsdf(Bsdf bsdf, vec2 u, float choice) {
    if (scattering == 0u)
        return sampleCosine(u);
    if ((scattering & scattersAtSheen) != 0u && bsdf.kind == bsdfSheen)
        return sampleHemisphere(u);
    bool isThrough = (scattering & scattersAtThin) != 0u && bsdf.kind == bsdfOpaque &&
                     choice >= bsdf.specularProbability && choice < bsdf.specularProbability + bsdf.thinProbability;
    if (bsdf.kind == bsdfDiffuse || bsdf.kind == bsdfOpaque && choice >= bsdf.specularProbability && !isThrough) {
        vec3 wi = sampleCosine(u);
        bool isBeyond = (scattering & scattersAtDiffuseTransmission) != 0u &&
                        choice >= 1.0 - bsdf.diffuseTransmissionProbability;
        return isBeyond ? vec3(vec2(wi), -wi.z) : wi;
    }
    vec3 facet = sampleGgxVndf(bsdf.wo, bsdf.alphas, u);
    if ((scattering & scattersAtRoughGlass) != 0u && bsdf.kind == bsdfGlass) {
        DielectricFresnel glass = fresnelDielectric(-bsdf.wo, facet, bsdf.eta);
        if (choice >= largestComponent(glassReflectance(bsdf, glass, facet)))
            return glass.refracted.z < 0.0 ? glass.refracted : vec3(0.0);
    }
    vec3 reflected = unitVector(mirrorDirection(-bsdf.wo, facet));
    if (isThrough && reflected.z > 0.0)
        return vec3(vec2(reflected), -reflected.z);
    return reflected.z > 0.0 ? reflected : vec3(0.0);
}

// Whether an opaque BSDF has light from the other side.
bool passesLight(Bsdf bsdf) {
    return (scattering & scattersAtThin) != 0u && bsdf.thinProbability > 0.0 ||
           (scattering & scattersAtDiffuseTransmission) != 0u && bsdf.diffuseTransmissionProbability > 0.0;
}

// Value and pdf for light from `wi`, a unit vector in the frame.
BsdfEval evalBsdf(Bsdf bsdf, vec3 wi) {
    if ((scattering & scattersAtRoughGlass) != 0u && bsdf.kind == bsdfGlass && wi.z != 0.0)
        return evalGlass(bsdf, wi);
    if (wi.z <= 0.0 && (wi.z == 0.0 || !passesLight(bsdf)))
        return BsdfEval(vec3(0.0), 0.0);
    if (scattering == 0u || bsdf.kind == bsdfDiffuse)
        return evalDiffuse(bsdf, wi);
    if ((scattering & scattersAtSheen) != 0u && bsdf.kind == bsdfSheen)
        return evalSheen(bsdf, wi);
    BsdfEval opaque;
    if ((scattering & (scattersAtThin | scattersAtDiffuseTransmission)) != 0u && wi.z < 0.0)
        opaque = evalBeyond(bsdf, wi);
    else
        opaque = evalOpaque(bsdf, wi);
    if ((scattering & (scattersAtPrincipled | scattersAtGltf)) != 0u)
        opaque.value = opaque.value * bsdf.weight;
    return opaque;
}

// The share of `value`, which evalBsdf gives for `wi`, that is diffuse: of Lambert's lobe, of the base below plastic on
// either side, or of sheen. In [0, 1] for each channel.
vec3 diffuseShare(Bsdf bsdf, vec3 wi, vec3 value) {
    if (scattering == 0u || bsdf.kind == bsdfDiffuse || (scattering & scattersAtSheen) != 0u && bsdf.kind == bsdfSheen)
        return vec3(1.0);
    if (bsdf.kind != bsdfOpaque || wi.z <= 0.0 && !passesLight(bsdf))
        return vec3(0.0);
    float cosine = abs(wi.z);
    float ofBase = diffuseBaseShare(bsdf, energyOf(cosine, bsdf.roughness), cosine) * bsdf.weight;
    vec3 base = (wi.z > 0.0 ? bsdf.diffuseBase : bsdf.diffuseTransmission) * ofBase;
    vec3 whole = greater(value, vec3(1e-30));
    return lesser(vec3(divide(base.x, whole.x), divide(base.y, whole.y), divide(base.z, whole.z)), vec3(1.0));
}
