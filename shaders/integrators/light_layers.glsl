// Layers of light: what a sample's radiance is made of, by classes and by groups of emitters. The class is that of the
// first surface that scatters the path, direct if it is lit by an emitter and indirect otherwise, or that of what is
// seen without any. Where a surface is diffuse and glossy at once, the shares of both in its BSDF's value divide what
// comes that way, as Cycles' passes do; mirrors are glossy, and clear glass is either glossy or transmits. So the layers
// of all classes add up to the picture, and those of all groups do. Twin: host/reference/light_layers.h.
//
// A plane is a layer of the film: those of the classes in `lightClasses` come first.

const bool hasLightClasses = lightClasses != 0u;
const bool hasLightGroups = lightGroups != 0u;
const bool hasLightPlanes = hasLightClasses || hasLightGroups;
const bool isLightDiffuse = (lightClasses >> lightGlossyDirect) == 0u; // no surface is anything else
const bool isLightTransmitted = (lightClasses >> lightTransmissionDirect) != 0u;
// Bits of classes: two at a time.
const uint lightClassPairs = (lightClasses & 0x55u) + (lightClasses >> 1u & 0x55u);
const uint lightClassFours = (lightClassPairs & 0x33u) + (lightClassPairs >> 2u & 0x33u);
const uint planesOfClasses = (lightClassFours & 15u) + (lightClassFours >> 4u);
const uint lightPlanes = planesOfClasses + lightGroups;
const uint lightPlanesOrOne = hasLightPlanes ? lightPlanes : 1u; // no array is empty
const uint lightGroupsOrOne = hasLightGroups ? lightGroups : 1u;

layout(set = 0, binding = bindingPaths, std430) buffer PathWordBuffer { uint pathWords[]; };

uint scatterings[RAYS];         // of the path: 0, 1, or more
vec3 diffuseOfPath[RAYS];       // share of what comes on the path after its first scattering
uint isPathTransmitted[RAYS];   // whether the rest of that is transmitted
vec3 diffuseOfShadow[RAYS];     // the same of the shadow ray
uint isShadowTransmitted[RAYS];
// What the sample has gained:
vec3 seenLight[RAYS];
uint seenClass[RAYS];
vec3 diffuseDirect[RAYS];
vec3 glossyDirect[RAYS];
vec3 transmittedDirect[RAYS];
vec3 indirectLight[RAYS];
vec3 lightOfGroup[RAYS][lightGroupsOrOne];
// What the path has met at this hit:
vec3 metLight[RAYS];
uint metScatterings[RAYS]; // before it
uint metGroup[RAYS];

void beginLight(uint slot) {
    if (!hasLightPlanes)
        return;
    scatterings[slot] = 0u;
    diffuseOfPath[slot] = vec3(0.0);
    isPathTransmitted[slot] = 0u;
    diffuseOfShadow[slot] = vec3(0.0);
    isShadowTransmitted[slot] = 0u;
    seenLight[slot] = vec3(0.0);
    seenClass[slot] = lightEmission;
    diffuseDirect[slot] = vec3(0.0);
    glossyDirect[slot] = vec3(0.0);
    transmittedDirect[slot] = vec3(0.0);
    indirectLight[slot] = vec3(0.0);
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        lightOfGroup[slot][group] = vec3(0.0);
}

// A surface scatters the path: `diffuse` is the share of its value that is, and the rest is glossy or transmitted.
void scatterLight(uint slot, vec3 diffuse, bool isTransmitted) {
    if (!hasLightClasses)
        return;
    if (scatterings[slot] == 0u) {
        diffuseOfPath[slot] = diffuse;
        isPathTransmitted[slot] = isTransmitted ? 1u : 0u;
    }
    scatterings[slot] = min(scatterings[slot] + 1u, 2u);
}

// The same of what the shadow ray from the surface that scatters the path may bring.
void aimLight(uint slot, vec3 diffuse, bool isTransmitted) {
    diffuseOfShadow[slot] = diffuse;
    isShadowTransmitted[slot] = isTransmitted ? 1u : 0u;
}

void addToGroup(uint slot, vec3 added, uint number) {
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        lightOfGroup[slot][group] = lightOfGroup[slot][group] + (group == number ? added : vec3(0.0));
}

void addDirect(uint slot, vec3 added, vec3 diffuse, uint isTransmitted) {
    vec3 diffusePart = isLightDiffuse ? added : withoutTiny(added * diffuse);
    diffuseDirect[slot] = diffuseDirect[slot] + diffusePart;
    if (isLightDiffuse)
        return;
    vec3 otherPart = withoutTiny(added - diffusePart);
    bool isGlossy = !isLightTransmitted || isTransmitted == 0u;
    glossyDirect[slot] = glossyDirect[slot] + (isGlossy ? otherPart : vec3(0.0));
    if (isLightTransmitted)
        transmittedDirect[slot] = transmittedDirect[slot] + (isGlossy ? vec3(0.0) : otherPart);
}

// The path meets nothing that shines, so far.
void beginHitLight(uint slot) {
    metLight[slot] = vec3(0.0);
    metScatterings[slot] = 0u;
    metGroup[slot] = 0u;
}

