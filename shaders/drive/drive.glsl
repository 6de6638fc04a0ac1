// The loop of all kernels that render: samples begin, their requests are answered, and rounds go into the film.
//
// A slot works on every `samplesInFlight`-th sample of one pixel; neighbouring slots take the samples in between. Rays
// of one pixel are coherent. plain.glsl and staged.glsl say in what order requests are answered.

#include "shaders/drive/slots.glsl"
#include "shaders/drive/film.glsl"
#include "shaders/drive/waiting_paths.glsl"

// The work of a pass without its traversals, in traversal steps, by the times of both on lavapipe.
const uint workPerPass = 32u + sphereCount;

void take(uint slot) {
    stage[slot] = request.kind;
    traversal[slot].ray = request.ray;
}

// Slots without a sample add nothing to the film.
void beginSample(uint slot) {
    path.rays = uvec4(0u);
    path.bounces = 0u;
    traversal[slot].work = vec3(0.0);
    begin();
    take(slot);
    bool hasSample = path.key.sampleIndex < dispatch.sampleEnd;
    stage[slot] = hasSample ? stage[slot] : stageSampleDone;
    path.rays.x = hasSample ? path.rays.x : 0u;
}

Answer answerFor(uint slot) {
    request.ray = traversal[slot].ray;
    return Answer(traversal[slot].hit, traversal[slot].isDimmed);
}

void answerNearest(uint slot) {
    nextAfterNearest(answerFor(slot));
    take(slot);
}

void answerTurn(uint slot) {
    nextAtVertex(answerFor(slot));
    take(slot);
}

void answerVisibility(uint slot) {
    nextAfterVisibility(answerFor(slot));
    take(slot);
}

RayKey keyOfRay(uint isVisibility) {
    return RayKey(path.key.pixel, path.key.sampleIndex, 2u * path.key.depth + isVisibility);
}

#if SPLITS_RAYS
void resumePath(uint slot) {
    resume();
    take(slot);
}
#endif

void beginPath(uint slot) {
#if SPLITS_RAYS
    if (stage[slot] == stageResume)
        resumePath(slot);
#endif
    if (stage[slot] != stageNewRay)
        return;
    traceEvent(traceRayOrigin, 0u, traversal[slot].ray.origin);
    traceEvent(traceRayDirection, 0u, traversal[slot].ray.direction);
    beginNearest(slot);
    stage[slot] = stageNearest;
}

void takeTurn(uint slot) {
    if (stage[slot] == stageTurn)
        answerTurn(slot);
    if (stage[slot] != stageNewShadow)
        return;
    beginVisibility(slot);
    stage[slot] = stageShadow;
}

bool isThere(uint slot, uint traced) { return stage[slot] == traced && !isTraversing(slot); }

void endStage() {
    stepsTaken += 1u;
    passWork += workPerPass;
}

bool isAnyUpTo(uint last) {
    bool isAny = false;
    EACH_RAY(slot, isAny = isAny || stage[slot] <= last;)
    return isAny;
}

#if DRIVE_PLAIN
#include "shaders/drive/plain.glsl"
#else
#include "shaders/drive/staged.glsl"
#endif

// A slot's own samples, whose film it shares with those of its pixel.

void loadPixel(uint slot) {
    placeSlot(slot);
    placePath(slot);
    loadFilm(slot);
    loadLightSums(slot);
    loadSlot(slot, filmSampleCount[slot]);
    loadLight(slot);
}

void storePixel(uint slot) {
    storeFilm(slot);
    storeLightSums(slot);
    storeSlot(slot);
    storeLight(slot);
}

#if LANES_SHUFFLE
#include "shaders/drive/regeneration.glsl"
#else
void beginRegeneration(uint slot) {}
bool findSample(uint slot) { return false; }
void endPass(uint slot) {}
#endif

void load(uint slot) {
    if (regeneratesPaths)
        beginRegeneration(slot);
    else
        loadPixel(slot);
}

void beginNext(uint slot) {
    bool isNext = regeneratesPaths ? findSample(slot) : stage[slot] == stageNextSample;
    if (isNext)
        beginSample(slot);
}

void endRound(uint slot) {
    if (regeneratesPaths)
        endPass(slot);
    else
        addRoundToFilm(slot);
}

void integrate() {
    loadConstants();
    preload();
    shareWork();
    EACH_PATH(slot, load(slot);)
    // The same for all lanes that share a pixel.
    bool isOutOfSteps = false;
    do {
        EACH_PATH(slot, beginNext(slot);)
        advancePaths();
        stepsTaken += 1u;
        EACH_PATH(slot, endRound(slot);)
        if (!regeneratesPaths)
            isOutOfSteps = !isTrueForAllOfPixel(hasStepsLeft());
    } while (isAnyUpTo(stageSampleDone) && !isOutOfSteps);
    if (regeneratesPaths) {
        addWork(unfinishedCount);
        return;
    }
    EACH_PATH(slot, storePixel(slot);)
    addProgress();
}
