// What a sample's radiance is made of (light_layers.glsl).

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

struct LightLayers {
    uint scatterings;       // of the path: 0, 1, or more
    vec3 diffuseOfPath;     // share of what comes on the path after its first scattering
    bool isPathTransmitted; // whether the rest of that is transmitted
    vec3 diffuseOfShadow;   // the same of the shadow ray
    bool isShadowTransmitted;
    // What the sample has gained:
    vec3 seen;
    uint seenClass;
    vec3 diffuseDirect;
    vec3 glossyDirect;
    vec3 transmittedDirect;
    vec3 indirect;
    vec3 ofGroup[lightGroupsOrOne];
    // What the path has met at this hit:
    vec3 met;
    uint metScatterings; // before it
    uint metGroup;
};
