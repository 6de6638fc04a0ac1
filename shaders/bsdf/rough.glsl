// What surfaces with microfacets do with light, and diffuse ones beside them.
//
// A principled material is a mixture, after Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 courses: a
// clear coat over a metal, a plastic and a glass. At each hit one of coat, glass, and metal with plastic is chosen with
// a probability that follows its share; emitters and scattered rays then meet that one alone, which is unbiased and
// never mixes densities of what was not chosen. The coat leaves to what is below 1 - clearcoat max(E(o), E(i)), which
// is reciprocal and keeps energy (as sheen in glTF's KHR_materials_sheen).

const uint roughDiffuse = 0u;
const uint roughOpaque = 1u;
const uint roughGlass = 2u;

const float coatReflectance = 0.04; // head on: a refractive index of 1.5
const float leastLoss = 1e-6;       // of energy, where it is divided by

struct Rough {
    Frame frame; // its z is the normal on the side of the viewer
    vec3 view;   // towards the viewer, in the frame
    uint kind;
    float alpha;
    float roughness;   // square root of alpha
    float stretchView; // stretchOf(view, alpha)
    bool isConductor;
    vec3 index; // of a conductor
    vec3 extinction;
    vec3 reflectance; // of facets of what is no conductor, head on; the albedo of what is diffuse
    float eta;  // of glass: the refractive index before divided by the one beyond
    vec3 tint;  // of what glass lets pass
    vec3 late;  // what metal reflects later than at once, before (1 - E(i)) cos
    vec3 body;  // what is reflected from below a plastic surface, before (1 - E(i)) cos
    float plasticReflectance; // of that surface, head on
    float coat;       // how much of a coat is above
    float coatRoughness;
    float coatEnergy; // what it reflects of the viewer's direction
    float weight; // 1 / the probability with which it was chosen, of its share
    float facetChance; // that a direction is drawn by facets
};

struct Scattered {
    vec3 value;    // the BSDF times the cosine to the light
    float density; // of the direction, per solid angle
};

float mean(vec3 colour) {
    float sum = colour.x + colour.y + colour.z;
    return sum * (1.0 / 3.0);
}

vec3 toLocal(Frame f, vec3 v) { return vec3(dotProduct(f.x, v), dotProduct(f.y, v), dotProduct(f.z, v)); }

// (1 - E(o)) / (pi (1 - average E)), the part of a lobe of what is not reflected at once that depends on the viewer.
float lossShare(float energy, float average) {
    float loss = 1.0 - energy;
    float averageLoss = greater(1.0 - average, leastLoss);
    return inversePi * divide(loss, averageLoss);
}

vec3 facetReflectance(Rough rough, float cosine) {
    if ((scattering & scattersAtRoughConductors) != 0u && rough.isConductor)
        return conductorReflectance(lesser(cosine, 1.0), rough.index, rough.extinction);
    return schlickReflectance(cosine, rough.reflectance);
}

// The lobes of metal and plastic: `metal` and `plastic` are their shares, the rest is not here.
Rough withLobes(Rough rough, float metal, float plastic, vec3 colour, vec3 metalAverage) {
    Energy energy = energyOf(rough.view.z, rough.roughness);
    Energy average = averageEnergy(rough.roughness);
    vec3 lateColour = lateReflectance(metalAverage, average.white) * metal;
    rough.late = lateColour * lossShare(energy.white, average.white);
    float plasticEnergy = energyAt(energy, rough.plasticReflectance);
    vec3 bodyColour = colour * plastic;
    rough.body = bodyColour * lossShare(plasticEnergy, energyAt(average, rough.plasticReflectance));
    float facets = mean(facetReflectance(rough, rough.view.z)) * energy.white;
    float others = mean(lateColour) * (1.0 - energy.white) + mean(bodyColour) * (1.0 - plasticEnergy);
    float sum = greater(facets + others, 1e-20);
    rough.facetChance = divide(facets, sum);
    return rough;
}

