// The film. Samples are added in the order of their indices, whichever slot computed them.
//
// The slots of a pixel share its sums: a slot keeps those whose number leaves its lane when divided by `samplesAbreast`.
// Numbers 0 to 2 are the sums of the channels, 4 to 6 those of squares; 3 and 7 are nobody's.

layout(set = 0, binding = bindingFilm, std430) buffer FilmBuffer { uint filmWords[]; };

const uint filmPixelWords = 16u;
const uint filmSampleCountWord = 3u;
const uint filmRestWords = 4u; // from a sum to its rest
const uint filmSums = 8u;

CompensatedSum filmSum[RAYS][filmSums]; // at each number's multiple of `samplesAbreast`
uint filmSampleCount[RAYS];             // the same in all slots of a pixel

uint filmWord(uint slot, uint number) {
    return (isSlotUsed[slot] ? filmIndex[slot] : 0u) * filmPixelWords + number + (number & 4u);
}

// Loads the slot's sums; those of another pixel, if it is not used.
void loadFilm(uint slot) {
    filmSampleCount[slot] = filmWords[filmWord(slot, filmSampleCountWord)];
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesAbreast) {
        uint word = filmWord(slot, first + sampleLane(slot));
        filmSum[slot][first] =
            CompensatedSum(uintBitsToFloat(filmWords[word]), uintBitsToFloat(filmWords[word + filmRestWords]));
    }
}

void storeFilm(uint slot) {
    if (!isSlotUsed[slot])
        return;
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesAbreast) {
        uint number = first + sampleLane(slot);
        bool isSum = (number & 3u) != 3u;
        uint other = number == filmSampleCountWord ? filmSampleCount[slot] : 0u;
        uint word = filmWord(slot, number);
        filmWords[word] = isSum ? floatBitsToUint(filmSum[slot][first].value) : other;
        filmWords[word + filmRestWords] = isSum ? floatBitsToUint(filmSum[slot][first].rest) : 0u;
    }
}

// Adds the radiances of the samples abreast. Slots without a sample add 0, which changes no bit.
void addRadiances(uint slot) {
    uint red[maxSamplesAbreast];
    uint green[maxSamplesAbreast];
    uint blue[maxSamplesAbreast];
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.x), red);
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.y), green);
    exchangeAbreast(floatBitsToUint(path[slot].sampleRadiance.z), blue);
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesAbreast) {
        uint number = first + sampleLane(slot);
        uint channel = number & 3u;
        [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane) {
            uint bits = channel == 0u ? red[lane] : channel == 1u ? green[lane] : blue[lane];
            float radiance = withoutSubnormals(uintBitsToFloat(bits));
            float added = number < 4u ? radiance : withoutSubnormals(radiance * radiance);
            filmSum[slot][first] = plus(filmSum[slot][first], added);
        }
    }
}

// Ends the round if the samples of all slots of the pixel are finished.
void addRoundToFilm(uint slot) {
    if (!isTrueForAllAbreast(path[slot].stage == stageSampleDone))
        return;
    uint first = path[slot].sampleIndex - sampleLane(slot);
    addRadiances(slot);
    filmSampleCount[slot] += min(samplesAbreast, dispatch.sampleEnd - first);
    if (path[slot].sampleIndex < dispatch.sampleEnd)
        finishedSampleCount += 1u;
    finishedRayCounts += rayCounts[slot];
    rayCounts[slot] = uvec4(0u);
    finishedBounceCount += bounceCounts[slot];
    bounceCounts[slot] = 0u;
    path[slot].sampleIndex += samplesAbreast;
    path[slot].stage = first + samplesAbreast < dispatch.sampleEnd ? stageNextSample : stageDone;
}
