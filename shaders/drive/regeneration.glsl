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
    stopTraversal(slot);
    stage[slot] = stageNextSample;
    uint subgroup = (blockOfWorkgroup() * gl_NumSubgroups + gl_SubgroupID) * RAYS + slot;
    uint first = subgroup * gl_SubgroupSize * dispatch.samplesPerSlot;
    nextPlace[slot] = first + gl_SubgroupInvocationID;
    endOfPlaces[slot] = min(first + gl_SubgroupSize * dispatch.samplesPerSlot, pathCount());
}

// Whether the sample of a place is still to be done.
bool isOpen(uint slot, uint place) {
    placeSlotAt(slot, place);
    placePath(slot);
    if (!isSlotUsed[slot] || samples[place * recordsPerSample].finished != 0u)
        return false;
    uint first = dispatch.sampleBegin + filmWords[filmIndex[slot] * filmPixelWords + filmSampleCountWord];
    path.key.sampleIndex = first + (sampleLane(slot) - first & samplesInFlight - 1u);
    return path.key.sampleIndex < dispatch.sampleEnd;
}

// Finds the next sample of a slot that has none, or ends its work. Returns whether it has found one.
bool findSample(uint slot) {
    if (stage[slot] != stageNextSample)
        return false;
    bool isFound = false;
    while (!isFound && nextPlace[slot] < endOfPlaces[slot]) {
        isFound = isOpen(slot, nextPlace[slot]);
        nextPlace[slot] += gl_SubgroupSize;
        stepsTaken += 1u;
    }
    stage[slot] = stageDone;
    return isFound;
}

// Keeps a finished sample.
void keepSample(uint slot) {
    uint record = slotIndex[slot] * recordsPerSample;
    samples[record] = SampleRecord(path.radiance, packCounts(path.rays.yzw, path.bounces));
    if (hasAlpha)
        samples[record + 1u].radiance.x = sampleTransparency();
    stage[slot] = stageNextSample;
}

// After a pass: keeps what is finished, and drops what is not where no steps are left.
void endPass(uint slot) {
    if (stage[slot] == stageSampleDone)
        keepSample(slot);
    bool isIdle = stage[slot] == stageNextSample && nextPlace[slot] >= endOfPlaces[slot];
    bool isLate = stage[slot] != stageDone && !isIdle && !hasStepsLeft();
    unfinishedCount += isLate ? 1u : 0u;
    stage[slot] = isLate || isIdle ? stageDone : stage[slot];
}