Rough principledOf(Rough rough, MaterialRecord material, bool isBehind, float choice) {
    float left = choice;
    if (material.clearcoat > 0.0 && !isBehind) {
        rough.coat = material.clearcoat;
        rough.coatRoughness = squareRoot(material.clearcoatAlpha);
        rough.coatEnergy = energyAt(energyOf(rough.view.z, rough.coatRoughness), coatReflectance);
        float coatShare = rough.coat * rough.coatEnergy;
        if (left < coatShare) {
            rough.weight = divide(rough.coat, coatShare);
            rough.alpha = material.clearcoatAlpha;
            rough.roughness = rough.coatRoughness;
            rough.stretchView = stretchOf(rough.view, rough.alpha);
            rough.reflectance = vec3(coatReflectance);
            rough.coat = 0.0;
            rough.facetChance = 1.0;
            return rough;
        }
        float rest = 1.0 - coatShare;
        float above = left - coatShare;
        left = divide(above, rest);
        rough.weight = divide(1.0, rest);
    }
    float dielectric = 1.0 - material.metallic;
    float glass = isBehind && material.transmission > 0.0 ? 1.0 : dielectric * material.transmission;
    if ((scattering & scattersAtRoughGlass) != 0u && left < glass) {
        rough.kind = roughGlass;
        rough.tint = vec3(squareRoot(material.albedo.x), squareRoot(material.albedo.y), squareRoot(material.albedo.z));
        return rough;
    }
    float opaque = 1.0 - glass;
    float metal = divide(material.metallic, opaque);
    float plastic = 1.0 - metal;
    rough.plasticReflectance = material.normalReflectance;
    vec3 reflectance = material.albedo * metal + material.normalReflectance * plastic;
    rough.reflectance = reflectance;
    vec3 average = material.albedo + (1.0 - material.albedo) * (1.0 / 21.0);
    return withLobes(rough, metal, plastic, material.albedo, average);
}

// The surface with the unit normals `normal` and `geometricNormal`, on the side of the viewer, where a ray in `direction`
// ends. `eta` is as in Rough; `choice`, in [0, 1), is random.
Rough roughOf(MaterialRecord material, vec3 direction, vec3 normal, vec3 geometricNormal, bool isBehind, float eta,
              float choice) {
    Rough rough;
    rough.frame = frameAround(dotProduct(direction, normal) < 0.0 ? normal : geometricNormal);
    rough.view = toLocal(rough.frame, -direction);
    rough.kind = roughOpaque;
    rough.alpha = material.alpha;
    rough.roughness = squareRoot(material.alpha);
    rough.stretchView = stretchOf(rough.view, material.alpha);
    rough.isConductor = false;
    rough.index = material.conductorIndex;
    rough.extinction = material.conductorExtinction;
    rough.reflectance = material.albedo;
    rough.eta = eta;
    rough.tint = vec3(1.0);
    rough.late = vec3(0.0);
    rough.body = vec3(0.0);
    rough.plasticReflectance = 0.0;
    rough.coat = 0.0;
    rough.coatRoughness = 0.0;
    rough.coatEnergy = 0.0;
    rough.weight = 1.0;
    rough.facetChance = 0.0;
    if ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled)
        return principledOf(rough, material, isBehind, choice);
    if ((scattering & scattersAtRoughConductors) != 0u && kindOf(material) == materialConductor) {
        rough.isConductor = true;
        return withLobes(rough, 1.0, 0.0, vec3(0.0), material.averageReflectance);
    }
    if ((scattering & scattersAtRoughGlass) != 0u && kindOf(material) == materialDielectric) {
        rough.kind = roughGlass;
        return rough;
    }
    rough.kind = roughDiffuse;
    return rough;
}

