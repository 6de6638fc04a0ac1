// The path slots of an invocation: where they are in the image, how they wait between dispatches, what they count.
//
// A slot works on every `samplesInFlight`-th sample of one pixel; neighbouring slots take the samples in between. Rays
// of one pixel are coherent. On a CPU a subgroup pays for everything that any of its lanes does, so samples side by
// side waste less than pixels side by side. When the step budget is spent, a resumable kernel saves unfinished samples
// in the path buffer; other kernels drop them, and a later dispatch starts again after the last round in the film.

const float unbounded = 3.4028234e38; // length of a ray without a hit

PathRecord path[RAYS];
uint slotIndex[RAYS]; // among the slots of the tile
uvec2 imagePixel[RAYS]; // of the whole image
uint filmIndex[RAYS];
bool isSlotUsed[RAYS]; // a tile may reach beyond the film, and a film have places without a pixel

const uint filmPixelWords = 16u;

uint stepsTaken = 0u;         // loop iterations of this dispatch
uint stepsForfeited = 0u;     // of these, steps that were skipped because the work budget of the dispatch was spent
uint passWork = 0u;           // other work, in the equivalent of steps
uint stackOverflowCount = 0u;
uint finishedSampleCount = 0u;
uvec4 rayCounts[RAYS];               // of unfinished samples: primary, shadow, reflection, refraction
uvec4 finishedRayCounts = uvec4(0u); // of samples in the film
uint bounceCounts[RAYS];               // of unfinished samples: rays that diffuse surfaces scatter
uint finishedBounceCount = 0u;
uvec4 workCounts = uvec4(0u);         // nodes, boxes, triangles, deepest stack: only where isCounting
uvec2 passCounts = uvec2(0u);         // passes of the subgroup through the traversal, slots busy in them: likewise
uint busySlotsBefore = 0u;            // the present pass

uint slotCount() { return dispatch.tileWidth * dispatch.tileHeight * samplesInFlight; }

// Position of the slot among the samples in flight.
uint sampleLane(uint slot) { return slotIndex[slot] & (samplesInFlight - 1u); }

// Quotient and remainder, for a < 2^24, b > 0 and a quotient below 2^20, by a float division that is off by less than
// 1: CPUs divide whole vectors of floats, but integers one by one.
uvec2 divideSmall(uint a, uint b) {
    uint quotient = uint(float(a) / float(b));
    quotient -= quotient * b > a ? 1u : 0u;
    quotient += a - quotient * b >= b ? 1u : 0u;
    return uvec2(quotient, a - quotient * b);
}

// Neighbouring slots are neighbouring samples or pixels, in blocks of 4x2 and 8x8 pixels, so that the rays of a
// subgroup are coherent.
uvec2 pixelOfSlot(uint index) {
    uint pixel = index / samplesInFlight;
    uint block = pixel >> 6u;
    uint k = pixel & 63u;
    uint blocksAcross = dispatch.tileWidth >> 3u;
    uvec2 inBlock = uvec2((k & 3u) | ((k >> 1u) & 4u), ((k >> 2u) & 1u) | ((k >> 3u) & 6u));
    return divideSmall(block, blocksAcross).yx * 8u + inBlock;
}

// Finds the pixel of the slot with this index.
void placeSlotAt(uint slot, uint index) {
    slotIndex[slot] = index;
    uvec2 filmPixel = uvec2(dispatch.tileX, dispatch.tileY) + pixelOfSlot(index);
    filmIndex[slot] = filmPixel.y * dispatch.filmWidth + filmPixel.x;
    uvec2 whole = filmPixel + uvec2(dispatch.cropX, dispatch.cropY);
    uint position = packPosition(whole.x, whole.y);
    bool isInFilm = index < slotCount() && filmPixel.x < dispatch.filmWidth && filmPixel.y < dispatch.filmHeight;
    bool isGathered = isInFilm && dispatch.isGathered != 0u;
    uint word = isGathered ? dispatch.filmWidth * dispatch.filmHeight * filmPixelWords + filmIndex[slot] : 0u;
    // Once for each sample: lavapipe passes over a loop that no lane enters, where it would pay for both arms of an `if`.
    // In other kernels, that load once, a loop makes it keep paths in memory, and they take three times as long.
    if (regeneratesPaths)
        while (isGathered) {
            position = filmWords[word];
            isGathered = false;
        }
    else
        position = isGathered ? filmWords[word] : position;
    imagePixel[slot] = uvec2(position & 0xFFFFu, position >> 16u);
    isSlotUsed[slot] = isInFilm && position != noPosition;
}

// The block of slots on which the workgroup works (DispatchConstants::interleave).
uint blockOfWorkgroup() {
    uvec2 part = divideSmall(gl_WorkGroupID.x, divideSmall(gl_NumWorkGroups.x, dispatch.interleave).x);
    return part.y * dispatch.interleave + part.x;
}

// Finds the pixel of the slot. With several slots an invocation, the slots of 8 lanes are side by side.
void placeSlot(uint slot) {
    uint lanes = blockOfWorkgroup() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    placeSlotAt(slot, (lanes >> 3u) * (8u * RAYS) + slot * 8u + (lanes & 7u));
}

// The counts of a finished sample's shadow rays, reflections and refractions, and of its bounces, in a word that is not
// 0.
uint packCounts(uvec3 rays, uint bounces) {
    return sampleIsFinished | rays.x | rays.y << bitsPerCount | rays.z << 2u * bitsPerCount |
           bounces << 3u * bitsPerCount;
}

