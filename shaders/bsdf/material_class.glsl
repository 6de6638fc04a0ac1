// The classes of materials: what a ray may do where it meets one. Integrators ask here, and nowhere else.

// Light passes the material.
bool isGlass(MaterialRecord material) {
    return kindOf(material) == materialDielectric ||
           ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled &&
            material.transmission > 0.0);
}

// Reflection and refraction have one direction each: a mirror, and conductors and glass of roughness 0. Nothing else may
// follow a ray without aiming at lights.
bool isSpecular(MaterialRecord material) {
    return kindOf(material) != materialDiffuse && (kindOf(material) == materialMirror || material.alpha == 0.0);
}

// What scatters light is black from behind, unless it is two-sided, metal or glass.
bool isBlackBehind(MaterialRecord material) {
    return !isTwoSided(material) && (scattering == 0u || kindOf(material) != materialConductor && !isGlass(material));
}

// Whitted's integrator takes principled materials for diffuse ones, and rough metals for mirrors.
bool isDiffuseForWhitted(MaterialRecord material) {
    return kindOf(material) == materialDiffuse ||
           ((scattering & scattersAtPrincipled) != 0u && kindOf(material) == materialPrincipled);
}

bool isGlassForWhitted(MaterialRecord material) { return kindOf(material) == materialDielectric; }

// A mirror's reflectance for Whitted: metals have their colour.
vec3 mirrorReflectanceForWhitted(MaterialRecord material) {
    if ((scattering & scattersAtConductors) != 0u && kindOf(material) == materialConductor)
        return material.albedo;
    return vec3(1.0);
}

// Mirrors and dielectrics have no colour of their own in views.
bool isColourless(MaterialRecord material) {
    return kindOf(material) == materialMirror || kindOf(material) == materialDielectric;
}

// The reflectance of what is specular and no glass, for a ray that meets the surface at this cosine.
vec3 mirrorReflectance(MaterialRecord material, float cosine) {
    if ((scattering & scattersAtConductors) == 0u || kindOf(material) != materialConductor)
        return vec3(1.0);
    return conductorReflectance(lesser(cosine, 1.0), material.conductorIndex, material.conductorExtinction);
}
