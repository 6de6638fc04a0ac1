// The film, and how samples come there: in the order of their indices, whichever slots they come from.

#if SKIP_LIST
layout(set = 0, binding = bindingFilm, rgba32ui) uniform restrict uimageBuffer filmTexels;

FilmPixel loadFilmPixel(uint index) {
    uvec4 a = imageLoad(filmTexels, int(index) * 2);
    uvec4 b = imageLoad(filmTexels, int(index) * 2 + 1);
    return FilmPixel(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w));
}

void storeFilmPixel(uint index, FilmPixel pixel) {
    imageStore(filmTexels, int(index) * 2, uvec4(floatBitsToUint(pixel.sum), pixel.sampleCount));
    imageStore(filmTexels, int(index) * 2 + 1, uvec4(floatBitsToUint(pixel.sumOfSquares), floatBitsToUint(pixel.pad0)));
}

// What the slot at this place among the samples abreast holds.
vec3 radianceOfSample(uint slot, uint lane) {
    return subgroupShuffle(path[slot].sampleRadiance, (gl_SubgroupInvocationID & ~(samplesAbreast - 1u)) + lane);
}

bool isTrueForAllAbreast(bool value) {
    uint all = value ? 1u : 0u;
    all &= samplesAbreast > 1u ? subgroupShuffleXor(all, 1u) : 1u;
    all &= samplesAbreast > 2u ? subgroupShuffleXor(all, 2u) : 1u;
    all &= samplesAbreast > 4u ? subgroupShuffleXor(all, 4u) : 1u;
    return all != 0u;
}
#else
layout(set = 0, binding = bindingFilm, std430) buffer FilmBuffer { FilmPixel filmPixels[]; };

FilmPixel loadFilmPixel(uint index) { return filmPixels[index]; }

void storeFilmPixel(uint index, FilmPixel pixel) { filmPixels[index] = pixel; }

vec3 radianceOfSample(uint slot, uint lane) { return path[slot].sampleRadiance; }

bool isTrueForAllAbreast(bool value) { return value; }
#endif

FilmPixel film[RAYS]; // the same in all slots of a pixel

void loadFilm(uint slot) {
    film[slot] = FilmPixel(vec3(0.0), 0u, vec3(0.0), 0.0);
    if (isSlotUsed[slot])
        film[slot] = loadFilmPixel(filmIndex[slot]);
}

void storeFilm(uint slot) {
    if (isSlotUsed[slot] && sampleLane(slot) == 0u)
        storeFilmPixel(filmIndex[slot], film[slot]);
}

// Ends a round, if the samples of all slots of the pixel are finished.
void addRoundToFilm(uint slot) {
    if (!isTrueForAllAbreast(path[slot].stage == stageSampleDone))
        return;
    uint first = path[slot].sampleIndex - sampleLane(slot);
    [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane) {
        vec3 radiance = radianceOfSample(slot, lane);
        if (first + lane < dispatch.sampleEnd) {
            film[slot].sum = add(film[slot].sum, radiance);
            film[slot].sumOfSquares = addProduct(film[slot].sumOfSquares, radiance, radiance);
            film[slot].sampleCount += 1u;
        }
    }
    if (path[slot].sampleIndex < dispatch.sampleEnd)
        finishedSampleCount += 1u;
    finishedRayCounts += rayCounts[slot];
    rayCounts[slot] = uvec4(0u);
    path[slot].sampleIndex += samplesAbreast;
    path[slot].stage = first + samplesAbreast < dispatch.sampleEnd ? stageNextSample : stageDone;
}