// The same four counts.
uvec4 unpackCounts(uint finished) {
    return (uvec4(finished) >> uvec4(0u, bitsPerCount, 2u * bitsPerCount, 3u * bitsPerCount)) & countMask;
}

// Leaves the slots one pass if others have spent the work budget of the dispatch.
void shareWork() {
    stepsForfeited = progress.workDone >= dispatch.workBudget ? dispatch.stepBudget : 0u;
    stepsTaken = stepsForfeited;
}

// Continues a waiting slot, or starts after the `samplesInFilm` samples of the pixel.
void loadSlot(uint slot, uint samplesInFilm) {
    rayCounts[slot] = uvec4(0u);
    bounceCounts[slot] = 0u;
    uint isWaiting = isSlotUsed[slot] ? dispatch.isResumed : 0u;
    if (isResumable && isWaiting != 0u) {
        path[slot] = pathRecords[slotIndex[slot]];
        rayCounts[slot] = uvec4(path[slot].primaryRays, path[slot].shadowRays, path[slot].reflectionRays,
                                path[slot].refractionRays);
        bounceCounts[slot] = path[slot].bounceRays;
        return;
    }
    uint firstSample = dispatch.sampleBegin + samplesInFilm;
    path[slot].stage = isSlotUsed[slot] && firstSample < dispatch.sampleEnd ? stageNextSample : stageDone;
    path[slot].sampleIndex = firstSample + sampleLane(slot);
    path[slot].pendingCount = 0u;
    path[slot].stackSize = 0u;
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
    path[slot].cursorInstance = noInstance;
}

void storeSlot(uint slot) {
    if (!isResumable)
        return;
    path[slot].primaryRays = rayCounts[slot].x;
    path[slot].shadowRays = rayCounts[slot].y;
    path[slot].reflectionRays = rayCounts[slot].z;
    path[slot].refractionRays = rayCounts[slot].w;
    path[slot].bounceRays = bounceCounts[slot];
    if (isSlotUsed[slot])
        pathRecords[slotIndex[slot]] = path[slot];
}

// Adds what slots left unfinished, and the work of the dispatch.
void addWork(uint unfinished) {
    unfinished = sumOfLanes(unfinished);
    uint work = maxOfLanes(stepsTaken - stepsForfeited + passWork);
    if (!subgroupElected())
        return;
    atomicAdd(progress.workDone, work);
    if (unfinished != 0u)
        atomicAdd(progress.unfinishedSlots, unfinished);
}

void addProgress() {
    if (isCounting) {
        atomicAdd(progress.nodesVisited, workCounts.x);
        atomicAdd(progress.boxesTested, workCounts.y);
        atomicAdd(progress.trianglesTested, workCounts.z);
        atomicMax(progress.deepestStack, workCounts.w);
        atomicAdd(progress.traversalPasses, passCounts.x);
        atomicAdd(progress.busySlots, passCounts.y);
    }
    uint unfinished = 0u;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        unfinished += path[slot].stage != stageDone ? 1u : 0u;
    addWork(unfinished);
    uint overflows = sumOfLanes(stackOverflowCount);
    uint samples = sumOfLanes(finishedSampleCount);
    uvec4 rays = uvec4(sumOfLanes(finishedRayCounts.x), sumOfLanes(finishedRayCounts.y),
                       sumOfLanes(finishedRayCounts.z), sumOfLanes(finishedRayCounts.w));
    uint bounces = hasBounces ? sumOfLanes(finishedBounceCount) : 0u;
    if (!subgroupElected())
        return;
    if (overflows != 0u)
        atomicAdd(progress.stackOverflows, overflows);
    atomicAdd(progress.finishedSamples, samples);
    atomicAdd(progress.primaryRays, rays.x);
    atomicAdd(progress.shadowRays, rays.y);
    if (hasSpecular)
        atomicAdd(progress.reflectionRays, rays.z);
    if (hasDielectric)
        atomicAdd(progress.refractionRays, rays.w);
    if (hasBounces)
        atomicAdd(progress.bounceRays, bounces);
}

// Counts the nodes, boxes and triangles that a slot tests.
void countWork(uint slot, uvec3 work) {
    if (!isCounting)
        return;
    workCounts.xyz += work;
    if (showsCost)
        path[slot].sampleRadiance = path[slot].sampleRadiance + vec3(work);
}

// Counts a pass of the subgroup through a loop of the traversal: one of its busy lanes does.
void countPass() {
    if (!isCounting || passCounts.y == busySlotsBefore)
        return;
    passCounts.x += subgroupElect() ? 1u : 0u;
    busySlotsBefore = passCounts.y;
}

// Counts a slot in a pass, and what it tests, if anything.
void countSlot(uint slot, bool isBusy, uvec3 work) {
    if (!isCounting || !isBusy)
        return;
    passCounts.y += 1u;
    countWork(slot, work);
}

// Records what a path did, to find where two renderers differ.
void traceEvent(uint slot, uint quantity, uint integer, vec3 value) {
    if (!isTracing || slotIndex[slot] != 0u)
        return;
    uint index = atomicAdd(progress.traceEvents, 1u);
    if (index < dispatch.traceCapacity)
        traceEvents[index] =
            TraceEvent(quantity, path[slot].sampleIndex, path[slot].rayDepth, integer, value, 0u);
}
