// Every field of every struct in layout.h, for C++ and for GLSL: FIELDS(G, r) calls G(r.field) for each, in order.

#define SPHERE_FIELDS(G, r)                                                                                  \
    G(r.centre) G(r.radius) G(r.materialIndex) G(r.normalSign) G(r.pad0) G(r.pad1)

#define TRIANGLE_FIELDS(G, r) G(r.v0) G(r.primitiveId) G(r.v1) G(r.materialIndex) G(r.v2) G(r.flags)

#define NORMAL_FIELDS(G, r) G(r.n0) G(r.pad0) G(r.n1) G(r.pad1) G(r.n2) G(r.pad2)

#define NODE_FIELDS(G, r)                                                                                    \
    G(r.leftLower) G(r.left) G(r.leftUpper) G(r.pad0) G(r.rightLower) G(r.right) G(r.rightUpper) G(r.pad1)

#define MATERIAL_FIELDS(G, r)                                                                                \
    G(r.albedo) G(r.kind) G(r.segmentTint) G(r.refractiveIndex) G(r.isTwoSided) G(r.pad0) G(r.pad1) G(r.pad2)

#define LIGHT_FIELDS(G, r) G(r.position) G(r.pad0) G(r.intensity) G(r.pad1)

#define FRAME_FIELDS(G, r)                                                                                   \
    G(r.eye) G(r.imageWidth) G(r.pixelRight) G(r.imageHeight) G(r.pixelUp) G(r.seed) G(r.imagePlane)         \
    G(r.lightCount) G(r.background) G(r.shadowThroughGlass) G(r.boundsLower) G(r.triangleCount)              \
    G(r.boundsUpper) G(r.maxDepth)

#define DISPATCH_FIELDS(G, r)                                                                                \
    G(r.cropX) G(r.cropY) G(r.filmWidth) G(r.filmHeight) G(r.tileX) G(r.tileY) G(r.tileWidth)                \
    G(r.tileHeight) G(r.sampleBegin) G(r.sampleEnd) G(r.stepBudget) G(r.isResumed) G(r.interleave)           \
    G(r.traceCapacity) G(r.pad0) G(r.pad1)

#define FILM_FIELDS(G, r) G(r.sum) G(r.sampleCount) G(r.sumOfSquares) G(r.pad0)

#define PROGRESS_FIELDS(G, r)                                                                                \
    G(r.unfinishedSlots) G(r.stackOverflows) G(r.finishedSamples) G(r.traceEvents) G(r.primaryRays)          \
    G(r.shadowRays) G(r.reflectionRays) G(r.refractionRays)

#define TRACE_FIELDS(G, r)                                                                                   \
    G(r.quantity) G(r.sampleIndex) G(r.rayDepth) G(r.integer) G(r.value) G(r.pad0)

#define PATH_FIELDS(G, r)                                                                                    \
    G(r.rayOrigin) G(r.stage) G(r.rayDirection) G(r.rayLength) G(r.throughput) G(r.rayExcluded) G(r.hitU)    \
    G(r.hitV) G(r.hitPrimitive) G(r.hitRecord) G(r.surfacePosition) G(r.surfacePrimitive) G(r.surfaceNormal) \
    G(r.lightIndex) G(r.surfaceGeometricNormal) G(r.rayDepth) G(r.surfaceWeight) G(r.rayMedium)              \
    G(r.surfaceError) G(r.sampleIndex) G(r.sampleRadiance) G(r.pendingCount) G(r.cursorNode)                 \
    G(r.cursorTriangle) G(r.stackSize) G(r.isLightDimmed)

#define PENDING_FIELDS(G, r) G(r.origin) G(r.excluded) G(r.direction) G(r.depth) G(r.throughput) G(r.medium)
