// The path slots of an invocation: where they are in the image, how they wait between dispatches, what they count.
//
// A slot works on every `samplesAbreast`-th sample of one pixel; neighbouring slots take the samples in between. Rays
// of one pixel go nearly the same way, so on a CPU, where a subgroup pays for all that any of its lanes does, samples
// abreast waste less than pixels abreast. What a slot has begun and not finished when the step budget is spent waits
// in the path buffer; kernels that are not resumable drop it, and it is done again from the last round in the film.

const float unbounded = 3.4028234e38; // length of a ray that has met nothing

PathRecord path[RAYS];
uint slotIndex[RAYS]; // among the slots of the tile
uvec2 imagePixel[RAYS]; // of the whole image
uint filmIndex[RAYS];
bool isSlotUsed[RAYS]; // a tile may reach beyond the film

uint stepsTaken = 0u;         // loop iterations of this dispatch
uint stackOverflowCount = 0u;
uint finishedSampleCount = 0u;
uvec4 rayCounts[RAYS];               // of unfinished samples: primary, shadow, reflection, refraction
uvec4 finishedRayCounts = uvec4(0u); // of all others

uint slotCount() { return dispatch.tileWidth * dispatch.tileHeight * samplesAbreast; }

// Which of the samples abreast the slot works on.
uint sampleLane(uint slot) { return slotIndex[slot] & (samplesAbreast - 1u); }

// Neighbouring slots are neighbouring samples or pixels: 8 pixels are a block of 4x2, 64 of 8x8, as coherent rays take
// the same way through the tree.
uvec2 pixelOfSlot(uint index) {
    uint pixel = index / samplesAbreast;
    uint block = pixel >> 6u;
    uint k = pixel & 63u;
    uint blocksAcross = dispatch.tileWidth >> 3u;
    uvec2 inBlock = uvec2((k & 3u) | ((k >> 1u) & 4u), ((k >> 2u) & 1u) | ((k >> 3u) & 6u));
    return uvec2(block % blocksAcross, block / blocksAcross) * 8u + inBlock;
}

// Finds the slot's place. With several slots an invocation, the slots of 8 lanes lie side by side.
void placeSlot(uint slot) {
    uint groupsPerPart = gl_NumWorkGroups.x / dispatch.interleave;
    uint group = gl_WorkGroupID.x % groupsPerPart * dispatch.interleave + gl_WorkGroupID.x / groupsPerPart;
    uint lanes = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    slotIndex[slot] = (lanes >> 3u) * (8u * RAYS) + slot * 8u + (lanes & 7u);
    uvec2 filmPixel = uvec2(dispatch.tileX, dispatch.tileY) + pixelOfSlot(slotIndex[slot]);
    imagePixel[slot] = filmPixel + uvec2(dispatch.cropX, dispatch.cropY);
    filmIndex[slot] = filmPixel.y * dispatch.filmWidth + filmPixel.x;
    isSlotUsed[slot] = slotIndex[slot] < slotCount() && filmPixel.x < dispatch.filmWidth &&
                       filmPixel.y < dispatch.filmHeight;
}

// Goes on with what waits, or else after the `samplesInFilm` samples that the pixel has.
void loadSlot(uint slot, uint samplesInFilm) {
    rayCounts[slot] = uvec4(0u);
    if (isResumable && dispatch.isResumed != 0u && isSlotUsed[slot]) {
        path[slot] = pathRecords[slotIndex[slot]];
        return;
    }
    uint firstSample = dispatch.sampleBegin + samplesInFilm;
    path[slot].stage = isSlotUsed[slot] && firstSample < dispatch.sampleEnd ? stageNextSample : stageDone;
    path[slot].sampleIndex = firstSample + sampleLane(slot);
    path[slot].pendingCount = 0u;
    path[slot].stackSize = 0u;
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
}

void storeSlot(uint slot) {
    if (!isResumable)
        return;
    finishedRayCounts += rayCounts[slot];
    if (isSlotUsed[slot])
        pathRecords[slotIndex[slot]] = path[slot];
}

void addProgress() {
    uint unfinished = 0u;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        unfinished += path[slot].stage != stageDone ? 1u : 0u;
    if (unfinished != 0u)
        atomicAdd(progress.unfinishedSlots, unfinished);
    if (stackOverflowCount != 0u)
        atomicAdd(progress.stackOverflows, stackOverflowCount);
    if (finishedSampleCount != 0u)
        atomicAdd(progress.finishedSamples, finishedSampleCount);
    atomicAdd(progress.primaryRays, finishedRayCounts.x);
    atomicAdd(progress.shadowRays, finishedRayCounts.y);
    if (hasSpecular)
        atomicAdd(progress.reflectionRays, finishedRayCounts.z);
    if (hasDielectric)
        atomicAdd(progress.refractionRays, finishedRayCounts.w);
}

// Keeps what a path did, for those who search for a difference.
void traceEvent(uint slot, uint quantity, uint integer, vec3 value) {
    if (!isTracing || slotIndex[slot] != 0u)
        return;
    uint index = atomicAdd(progress.traceEvents, 1u);
    if (index < dispatch.traceCapacity)
        traceEvents[index] =
            TraceEvent(quantity, path[slot].sampleIndex, path[slot].rayDepth, integer, value, 0u);
}