// What the path has met; `seen`, light..., is its class where nothing has scattered the path.
void meetLight(uint slot, vec3 added, uint seen, uint group) {
    metLight[slot] = added;
    metScatterings[slot] = scatterings[slot];
    metGroup[slot] = group;
    seenClass[slot] = scatterings[slot] == 0u ? seen : seenClass[slot];
}

// Adds it: once for all that a hit may be, which lavapipe pays for whatever it is.
void endHitLight(uint slot) {
    if (!hasLightPlanes)
        return;
    addToGroup(slot, metLight[slot], metGroup[slot]);
    if (!hasLightClasses)
        return;
    uint before = metScatterings[slot];
    seenLight[slot] = seenLight[slot] + (before == 0u ? metLight[slot] : vec3(0.0));
    indirectLight[slot] = indirectLight[slot] + (before == 2u ? metLight[slot] : vec3(0.0));
    addDirect(slot, before == 1u ? metLight[slot] : vec3(0.0), diffuseOfPath[slot], isPathTransmitted[slot]);
}

// Adds what a shadow ray has brought.
void addSampledLight(uint slot, vec3 added, uint group) {
    addToGroup(slot, added, group);
    if (!hasLightClasses)
        return;
    bool isFirst = scatterings[slot] == 1u;
    indirectLight[slot] = indirectLight[slot] + (isFirst ? vec3(0.0) : added);
    addDirect(slot, isFirst ? added : vec3(0.0), diffuseOfShadow[slot], isShadowTransmitted[slot]);
}

uint planeOfClass(uint lightClass) { return uint(bitCount(lightClasses & (1u << lightClass) - 1u)); }

// The planes of a finished sample.
void planesOfSample(uint slot, out vec3 planes[lightPlanesOrOne]) {
    vec3 diffuseIndirect =
        isLightDiffuse ? indirectLight[slot] : withoutTiny(indirectLight[slot] * diffuseOfPath[slot]);
    vec3 otherIndirect = withoutTiny(indirectLight[slot] - diffuseIndirect);
    bool isGlossy = isPathTransmitted[slot] == 0u;
    vec3 ofClass[lightClassCount] = vec3[](
        seenClass[slot] == lightEmission ? seenLight[slot] : vec3(0.0),
        seenClass[slot] == lightBackground ? seenLight[slot] : vec3(0.0), diffuseDirect[slot], diffuseIndirect,
        glossyDirect[slot], isGlossy ? otherIndirect : vec3(0.0), transmittedDirect[slot],
        isGlossy ? vec3(0.0) : otherIndirect);
    [[unroll]] for (uint lightClass = 0u; lightClass < lightClassCount; ++lightClass)
        if ((lightClasses >> lightClass & 1u) != 0u)
            planes[planeOfClass(lightClass)] = ofClass[lightClass];
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        planes[planesOfClasses + group] = lightOfGroup[slot][group];
}

// ---- Paths that wait between two dispatches: words behind the records of all slots

uint lightWordOf(uint slot) {
    return slotCount() * pathRecordWords + slotIndex[slot] * (lightStateWords + 3u * lightGroups);
}

void storeWords(uint word, vec3 value) {
    pathWords[word] = floatBitsToUint(value.x);
    pathWords[word + 1u] = floatBitsToUint(value.y);
    pathWords[word + 2u] = floatBitsToUint(value.z);
}

vec3 loadWords(uint word) {
    return uintBitsToFloat(uvec3(pathWords[word], pathWords[word + 1u], pathWords[word + 2u]));
}

void loadLight(uint slot) {
    uint isWaiting = isSlotUsed[slot] ? dispatch.isResumed : 0u;
    if (!hasLightPlanes || !isResumable || isWaiting == 0u)
        return;
    uint word = lightWordOf(slot);
    diffuseOfPath[slot] = loadWords(word);
    diffuseOfShadow[slot] = loadWords(word + 3u);
    seenLight[slot] = loadWords(word + 6u);
    diffuseDirect[slot] = loadWords(word + 9u);
    glossyDirect[slot] = loadWords(word + 12u);
    transmittedDirect[slot] = loadWords(word + 15u);
    indirectLight[slot] = loadWords(word + 18u);
    scatterings[slot] = pathWords[word + 21u];
    uint flags = pathWords[word + 22u];
    isPathTransmitted[slot] = flags & 1u;
    isShadowTransmitted[slot] = flags >> 1u & 1u;
    seenClass[slot] = flags >> 2u;
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        lightOfGroup[slot][group] = loadWords(word + lightStateWords + 3u * group);
}

void storeLight(uint slot) {
    if (!hasLightPlanes || !isResumable || !isSlotUsed[slot])
        return;
    uint word = lightWordOf(slot);
    storeWords(word, diffuseOfPath[slot]);
    storeWords(word + 3u, diffuseOfShadow[slot]);
    storeWords(word + 6u, seenLight[slot]);
    storeWords(word + 9u, diffuseDirect[slot]);
    storeWords(word + 12u, glossyDirect[slot]);
    storeWords(word + 15u, transmittedDirect[slot]);
    storeWords(word + 18u, indirectLight[slot]);
    pathWords[word + 21u] = scatterings[slot];
    pathWords[word + 22u] = isPathTransmitted[slot] | isShadowTransmitted[slot] << 1u | seenClass[slot] << 2u;
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        storeWords(word + lightStateWords + 3u * group, lightOfGroup[slot][group]);
}
