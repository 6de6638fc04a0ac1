// The path slots of an invocation: where they are in the image, how they wait between dispatches, what they count.

const float unbounded = 3.4028234e38; // length of a ray that has met nothing

PathRecord path[RAYS];
FilmPixel film[RAYS];
uint slotIndex[RAYS]; // among the slots of the tile
uvec2 imagePixel[RAYS]; // of the whole image
uint filmIndex[RAYS];
bool isSlotUsed[RAYS]; // a tile may reach beyond the film

uint stepsTaken = 0u;         // loop iterations of this dispatch
uint stackOverflowCount = 0u;
uint finishedSampleCount = 0u;
uvec4 rayCounts = uvec4(0u);   // primary, shadow, reflection, refraction

uint slotCount() { return dispatch.tileWidth * dispatch.tileHeight; }

// Neighbouring slots are neighbouring pixels: 8 lanes cover 4x2 pixels, 64 cover 8x8, as coherent rays take the same
// way through the tree. With several slots an invocation, the slots of 8 lanes lie side by side.
uvec2 pixelOfSlot(uint index) {
    uint block = index >> 6u;
    uint k = index & 63u;
    uint blocksAcross = dispatch.tileWidth >> 3u;
    uvec2 inBlock = uvec2((k & 3u) | ((k >> 1u) & 4u), ((k >> 2u) & 1u) | ((k >> 3u) & 6u));
    return uvec2(block % blocksAcross, block / blocksAcross) * 8u + inBlock;
}

void loadSlot(uint slot) {
    uint groupsPerPart = gl_NumWorkGroups.x / dispatch.interleave;
    uint group = gl_WorkGroupID.x % groupsPerPart * dispatch.interleave + gl_WorkGroupID.x / groupsPerPart;
    uint lanes = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    slotIndex[slot] = (lanes >> 3u) * (8u * RAYS) + slot * 8u + (lanes & 7u);
    uvec2 filmPixel = uvec2(dispatch.tileX, dispatch.tileY) + pixelOfSlot(slotIndex[slot]);
    imagePixel[slot] = filmPixel + uvec2(dispatch.cropX, dispatch.cropY);
    filmIndex[slot] = filmPixel.y * dispatch.filmWidth + filmPixel.x;
    isSlotUsed[slot] = slotIndex[slot] < slotCount() && filmPixel.x < dispatch.filmWidth &&
                       filmPixel.y < dispatch.filmHeight;
    path[slot].stage = stageDone;
    if (!isSlotUsed[slot])
        return;
    film[slot] = filmPixels[filmIndex[slot]];
    if (dispatch.isResumed != 0u) {
        path[slot] = pathRecords[slotIndex[slot]];
        return;
    }
    path[slot].stage = stageNextRay;
    path[slot].rayDepth = 0u;
    path[slot].pendingCount = 0u;
    path[slot].sampleIndex = dispatch.sampleBegin;
    path[slot].stackSize = 0u;
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
}

void storeSlot(uint slot) {
    if (!isSlotUsed[slot])
        return;
    filmPixels[filmIndex[slot]] = film[slot];
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
    atomicAdd(progress.primaryRays, rayCounts.x);
    atomicAdd(progress.shadowRays, rayCounts.y);
    if (hasSpecular)
        atomicAdd(progress.reflectionRays, rayCounts.z);
    if (hasDielectric)
        atomicAdd(progress.refractionRays, rayCounts.w);
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
