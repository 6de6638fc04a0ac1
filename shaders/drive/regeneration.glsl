// Path regeneration: the lanes of a subgroup do not wait for each other's paths to end, but go on to the next sample of
// its block of pixels (Novak et al., "Path Regeneration for Interactive Path Tracing", Eurographics 2010). Finished
// samples wait in a buffer until add_samples.comp adds them to the film, in the order of their indices, so that it does
// not matter which lane computed them.
//
// A row of the buffer is for one pixel and for all indices of the same remainder by `samplesInFlight`.

layout(set = 0, binding = bindingSamples, std430) buffer SampleBuffer { SampleRecord samples[]; };

// Places of a slot's samples among those of the tile: one in each row of its subgroup's.
uint nextPlace[RAYS];
uint endOfPlaces[RAYS];

void beginRegeneration(uint slot) {
    uint subgroup = (blockOfWorkgroup() * gl_NumSubgroups + gl_SubgroupID) * RAYS + slot;
    uint first = subgroup * gl_SubgroupSize * dispatch.samplesPerSlot;
    nextPlace[slot] = first + gl_SubgroupInvocationID;
    endOfPlaces[slot] = min(first + gl_SubgroupSize * dispatch.samplesPerSlot, slotCount());
}

// Whether the sample of a place is still to be done.
bool isOpen(uint slot, uint place) {
    placeSlotAt(slot, place);
    if (!isSlotUsed[slot] || samples[place * recordsPerSample].finished != 0u)
        return false;
    uint first = dispatch.sampleBegin + filmWords[filmIndex[slot] * filmPixelWords + filmSampleCountWord];
    path[slot].sampleIndex = first + (sampleLane(slot) - first & samplesInFlight - 1u);
    return path[slot].sampleIndex < dispatch.sampleEnd;
}

// Begins the next sample of the slot, or ends its work.
void takeTurn(uint slot) {
    if (path[slot].stage != stageNextSample)
        return;
    bool isFound = false;
    while (!isFound && nextPlace[slot] < endOfPlaces[slot]) {
        isFound = isOpen(slot, nextPlace[slot]);
        nextPlace[slot] += gl_SubgroupSize;
        stepsTaken += 1u;
    }
    path[slot].stage = stageDone;
    if (!isFound)
        return;
    rayCounts[slot] = uvec4(0u);
    bounceCounts[slot] = 0u;
    beginSample(slot);
}

// Keeps a finished sample.
void endTurn(uint slot) {
    uint record = slotIndex[slot] * recordsPerSample;
    samples[record] = SampleRecord(path[slot].sampleRadiance, packCounts(rayCounts[slot].yzw, bounceCounts[slot]));
    if (hasAlpha)
        samples[record + 1u].radiance.x = sampleTransparency(slot);
    path[slot].stage = stageNextSample;
}

void integrateRegenerating() {
    shareWork();
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        beginRegeneration(slot);
        stopTraversal(slot);
        path[slot].stage = stageNextSample;
    }
    uint unfinished = 0u;
    bool isRunning;
    do {
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            takeTurn(slot);
        advancePaths();
        stepsTaken += 1u;
        isRunning = false;
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            if (path[slot].stage == stageSampleDone)
                endTurn(slot);
            bool isIdle = path[slot].stage == stageNextSample && nextPlace[slot] >= endOfPlaces[slot];
            bool isLate = path[slot].stage != stageDone && !isIdle && stepsTaken >= dispatch.stepBudget;
            unfinished += isLate ? 1u : 0u;
            path[slot].stage = isLate || isIdle ? stageDone : path[slot].stage;
            isRunning = isRunning || path[slot].stage != stageDone;
        }
    } while (isRunning);
    addWork(unfinished);
}
