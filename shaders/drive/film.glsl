// The film. Samples are added in the order of their indices, whichever slot computed them.
//
// The slots of a pixel share its sums: the slot at lane L of a pixel keeps the sums n with n mod samplesInFlight = L.
// Numbers 0 to 2 are the sums of the channels, 4 to 6 those of squares; 3 is the count of samples, 7 the sum of
// transparency. Of features, 4 to 7 are normals and depths.
//
// A film that tallies has counts of samples by their numbers instead (layout.h), which stay in the buffer.

//
// The sums of layers of light are shared likewise: number 3 p + c is that of channel c of plane p.

layout(set = 0, binding = bindingLight, std430) buffer LightBuffer { float lightWords[]; };

const uint filmSampleCountWord = 3u;
const uint filmRestWords = 4u; // from a sum to its rest
const uint filmSums = 8u;
const uint transparencySum = 7u;
const bool hasTransparencySum = hasAlpha || showsFeatures;

const uint lightSums = 3u * lightPlanes;

CompensatedSum filmSum[RAYS][filmSums]; // at each number's multiple of `samplesInFlight`
uint filmSampleCount[RAYS];             // the same in all slots of a pixel
CompensatedSum lightSum[RAYS][3u * lightPlanesOrOne]; // at each number's multiple of `samplesInFlight`

// The slot's pixel of the film; another one, if it is not used.
uint filmPlace(uint slot) { return isSlotUsed[slot] ? filmIndex[slot] : 0u; }

// The word of a sum in the film.
uint filmWord(uint slot, uint number) {
    return filmPlace(slot) * filmPixelWords + number + (number & 4u);
}

// Counts a sample of the pixel by its number: see tallyPairs. Lanes that do not take part change nothing.
void tallySample(uint slot, uint number, bool takesPart) {
    uint firstWord = filmIndex[slot] * filmPixelWords;
    uint pair = tallyOthers;
    [[unroll]] for (int other = int(tallyPairs) - 1; other >= 0; --other) {
        uint there = takesPart && other != int(tallyOthers) ? filmWords[firstWord + 2u * uint(other)] : 1u;
        pair = other != int(tallyOthers) && (there == number || there == 0u) ? uint(other) : pair;
    }
    if (!takesPart || number == 0u)
        return;
    uint word = firstWord + 2u * pair;
    if (pair != tallyOthers)
        filmWords[word] = number;
    filmWords[word + (pair == tallyOthers ? 0u : 1u)] += 1u;
}

// Counts the samples in flight, in their order; the slot of the first one does it for all of them.
void tallySamples(uint slot) {
    uint numbers[maxSamplesInFlight];
    exchangeInPixel(uint(path.radiance.x), numbers);
    [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane)
        tallySample(slot, numbers[lane], isSlotUsed[slot] && sampleLane(slot) == 0u);
}

// Words are loaded and stored one by one on lavapipe, so that no slot touches more than it has to: there are no rests
// before the first sample.
void loadFilm(uint slot) {
    if (tallies) {
        filmSampleCount[slot] = filmWords[filmWord(slot, filmSampleCountWord)];
        return;
    }
    const uint laneOfCount = filmSampleCountWord & samplesInFlight - 1u;
    uint count = 0u;
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesInFlight) {
        uint value = filmWords[filmWord(slot, first + sampleLane(slot))];
        filmSum[slot][first] = CompensatedSum(uintBitsToFloat(value), 0.0);
        count = first + laneOfCount == filmSampleCountWord ? value : count;
    }
    uint counts[maxSamplesInFlight];
    exchangeInPixel(count, counts);
    filmSampleCount[slot] = counts[laneOfCount];
    if (filmSampleCount[slot] != 0u)
        [[unroll]] for (uint first = 0u; first < filmSums; first += samplesInFlight)
            filmSum[slot][first].rest =
                uintBitsToFloat(filmWords[filmWord(slot, first + sampleLane(slot)) + filmRestWords]);
}

void storeFilm(uint slot) {
    if (tallies) {
        if (isSlotUsed[slot] && sampleLane(slot) == 0u)
            filmWords[filmWord(slot, filmSampleCountWord)] = filmSampleCount[slot];
        return;
    }
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesInFlight) {
        uint number = first + sampleLane(slot);
        uint word = filmWord(slot, number);
        bool isCount = number == filmSampleCountWord;
        bool isKept = isSlotUsed[slot] && (hasTransparencySum || number != transparencySum);
        if (isKept)
            filmWords[word] = isCount ? filmSampleCount[slot] : floatBitsToUint(filmSum[slot][first].value);
        if (isKept && !isCount)
            filmWords[word + filmRestWords] = floatBitsToUint(filmSum[slot][first].rest);
    }
}

