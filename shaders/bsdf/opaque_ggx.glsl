// The opaque lobe: GGX facets of metal or of a plastic surface, multiple scattering between them, and the diffuse base
// below plastic (Kulla and Conty 2017, see energy.glsl).

const float minEnergyLoss = 1e-6; // lower bound of a divisor

float mean(vec3 colour) {
    float sum = colour.x + colour.y + colour.z;
    return sum * (1.0 / 3.0);
}

// (1 - E(o)) / (pi (1 - average E)): the factor of multiple scattering that depends on the viewer.
float lossShare(float energy, float average) {
    float loss = 1.0 - energy;
    float averageLoss = greater(1.0 - average, minEnergyLoss);
    return inversePi * divide(loss, averageLoss);
}

vec3 fresnelReflectance(Bsdf bsdf, float cosine) {
    if ((scattering & scattersAtRoughConductors) != 0u && bsdf.isConductor)
        return conductorReflectance(lesser(cosine, 1.0), bsdf.index, bsdf.extinction);
    vec3 bare = schlickReflectance(cosine, bsdf.reflectance, bsdf.grazing);
    if (hasFilm(bsdf))
        return mixtureOf(bare, iridescentReflectance(bsdf.iridescence, cosine), bsdf.iridescence.share);
    return bare;
}

float facetStretch(Bsdf bsdf, vec3 w) {
    if ((scattering & scattersAtAnisotropic) != 0u)
        return stretchOf(w, bsdf.alphas);
    return stretchOf(w, bsdf.alpha);
}

float facetD(Bsdf bsdf, vec3 m) {
    if ((scattering & scattersAtAnisotropic) != 0u)
        return ggxD(m, bsdf.alphas);
    return ggxD(m, bsdf.alpha);
}


// Adds the lobes of metal and plastic to `bsdf`. `metal` and `plastic` are their shares of the surface; `metalAverage`
// is the cosine-weighted average reflectance of the metal. The base below plastic has `colour` on the side of the
// viewer and `colourBeyond` on the other, which surfaces alike bound, so that light leaves it as it does here. Of a film
// the base gets what it does not reflect of the viewer's direction, and sends it on as below bare plastic, so that
// nothing is lost.
Bsdf addOpaqueLobes(Bsdf bsdf, float metal, float plastic, vec3 colour, vec3 colourBeyond, vec3 metalAverage) {
    Energy energy = energyOf(bsdf.wo.z, bsdf.roughness);
    Energy average = averageEnergy(bsdf.roughness);
    vec3 multiScatterColour = multiScatterReflectance(metalAverage, average.white) * metal;
    bsdf.multiScatter = multiScatterColour * lossShare(energy.white, average.white);
    float plasticEnergy = energyAt(energy, bsdf.plasticReflectance, bsdf.plasticGrazing);
    if (hasFilm(bsdf) && bsdf.iridescence.metal < 1.0) {
        float covered = iridescentEnergy(bsdf.iridescence, energy, bsdf.wo.z, bsdf.roughness, bsdf.plasticReflectance);
        plasticEnergy = mixture(plasticEnergy, covered, bsdf.iridescence.share);
    }
    vec3 diffuseBaseColour = colour * plastic;
    float averagePlastic = energyAt(average, bsdf.plasticReflectance, bsdf.plasticGrazing);
    float baseShare = lossShare(plasticEnergy, averagePlastic);
    bsdf.diffuseBase = diffuseBaseColour * baseShare;
    float facets = mean(fresnelReflectance(bsdf, bsdf.wo.z)) * energy.white;
    float others = mean(multiScatterColour) * (1.0 - energy.white) + mean(diffuseBaseColour) * (1.0 - plasticEnergy);
    float beyond = 0.0;
    if ((scattering & scattersAtDiffuseTransmission) != 0u) {
        vec3 transmittedColour = colourBeyond * plastic;
        bsdf.diffuseTransmission = transmittedColour * baseShare;
        beyond = mean(transmittedColour) * (1.0 - plasticEnergy);
    }
    float through = 0.0;
    if ((scattering & scattersAtThin) != 0u) {
        // What facets lose is given to what passes, so that it is all that is not reflected (Turquin 2019, see
        // energy.glsl).
        float left = 1.0 - plasticEnergy;
        float passedOnce = greater(energy.white - plasticEnergy, minEnergyLoss);
        through = mean(bsdf.thinTint) * left;
        bsdf.thinTint = bsdf.thinTint * divide(left, passedOnce);
    }
    float sum = greater(facets + others + through + beyond, 1e-20);
    bsdf.specularProbability = divide(facets, sum);
    bsdf.thinProbability = divide(through, sum);
    bsdf.diffuseTransmissionProbability = divide(beyond, sum);
    return bsdf;
}

