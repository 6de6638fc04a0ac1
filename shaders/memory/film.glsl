// The film. Samples are added in the order of their indices, whichever slot computed them.

#if LANES_SHUFFLE
layout(set = 0, binding = bindingFilm, std430) buffer FilmBuffer { uint filmWords[]; };

const uint filmPixelWords = 16u;
const uint filmSampleCountWord = 3u;

// The slots of a pixel share the loads and stores of its words, because lavapipe makes them lane by lane and word by
// word. Unless `isUsed`, nothing is stored, and the words of another pixel are loaded.
FilmPixel loadFilmPixel(uint index, bool isUsed) {
    uint words[filmPixelWords];
    [[unroll]] for (uint begin = 0u; begin < filmPixelWords; begin += samplesAbreast) {
        uint values[maxSamplesAbreast];
        exchangeAbreast(filmWords[(isUsed ? index : 0u) * filmPixelWords + begin + laneAbreast()], values);
        [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane)
            words[begin + lane] = values[lane];
    }
    return FilmPixel(uintBitsToFloat(uvec3(words[0], words[1], words[2])), words[3],
                     uintBitsToFloat(uvec3(words[4], words[5], words[6])), 0.0,
                     uintBitsToFloat(uvec3(words[8], words[9], words[10])), 0.0,
                     uintBitsToFloat(uvec3(words[12], words[13], words[14])), 0.0);
}

void storeFilmPixel(uint index, bool isUsed, FilmPixel pixel) {
    uvec3 sum = floatBitsToUint(pixel.sum);
    uvec3 sumRest = floatBitsToUint(pixel.sumRest);
    uvec3 squares = floatBitsToUint(pixel.sumOfSquares);
    uvec3 squaresRest = floatBitsToUint(pixel.squaresRest);
    uint words[filmPixelWords] =
        uint[](sum.x, sum.y, sum.z, pixel.sampleCount, sumRest.x, sumRest.y, sumRest.z, 0u, squares.x, squares.y,
               squares.z, 0u, squaresRest.x, squaresRest.y, squaresRest.z, 0u);
    [[unroll]] for (uint begin = 0u; begin < filmPixelWords; begin += samplesAbreast) {
        uint mine = words[begin];
        [[unroll]] for (uint lane = 1u; lane < samplesAbreast; ++lane)
            mine = laneAbreast() == lane ? words[begin + lane] : mine;
        if (isUsed)
            filmWords[index * filmPixelWords + begin + laneAbreast()] = mine;
    }
}

// The radiances of the samples abreast, in order.
void exchangeRadiances(uint slot, out vec3 radiances[maxSamplesAbreast]) {
    uint red[maxSamplesAbreast];
    uint green[maxSamplesAbreast];
    uint blue[maxSamplesAbreast];
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.x), red);
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.y), green);
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.z), blue);
    [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane)
        radiances[lane] = uintBitsToFloat(uvec3(red[lane], green[lane], blue[lane]));
}
#else
layout(set = 0, binding = bindingFilm, std430) buffer FilmBuffer { FilmPixel filmPixels[]; };

FilmPixel loadFilmPixel(uint index, bool isUsed) { return filmPixels[isUsed ? index : 0u]; }

void storeFilmPixel(uint index, bool isUsed, FilmPixel pixel) {
    if (isUsed)
        filmPixels[index] = pixel;
}

const uint maxSamplesAbreast = 1u;

void exchangeRadiances(uint slot, out vec3 radiances[maxSamplesAbreast]) { radiances[0] = path[slot].sampleRadiance; }
#endif

FilmPixel film[RAYS]; // the same in all slots of a pixel

void loadFilm(uint slot) { film[slot] = loadFilmPixel(filmIndex[slot], isSlotUsed[slot]); }

void storeFilm(uint slot) { storeFilmPixel(filmIndex[slot], isSlotUsed[slot], film[slot]); }

// Ends the round if the samples of all slots of the pixel are finished.
void addRoundToFilm(uint slot) {
    if (!isTrueForAllAbreast(path[slot].stage == stageSampleDone))
        return;
    uint first = path[slot].sampleIndex - sampleLane(slot);
    vec3 radiances[maxSamplesAbreast];
    exchangeRadiances(slot, radiances);
    // Slots without a sample add 0, which changes no bit.
    [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane)
        film[slot] = withSample(film[slot], radiances[lane]);
    film[slot].sampleCount += min(samplesAbreast, dispatch.sampleEnd - first);
    if (path[slot].sampleIndex < dispatch.sampleEnd)
        finishedSampleCount += 1u;
    finishedRayCounts += rayCounts[slot];
    rayCounts[slot] = uvec4(0u);
    finishedBounceCount += bounceCounts[slot];
    bounceCounts[slot] = 0u;
    path[slot].sampleIndex += samplesAbreast;
    path[slot].stage = first + samplesAbreast < dispatch.sampleEnd ? stageNextSample : stageDone;
}
