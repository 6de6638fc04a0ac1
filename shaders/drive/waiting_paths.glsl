// Paths that wait between two dispatches. When the step budget is spent, a resumable kernel saves unfinished samples;
// other kernels drop them, and a later dispatch starts again after the last round in the film.

layout(set = 0, binding = bindingPaths, std430) buffer PathWordBuffer { uint pathWords[]; };

PathRecord recordOf(const TraversalState traversal, uint stage) {
    PathRecord record;
    record.stage = stage;
    record.rayOrigin = traversal.ray.origin;
    record.rayDirection = traversal.ray.direction;
    record.rayLength = stage == stageNewRay || stage == stageNewShadow ? traversal.ray.maxDistance // it has not begun
                                                                       : traversal.hit.distance;
    record.rayExcluded = traversal.ray.excluded;
    record.rayTarget = traversal.ray.target;
    record.hitU = traversal.hit.u;
    record.hitV = traversal.hit.v;
    record.hitPrimitive = traversal.hit.primitive;
    record.hitRecord = traversal.hit.record;
    record.hitInstance = traversal.hit.instance;
    record.flags = (traversal.isDimmed ? waitingIsDimmed : 0u) | (path.isDispersed ? waitingIsDispersed : 0u);
    record.cursorNode = traversal.cursorNode;
    record.cursorTriangle = traversal.cursorTriangle;
    record.cursorInstance = traversal.cursorInstance;
    record.cursorReturn = traversal.cursorReturn;
    record.stackSize = traversal.stackSize;
    record.sampleIndex = path.key.sampleIndex;
    record.sampleRadiance = showsCost ? traversal.work : path.radiance;
    record.transparency = path.transparency;
    record.throughput = path.throughput;
    record.rayDepth = path.key.depth;
    record.rayMedium = path.medium;
    record.mediaInside = path.mediaInside;
    record.surfacePosition = path.vertex.surface.position;
    record.surfaceError = path.vertex.surface.error;
    record.surfaceNormal = path.vertex.surface.normal;
    record.surfaceGeometricNormal = path.vertex.surface.geometricNormal;
    record.surfacePrimitive = path.vertex.primitive;
    record.surfaceMaterial = path.vertex.material;
    record.surfaceWeight = path.lightWeight;
    record.lightIndex = path.lightIndex;
    record.scatterDirection = path.scatterDirection;
    record.scatterPdf = path.scatterPdf;
    record.primaryRays = path.rays.x;
    record.shadowRays = path.rays.y;
    record.reflectionRays = path.rays.z;
    record.refractionRays = path.rays.w;
    record.bounceRays = path.bounces;
#if SPLITS_RAYS
    record.pendingCount = path.pending.count;
#endif
    return record;
}

void takeRecord(inout TraversalState traversal, const PathRecord record) {
    traversal.ray.origin = record.rayOrigin;
    traversal.ray.direction = record.rayDirection;
    traversal.ray.maxDistance = record.rayLength;
    traversal.hit.distance = record.rayLength;
    traversal.ray.excluded = record.rayExcluded;
    traversal.ray.target = record.rayTarget;
    traversal.hit.u = record.hitU;
    traversal.hit.v = record.hitV;
    traversal.hit.primitive = record.hitPrimitive;
    traversal.hit.record = record.hitRecord;
    traversal.hit.instance = record.hitInstance;
    traversal.isDimmed = (record.flags & waitingIsDimmed) != 0u;
    traversal.cursorNode = record.cursorNode;
    traversal.cursorTriangle = record.cursorTriangle;
    traversal.cursorInstance = record.cursorInstance;
    traversal.cursorReturn = record.cursorReturn;
    traversal.stackSize = record.stackSize;
    traversal.work = record.sampleRadiance;
    path.key.sampleIndex = record.sampleIndex;
    path.radiance = record.sampleRadiance;
    path.transparency = record.transparency;
    path.throughput = record.throughput;
    path.key.depth = record.rayDepth;
    path.medium = record.rayMedium;
    path.mediaInside = record.mediaInside;
    path.isDispersed = (record.flags & waitingIsDispersed) != 0u;
    path.vertex.surface.position = record.surfacePosition;
    path.vertex.surface.error = record.surfaceError;
    path.vertex.surface.normal = record.surfaceNormal;
    path.vertex.surface.geometricNormal = record.surfaceGeometricNormal;
    path.vertex.primitive = record.surfacePrimitive;
    path.vertex.material = record.surfaceMaterial;
    path.lightWeight = record.surfaceWeight;
    path.lightIndex = record.lightIndex;
    path.scatterDirection = record.scatterDirection;
    path.scatterPdf = record.scatterPdf;
    path.rays = uvec4(record.primaryRays, record.shadowRays, record.reflectionRays, record.refractionRays);
    path.bounces = record.bounceRays;
#if SPLITS_RAYS
    path.pending.count = record.pendingCount;
#endif
}

