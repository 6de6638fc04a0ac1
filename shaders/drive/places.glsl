// The places of path slots in the image, and what their finished samples have in common.

uint slotIndex[RAYS];   // among the slots of the tile
uvec2 imagePixel[RAYS]; // of the whole image
uint filmIndex[RAYS];
bool isSlotUsed[RAYS];  // a tile may reach beyond the film, and a film have places without a pixel

const uint filmPixelWords = 16u;
const uint recordsPerSample = hasAlpha ? 2u : 1u; // SampleRecord

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
    bool isInFilm = index < pathCount() && filmPixel.x < dispatch.filmWidth && filmPixel.y < dispatch.filmHeight;
    bool isGathered = isInFilm && dispatch.isGathered != 0u;
    uint word = isGathered ? dispatch.filmWidth * dispatch.filmHeight * filmPixelWords + filmIndex[slot] : 0u;
    // Once for each sample: lavapipe passes over a loop that no lane enters, where it would pay for both arms of an
    // `if`. In other kernels, that load once, a loop makes it keep paths in memory, and they take three times as long.
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
