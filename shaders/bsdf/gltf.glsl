// The material of glTF 2.0: a clear coat over sheen over an iridescent film on a mixture of metal, plastic whose base
// may let light through, glass and thin glass, as the specification and its extensions KHR_materials_... define it,
// except for what facets lose at once: see README.md.
//
// As in principled.glsl one component is chosen at each hit.

// Directions that a material needs of a surface beyond its normal.
struct SurfaceAxes {
    vec3 tangent;    // in which u grows, of any length; 0: unknown
    vec3 coatNormal; // of the clear coat: a unit vector that is on the same side of the surface as the viewer
};

// Whether the base lets light through, diffusely.
bool transmitsDiffusely(MaterialRecord material) {
    return (scattering & scattersAtDiffuseTransmission) != 0u && kindOf(material) == materialGltf &&
           material.diffuseTransmission > 0.0;
}

// Reflectance of the dielectric part at normal incidence: KHR_materials_specular.
vec3 dielectricReflectance(MaterialRecord material) {
    return lesser(material.dielectricColour * material.normalReflectance, vec3(1.0)) * material.dielectricWeight;
}

// Reflectance of the metal, smooth and with its film, at this cosine of the angle of incidence.
vec3 metalReflectance(MaterialRecord material, float cosine) {
    vec3 bare = schlickReflectance(cosine, material.albedo, 1.0);
    if (!isIridescent(material))
        return bare;
    Iridescence film = filmOnOpaque(material, 1.0, vec3(0.0));
    return mixtureOf(bare, iridescentReflectance(film, cosine), material.iridescence);
}

// Turns the frame so that x is the direction in which facets are stretched, and stretches them:
// KHR_materials_anisotropy.
Bsdf makeAnisotropic(Bsdf bsdf, MaterialRecord material, vec3 tangent, vec3 toViewer) {
    vec3 normal = bsdf.frame.z;
    vec3 inPlane = tangent - normal * dotProduct(normal, tangent);
    if (!(dotProduct(inPlane, inPlane) > 1e-30))
        return bsdf;
    vec3 along = unitVector(inPlane);
    vec3 across = crossProduct(normal, along);
    vec3 x = along * material.anisotropyCosine + across * material.anisotropySine;
    bsdf.frame.x = x;
    bsdf.frame.y = crossProduct(normal, x);
    bsdf.wo = viewerInFrame(bsdf.frame, toViewer);
    float strength = material.anisotropy * material.anisotropy;
    bsdf.alphas = vec2(mixture(material.alpha, 1.0, strength), material.alpha);
    float product = bsdf.alphas.x * bsdf.alphas.y;
    bsdf.roughness = squareRoot(squareRoot(product));
    return bsdf;
}

// The coat alone, with its own normal.
Bsdf makeCoatOf(Bsdf bsdf, MaterialRecord material, vec3 toViewer, vec3 normal, float share) {
    bsdf.frame = makeOrthonormalBasis(normal);
    bsdf.wo = viewerInFrame(bsdf.frame, toViewer);
    return makeClearcoat(bsdf, material, share);
}

// `toViewer` is a unit vector: bsdf.wo in world space. `geometricNormal` is on its side. A coat whose normal faces away
// from the viewer takes the geometric one, as the frame does: at a negative cosine Schlick's curve exceeds 1.
Bsdf makeGltf(Bsdf bsdf, MaterialRecord material, SurfaceAxes axes, vec3 geometricNormal, vec3 toViewer, bool isBehind,
              float choice) {
    float left = choice;
    bool isInside = isBehind && material.transmission > 0.0 && !isThin(material);
    if (material.clearcoat > 0.0 && !isInside) {
        vec3 coatNormal = dotProduct(toViewer, axes.coatNormal) > 0.0 ? axes.coatNormal : geometricNormal;
        float cosine = lesser(dotProduct(toViewer, coatNormal), 1.0);
        float share = material.clearcoat * clearcoatAlbedo(cosine, squareRoot(material.clearcoatAlpha));
        if (left < share)
            return makeCoatOf(bsdf, material, toViewer, coatNormal, share);
        float rest = 1.0 - share;
        float dimmed = 1.0 - material.clearcoat * schlickReflectance(cosine, vec3(clearcoatReflectance), 1.0).x;
        bsdf.weight = divide(dimmed, rest);
        left = choiceBeyond(left, share);
    }
    float strongestSheen = largestComponent(material.sheenColour);
    if ((scattering & scattersAtSheen) != 0u && strongestSheen > 0.0) {
        float share = lesser(strongestSheen * sheenAlbedo(bsdf.wo.z, material.sheenAlpha), 1.0);
        if (left < share)
            return makeSheen(bsdf, material.sheenColour, material.sheenAlpha, share);
        // The weight of what lies below, 1 - share, is also the probability of choosing it.
        left = choiceBeyond(left, share);
    }
    vec3 normalReflectance = dielectricReflectance(material);
    vec3 colour = material.albedo;
    if ((material.kindAndSides & materialIsSpecularGlossy) != 0u)
        colour = colour * (1.0 - largestComponent(material.dielectricColour));
    float dielectric = 1.0 - material.metallic;
    float thin = isThin(material) ? material.transmission : 0.0;
    float glass = isInside ? 1.0 : dielectric * (material.transmission - thin);
    if ((scattering & scattersAtRoughGlass) != 0u && left < glass) {
        bsdf.tint = colour;
        if (isIridescent(material))
            bsdf.iridescence = filmOnGlass(material, bsdf.eta, isBehind);
        return makeGlass(bsdf);
    }
    if ((scattering & scattersAtAnisotropic) != 0u && material.anisotropy > 0.0) {
        bsdf = makeAnisotropic(bsdf, material, axes.tangent, toViewer);
        bsdf.stretchWo = facetStretch(bsdf, bsdf.wo);
    }
    float opaque = 1.0 - glass;
    float metal = divide(material.metallic, opaque);
    float plastic = 1.0 - metal;
    bsdf.plasticReflectance = largestComponent(normalReflectance);
    bsdf.plasticGrazing = material.dielectricWeight;
    bsdf.reflectance = material.albedo * metal + normalReflectance * plastic;
    bsdf.grazing = metal + material.dielectricWeight * plastic;
    bsdf.thinTint = colour * (plastic * thin);
    vec3 average = material.albedo + (1.0 - material.albedo) * (1.0 / 21.0);
    if (isIridescent(material)) {
        bsdf.iridescence = filmOnOpaque(material, metal, normalReflectance);
        if (metal > 0.0)
            average = mixtureOf(average, averageIridescence(bsdf.iridescence), material.iridescence);
    }
    vec3 colourBeyond = vec3(0.0);
    if (transmitsDiffusely(material)) {
        colourBeyond = material.diffuseTransmissionColour * material.diffuseTransmission;
        colour = colour * (1.0 - material.diffuseTransmission);
    }
    return addOpaqueLobes(bsdf, metal, plastic * (1.0 - thin), colour, colourBeyond, average);
}