// The diffuse base's part of the value for light at this cosine, without its colour. `energy` is that of the cosine.
float diffuseBaseShare(Bsdf bsdf, Energy energy, float cosine) {
    return (1.0 - energyAt(energy, bsdf.plasticReflectance, bsdf.plasticGrazing)) * cosine;
}

BsdfEval evalOpaque(Bsdf bsdf, vec3 wi) {
    vec3 facet = halfVector(bsdf.wo, wi);
    float cosinePdf = pdfCosine(wi.z);
    float cosine = dotProduct(bsdf.wo, facet);
    float reflected = pdfReflection(facetD(bsdf, facet), bsdf.wo, bsdf.stretchWo);
    float lit = smithG2OverG1(bsdf.wo.z, bsdf.stretchWo, wi.z, facetStretch(bsdf, wi));
    float once = reflected * lit;
    vec3 value = fresnelReflectance(bsdf, cosine) * once;
    float diffuseProbability =
        1.0 - bsdf.specularProbability - bsdf.thinProbability - bsdf.diffuseTransmissionProbability;
    float pdf = bsdf.specularProbability * reflected + diffuseProbability * cosinePdf;
    if (bsdf.specularProbability < 1.0) {
        Energy energy = energyOf(wi.z, bsdf.roughness);
        float multiScatterShare = (1.0 - energy.white) * wi.z;
        value = value + bsdf.multiScatter * multiScatterShare + bsdf.diffuseBase * diffuseBaseShare(bsdf, energy, wi.z);
    }
    return BsdfEval(value, pdf);
}

// Transmission by thin glass, for `wi` below the surface: the facets' reflection, mirrored at the surface
// (KHR_materials_transmission).
BsdfEval evalThin(Bsdf bsdf, vec3 wi) {
    vec3 mirrored = vec3(vec2(wi), -wi.z);
    vec3 facet = halfVector(bsdf.wo, mirrored);
    float cosine = dotProduct(bsdf.wo, facet);
    float passed = pdfReflection(facetD(bsdf, facet), bsdf.wo, bsdf.stretchWo);
    float lit = smithG2OverG1(bsdf.wo.z, bsdf.stretchWo, mirrored.z, facetStretch(bsdf, mirrored));
    float reflected = schlickReflectance(cosine, vec3(bsdf.plasticReflectance), bsdf.plasticGrazing).x;
    if (hasFilm(bsdf))
        reflected = mixture(reflected, iridescentLoss(bsdf.iridescence, cosine), bsdf.iridescence.share);
    float kept = 1.0 - reflected;
    return BsdfEval(bsdf.thinTint * (passed * lit * kept), bsdf.thinProbability * passed);
}

// Light from the other side, for `wi` below the surface.
BsdfEval evalBeyond(Bsdf bsdf, vec3 wi) {
    BsdfEval beyond = BsdfEval(vec3(0.0), 0.0);
    if ((scattering & scattersAtThin) != 0u && bsdf.thinProbability > 0.0)
        beyond = evalThin(bsdf, wi);
    if ((scattering & scattersAtDiffuseTransmission) != 0u && bsdf.diffuseTransmissionProbability > 0.0) {
        float share = diffuseBaseShare(bsdf, energyOf(-wi.z, bsdf.roughness), -wi.z);
        beyond.value = beyond.value + bsdf.diffuseTransmission * share;
        beyond.pdf = beyond.pdf + bsdf.diffuseTransmissionProbability * pdfCosine(-wi.z);
    }
    return beyond;
}
