// Layers of light: what a sample's radiance is made of, by classes and by groups of emitters. The class is that of the
// first surface that scatters the path, direct if it is lit by an emitter and indirect otherwise, or that of what is
// seen without any. Where a surface is diffuse and glossy at once, the shares of both in its BSDF's value divide what
// comes that way, as Cycles' passes do; mirrors are glossy, and clear glass is either glossy or transmits. So the
// layers of all classes add up to the picture, and those of all groups do. Twin: host/reference/light_layers.h.
//
// A plane is a layer of the film: those of the classes in `lightClasses` come first.

void beginLight() {
    if (!hasLightPlanes)
        return;
    path.light.scatterings = 0u;
    path.light.diffuseOfPath = vec3(0.0);
    path.light.isPathTransmitted = false;
    path.light.diffuseOfShadow = vec3(0.0);
    path.light.isShadowTransmitted = false;
    path.light.seen = vec3(0.0);
    path.light.seenClass = lightEmission;
    path.light.diffuseDirect = vec3(0.0);
    path.light.glossyDirect = vec3(0.0);
    path.light.transmittedDirect = vec3(0.0);
    path.light.indirect = vec3(0.0);
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        path.light.ofGroup[group] = vec3(0.0);
}

// A surface scatters the path: `diffuse` is the share of its value that is, and the rest is glossy or transmitted.
void scatterLight(vec3 diffuse, bool isTransmitted) {
    if (!hasLightClasses)
        return;
    if (path.light.scatterings == 0u) {
        path.light.diffuseOfPath = diffuse;
        path.light.isPathTransmitted = isTransmitted;
    }
    path.light.scatterings = min(path.light.scatterings + 1u, 2u);
}

// The same of what the shadow ray from the surface that scatters the path may bring.
void aimLight(vec3 diffuse, bool isTransmitted) {
    path.light.diffuseOfShadow = diffuse;
    path.light.isShadowTransmitted = isTransmitted;
}

void addToGroup(vec3 added, uint number) {
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        path.light.ofGroup[group] = path.light.ofGroup[group] + (group == number ? added : vec3(0.0));
}

void addDirect(vec3 added, vec3 diffuse, bool isTransmitted) {
    vec3 diffusePart = isLightDiffuse ? added : withoutTiny(added * diffuse);
    path.light.diffuseDirect = path.light.diffuseDirect + diffusePart;
    if (isLightDiffuse)
        return;
    vec3 otherPart = withoutTiny(added - diffusePart);
    bool isGlossy = !isLightTransmitted || !isTransmitted;
    path.light.glossyDirect = path.light.glossyDirect + (isGlossy ? otherPart : vec3(0.0));
    if (isLightTransmitted)
        path.light.transmittedDirect = path.light.transmittedDirect + (isGlossy ? vec3(0.0) : otherPart);
}

// The path meets nothing that shines, so far.
void beginHitLight() {
    path.light.met = vec3(0.0);
    path.light.metScatterings = 0u;
    path.light.metGroup = 0u;
}

// What the path has met; `seen`, path.light..., is its class where nothing has scattered the path.
void meetLight(vec3 added, uint seen, uint group) {
    path.light.met = added;
    path.light.metScatterings = path.light.scatterings;
    path.light.metGroup = group;
    path.light.seenClass = path.light.scatterings == 0u ? seen : path.light.seenClass;
}

// Adds it: once for all that a hit may be, which lavapipe pays for whatever it is.
void endHitLight() {
    if (!hasLightPlanes)
        return;
    addToGroup(path.light.met, path.light.metGroup);
    if (!hasLightClasses)
        return;
    uint before = path.light.metScatterings;
    path.light.seen = path.light.seen + (before == 0u ? path.light.met : vec3(0.0));
    path.light.indirect = path.light.indirect + (before == 2u ? path.light.met : vec3(0.0));
    addDirect(before == 1u ? path.light.met : vec3(0.0), path.light.diffuseOfPath, path.light.isPathTransmitted);
}

// Adds what a shadow ray has brought.
void addSampledLight(vec3 added, uint group) {
    addToGroup(added, group);
    if (!hasLightClasses)
        return;
    bool isFirst = path.light.scatterings == 1u;
    path.light.indirect = path.light.indirect + (isFirst ? vec3(0.0) : added);
    addDirect(isFirst ? added : vec3(0.0), path.light.diffuseOfShadow, path.light.isShadowTransmitted);
}

uint planeOfClass(uint lightClass) { return uint(bitCount(lightClasses & (1u << lightClass) - 1u)); }

// The planes of a finished sample.
void planesOfSample(out vec3 planes[lightPlanesOrOne]) {
    vec3 diffuseIndirect =
        isLightDiffuse ? path.light.indirect : withoutTiny(path.light.indirect * path.light.diffuseOfPath);
    vec3 otherIndirect = withoutTiny(path.light.indirect - diffuseIndirect);
    bool isGlossy = !path.light.isPathTransmitted;
    vec3 ofClass[lightClassCount] = vec3[](
        path.light.seenClass == lightEmission ? path.light.seen : vec3(0.0),
        path.light.seenClass == lightBackground ? path.light.seen : vec3(0.0), path.light.diffuseDirect,
        diffuseIndirect, path.light.glossyDirect, isGlossy ? otherIndirect : vec3(0.0), path.light.transmittedDirect,
        isGlossy ? vec3(0.0) : otherIndirect);
    [[unroll]] for (uint lightClass = 0u; lightClass < lightClassCount; ++lightClass)
        if ((lightClasses >> lightClass & 1u) != 0u)
            planes[planeOfClass(lightClass)] = ofClass[lightClass];
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        planes[planesOfClasses + group] = path.light.ofGroup[group];
}