// A direction in the frame, or 0 where a facet sends light to the wrong side; `choice`, in [0, 1), is another random
// number.
vec3 drawRough(Rough rough, vec2 u, float choice) {
    if (rough.kind == roughDiffuse || rough.kind == roughOpaque && choice >= rough.facetChance) {
        float radius = squareRoot(u.x);
        SineCosine angle = sineCosine(u.y);
        float below = 1.0 - u.x;
        return vec3(radius * angle.cosine, radius * angle.sine, squareRoot(below));
    }
    vec3 facet = sampleVisibleFacet(rough.view, rough.alpha, u);
    if ((scattering & scattersAtRoughGlass) != 0u && rough.kind == roughGlass) {
        Interface glass = meetInterface(-rough.view, facet, rough.eta);
        if (choice >= glass.reflectance)
            return glass.refracted.z < 0.0 ? glass.refracted : vec3(0.0);
    }
    vec3 reflected = unitVector(mirrorDirection(-rough.view, facet));
    return reflected.z > 0.0 ? reflected : vec3(0.0);
}

// Light that passes rough glass to or from `light`, below the surface.
Scattered passGlass(Rough rough, vec3 light) {
    vec3 facet = facetAcross(rough.view, light, rough.eta);
    float viewCosine = dotProduct(rough.view, facet);
    float lightCosine = dotProduct(light, facet);
    if (viewCosine <= 0.0 || lightCosine >= 0.0)
        return Scattered(vec3(0.0), 0.0);
    Interface glass = meetInterface(-rough.view, facet, rough.eta);
    float facets = facetDensity(facet, rough.alpha);
    float passing = (1.0 - glass.reflectance) *
                            refractionDensity(facets, rough.view, rough.stretchView, viewCosine, lightCosine, rough.eta);
    float lit = litShare(rough.view.z, rough.stretchView, light.z, stretchOf(light, rough.alpha));
    float value = passing * lit * (rough.eta * rough.eta) * rough.weight;
    return Scattered(rough.tint * value, passing);
}

// What the surface does with light from `light`, a unit vector in the frame.
Scattered evaluateRough(Rough rough, vec3 light) {
    if ((scattering & scattersAtRoughGlass) != 0u && rough.kind == roughGlass && light.z < 0.0)
        return passGlass(rough, light);
    if (light.z <= 0.0)
        return Scattered(vec3(0.0), 0.0);
    float cosineDensity = pdfCosine(light.z);
    if (rough.kind == roughDiffuse)
        return Scattered(rough.reflectance * cosineDensity, cosineDensity);
    vec3 facet = facetBetween(rough.view, light);
    float cosine = dotProduct(rough.view, facet);
    float reflected = reflectionDensity(facetDensity(facet, rough.alpha), rough.view, rough.stretchView);
    float lit = litShare(rough.view.z, rough.stretchView, light.z, stretchOf(light, rough.alpha));
    if ((scattering & scattersAtRoughGlass) != 0u && rough.kind == roughGlass) {
        float share = reflected * meetInterface(-rough.view, facet, rough.eta).reflectance;
        float value = share * lit * rough.weight;
        return Scattered(vec3(value), share);
    }
    float atOnce = reflected * lit;
    vec3 value = facetReflectance(rough, cosine) * atOnce;
    float density = rough.facetChance * reflected + (1.0 - rough.facetChance) * cosineDensity;
    if (rough.facetChance < 1.0) {
        Energy energy = energyOf(light.z, rough.roughness);
        float lateShare = (1.0 - energy.white) * light.z;
        float bodyShare = (1.0 - energyAt(energy, rough.plasticReflectance)) * light.z;
        value = value + rough.late * lateShare + rough.body * bodyShare;
    }
    if ((scattering & scattersAtPrincipled) != 0u) {
        float below = rough.weight;
        if (rough.coat > 0.0) {
            float energy = energyAt(energyOf(light.z, rough.coatRoughness), coatReflectance);
            float coated = 1.0 - rough.coat * greater(energy, rough.coatEnergy);
            below = below * coated;
        }
        value = value * below;
    }
    return Scattered(value, density);
}