uint lightWordOf(uint slot) {
    return pathCount() * pathRecordWords + slotIndex[slot] * (lightStateWords + 3u * lightGroups);
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
    path.light.diffuseOfPath = loadWords(word);
    path.light.diffuseOfShadow = loadWords(word + 3u);
    path.light.seen = loadWords(word + 6u);
    path.light.diffuseDirect = loadWords(word + 9u);
    path.light.glossyDirect = loadWords(word + 12u);
    path.light.transmittedDirect = loadWords(word + 15u);
    path.light.indirect = loadWords(word + 18u);
    path.light.scatterings = pathWords[word + 21u];
    uint flags = pathWords[word + 22u];
    path.light.isPathTransmitted = (flags & 1u) != 0u;
    path.light.isShadowTransmitted = (flags & 2u) != 0u;
    path.light.seenClass = flags >> 2u;
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        path.light.ofGroup[group] = loadWords(word + lightStateWords + 3u * group);
}

void storeLight(uint slot) {
    if (!hasLightPlanes || !isResumable || !isSlotUsed[slot])
        return;
    uint word = lightWordOf(slot);
    storeWords(word, path.light.diffuseOfPath);
    storeWords(word + 3u, path.light.diffuseOfShadow);
    storeWords(word + 6u, path.light.seen);
    storeWords(word + 9u, path.light.diffuseDirect);
    storeWords(word + 12u, path.light.glossyDirect);
    storeWords(word + 15u, path.light.transmittedDirect);
    storeWords(word + 18u, path.light.indirect);
    pathWords[word + 21u] = path.light.scatterings;
    pathWords[word + 22u] = (path.light.isPathTransmitted ? 1u : 0u) |
                            (path.light.isShadowTransmitted ? 2u : 0u) | path.light.seenClass << 2u;
    [[unroll]] for (uint group = 0u; group < lightGroups; ++group)
        storeWords(word + lightStateWords + 3u * group, path.light.ofGroup[group]);
}

// Continues a waiting slot, or starts after the `samplesInFilm` samples of the pixel.
void loadSlot(uint slot, uint samplesInFilm) {
    path.rays = uvec4(0u);
    path.bounces = 0u;
    uint isWaiting = isSlotUsed[slot] ? dispatch.isResumed : 0u;
    if (isResumable && isWaiting != 0u) {
        PathRecord record = pathRecords[slotIndex[slot]];
        takeRecord(traversal[slot], record);
        stage[slot] = record.stage;
        return;
    }
    uint firstSample = dispatch.sampleBegin + samplesInFilm;
    stage[slot] = isSlotUsed[slot] && firstSample < dispatch.sampleEnd ? stageNextSample : stageDone;
    path.key.sampleIndex = firstSample + sampleLane(slot);
    stopTraversal(slot);
}

void storeSlot(uint slot) {
    if (isResumable && isSlotUsed[slot])
        pathRecords[slotIndex[slot]] = recordOf(traversal[slot], stage[slot]);
}
