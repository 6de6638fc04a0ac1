// A path as integrators know it, and how they ask for its rays. An integrator never traces: it is a step that gets what
// a ray has found and says which ray it wants next (next.glsl). Who traces, when, and with whom together is the drive's.

#include "shaders/integrators/light_state.glsl"

// A point at which the path is lit and scattered. A surface is the only kind so far.
struct Vertex {
    Surface surface;
    uint primitive; // that the surface is of
    uint material;  // with seenFromBehind, where constantScattering needs it
};

// What the random numbers of a path are made of, and its trace.
struct PathKey {
    uint index;  // among the paths of the dispatch
    uvec2 pixel; // of the whole image
    uint sampleIndex;
    uint depth;  // segment number of the current ray: 1 for a primary ray
};

// What a path wants next, in the order in which a drive takes it.
const uint requestResume = 1u;     // nothing: another path of the sample waits
const uint requestNearest = 2u;    // the nearest hit of the ray
const uint requestTurn = 4u;       // to go on at its vertex, together with others that are at theirs; the hit stays
const uint requestVisibility = 5u; // whether the ray arrives
const uint requestEnd = 7u;        // nothing: the sample has ended

struct Request {
    uint kind;
    Ray ray; // of a turn: the one that has found the vertex
};

#if SPLITS_RAYS
// Rays that glass has split off (pending_rays.glsl).
struct PendingStack {
    uint count;
    PendingRay levels[maxPendingInRegisters]; // where pendingInRegisters
};
#endif

struct PathState {
    PathKey key;
    vec3 radiance;    // of the sample so far
    float transparency;
    vec3 throughput;
    uint medium;      // whitted: material of the glass around the ray, or noMaterial
    uint mediaInside; // the glass around the ray, see media.glsl
    bool isDispersed; // its light is of one wavelength, see dispersion.glsl
    Vertex vertex;
    vec3 lightWeight; // what the light adds if it is visible; whitted: throughput * albedo / pi
    uint lightIndex;
    vec3 scatterDirection; // of the ray that leaves the vertex
    float scatterPdf;      // of the current ray's direction, per solid angle; 0: a specular direction
    uvec4 rays;            // of the sample: primary, shadow, reflection, refraction
    uint bounces;          // of the sample: rays that diffuse surfaces scatter
    LightLayers light;
#if SPLITS_RAYS
    PendingStack pending;
#endif
};

// The path that is worked on, and its request: at first the one that is answered, and then the next one. Integrators
// are written on these alone, as if there were no other path. They are no parameters, because functions copy these in
// and out, and lavapipe then pays for each member at the end of each branch: kernels take 1.3 to 3.5 times as long.
#if RAYS == 1
PathState path;
#else
PathState paths[RAYS];
uint activePath = 0u;
#define path paths[activePath]
#endif
Request request;

// What was found.
struct Answer {
    Hit hit;       // visibility: its primitive is what blocks the ray
    bool isDimmed; // visibility: by glass
};

void askNearest(vec3 origin, vec3 direction, uint excluded) {
    request.kind = requestNearest;
    request.ray = Ray(origin, unbounded, direction, excluded, noPrimitive);
}

// Records what a path did, to find where two renderers differ.
void traceEvent(uint quantity, uint integer, vec3 value) {
    if (!isTracing || path.key.index != 0u)
        return;
    uint index = atomicAdd(progress.traceEvents, 1u);
    if (index < dispatch.traceCapacity)
        traceEvents[index] = TraceEvent(quantity, path.key.sampleIndex, path.key.depth, integer, value, 0u);
}

void traceNearestHit(const Hit hit) {
    bool hasWeights = hit.primitive != noPrimitive && isTriangle(hit.primitive);
    traceEvent(traceHit, hit.primitive, vec3(hit.distance, hasWeights ? vec2(hit.u, hit.v) : vec2(0.0)));
}

// The surface of the vertex. Members that the scene makes constant are not read from the path, so they need no
// registers.
Surface surfaceAt() {
    Surface surface = path.vertex.surface;
    if (!hasTriangles)
        surface.error = vec3(0.0);
    bool hasTwoNormals = hasTriangles || (texturing & texturesNormal) != 0u;
    if (!hasTwoNormals)
        surface.geometricNormal = surface.normal;
    return surface;
}

// A ray from the vertex to a light.
void askVisibility(vec3 direction, float distance, uint target) {
    path.rays.y += 1u;
    request.kind = requestVisibility;
    request.ray = Ray(offsetRayOrigin(surfaceAt(), direction), distance, direction, path.vertex.primitive, target);
}

// Begins a sample with its primary ray.
void askPrimary() {
    PrimaryRay ray = primaryRay(path.key.pixel, path.key.sampleIndex);
    path.radiance = vec3(0.0);
    path.throughput = vec3(1.0);
    path.key.depth = 1u;
    path.medium = hasDielectric ? frame.mediumAtEye : noMaterial;
    path.isDispersed = false;
    path.rays.x += 1u;
    askNearest(ray.origin, ray.direction, noPrimitive);
}