// The word of a sum of light in the film, whose rest is `lightSums` behind; the last one for numbers beyond it.
uint lightWord(uint slot, uint number) {
    return filmPlace(slot) * 2u * lightSums + min(number, lightSums - 1u);
}

void loadLightSums(uint slot) {
    if (!hasLightPlanes)
        return;
    [[unroll]] for (uint first = 0u; first < lightSums; first += samplesInFlight) {
        uint word = lightWord(slot, first + sampleLane(slot));
        lightSum[slot][first] = CompensatedSum(lightWords[word], lightWords[word + lightSums]);
    }
}

void storeLightSums(uint slot) {
    if (!hasLightPlanes)
        return;
    [[unroll]] for (uint first = 0u; first < lightSums; first += samplesInFlight) {
        uint number = first + sampleLane(slot);
        uint word = lightWord(slot, number);
        if (isSlotUsed[slot] && number < lightSums) {
            lightWords[word] = lightSum[slot][first].value;
            lightWords[word + lightSums] = lightSum[slot][first].rest;
        }
    }
}

// Adds the light of the samples in flight: each slot those sums that it keeps.
void addLightSums(uint slot) {
    vec3 planes[lightPlanesOrOne];
    planesOfSample(planes);
    [[unroll]] for (uint first = 0u; first < lightSums; first += samplesInFlight) {
        uint own[maxSamplesInFlight];
        [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane) {
            uint number = min(first + lane, lightSums - 1u);
            uint found[maxSamplesInFlight];
            exchangeInPixel(floatBitsToUint(planes[number / 3u][number % 3u]), found);
            [[unroll]] for (uint other = 0u; other < samplesInFlight; ++other)
                own[other] = sampleLane(slot) == lane ? found[other] : own[other];
        }
        [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane)
            lightSum[slot][first] = plus(lightSum[slot][first], withoutSubnormals(uintBitsToFloat(own[lane])));
    }
}

// Adds the samples in flight. Slots without a sample add 0, which changes no bit.
void addSamples(uint slot) {
    if (tallies) {
        tallySamples(slot);
        return;
    }
    uint red[maxSamplesInFlight];
    uint green[maxSamplesInFlight];
    uint blue[maxSamplesInFlight];
    uint clear[maxSamplesInFlight];
    vec3 colour = showsCost ? traversal[slot].work : path.radiance;
    exchangeInPixel(floatBitsToUint(colour.x), red);
    exchangeInPixel(floatBitsToUint(colour.y), green);
    exchangeInPixel(floatBitsToUint(colour.z), blue);
    if (hasTransparencySum)
        exchangeInPixel(floatBitsToUint(showsFeatures ? path.scatterPdf : sampleTransparency()), clear);
    uint normalX[maxSamplesInFlight];
    uint normalY[maxSamplesInFlight];
    uint normalZ[maxSamplesInFlight];
    if (showsFeatures) {
        exchangeInPixel(floatBitsToUint(path.lightWeight.x), normalX);
        exchangeInPixel(floatBitsToUint(path.lightWeight.y), normalY);
        exchangeInPixel(floatBitsToUint(path.lightWeight.z), normalZ);
    }
    [[unroll]] for (uint first = 0u; first < filmSums; first += samplesInFlight) {
        uint number = first + sampleLane(slot);
        uint channel = number & 3u;
        [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane) {
            uint bits = channel == 0u ? red[lane] : channel == 1u ? green[lane] : blue[lane];
            float radiance = withoutSubnormals(uintBitsToFloat(bits));
            float added = number < 4u ? radiance : withoutSubnormals(radiance * radiance);
            if (showsFeatures) {
                uint normal = channel == 0u ? normalX[lane] : channel == 1u ? normalY[lane] : normalZ[lane];
                added = number < 4u ? radiance : uintBitsToFloat(normal);
            }
            if (hasTransparencySum)
                added = number == transparencySum ? uintBitsToFloat(clear[lane]) : added;
            filmSum[slot][first] = plus(filmSum[slot][first], added);
        }
    }
}

// Ends the round if the samples of all slots of the pixel are finished.
void addRoundToFilm(uint slot) {
    if (!isTrueForAllOfPixel(stage[slot] == stageSampleDone))
        return;
    uint first = path.key.sampleIndex - sampleLane(slot);
    addSamples(slot);
    if (hasLightPlanes)
        addLightSums(slot);
    filmSampleCount[slot] += min(samplesInFlight, dispatch.sampleEnd - first);
    if (path.key.sampleIndex < dispatch.sampleEnd)
        finishedSampleCount += 1u;
    finishedRayCounts += path.rays;
    path.rays = uvec4(0u);
    finishedBounceCount += path.bounces;
    path.bounces = 0u;
    path.key.sampleIndex += samplesInFlight;
    stage[slot] = first + samplesInFlight < dispatch.sampleEnd ? stageNextSample : stageDone;
}
