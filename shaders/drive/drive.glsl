// The loop of all integrators: samples begin, their rays are traced, surfaces are lit, and rounds go into the film.
//
// All slots of a subgroup that are in the same stage do its work together; a stage skips the slots that are in another
// one. An integrator defines what happens at each stage:

void beginSample(uint slot);  // stageNextSample: the primary ray
void shadeHit(uint slot);     // stageClosest: the nearest hit is known
void sampleDirectLight(uint slot);   // stageNextLight: on a surface, choose a light
void addLight(uint slot);     // stageShadow: the shadow ray has arrived, or was stopped
void advancePaths();          // runs samples to their end, or until the budget is spent; regenerating: one pass

// The work of a pass without its traversals, in traversal steps, by the times of both on lavapipe.
const uint workPerPass = 32u + sphereCount;

// Traces the rays that are ready, and shades their hits.
void traceRays() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNewRay)
            beginClosest(slot);
    if (hasTriangles)
        traverse(stageClosest, false);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageClosest && !isTraversing(slot)) {
            if (originsMeetGlass() && path[slot].rayDepth == 0u)
                passOnWay(slot);
            else
                shadeHit(slot);
        }
    stepsTaken += 1u;
    passWork += workPerPass;
}

// Lights the surfaces that paths are on.
void lightSurfaces() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNextLight)
            sampleDirectLight(slot);
    if (hasTriangles)
        traverse(stageShadow, true);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageShadow && !isTraversing(slot))
            addLight(slot);
    stepsTaken += 1u;
    passWork += workPerPass;
}

#if LANES_SHUFFLE
#include "shaders/drive/regeneration.glsl"
#endif

void integrate() {
    loadConstants();
    preload();
#if LANES_SHUFFLE
    if (regeneratesPaths) {
        integrateRegenerating();
        return;
    }
#endif
    shareWork();
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        placeSlot(slot);
        loadFilm(slot);
        loadLightSums(slot);
        loadSlot(slot, filmSampleCount[slot]);
        loadLight(slot);
    }
    // The same for all lanes that share a pixel.
    bool isOutOfSteps = false;
    do {
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            if (path[slot].stage == stageNextSample)
                beginSample(slot);
        advancePaths();
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            addRoundToFilm(slot);
        stepsTaken += 1u;
        isOutOfSteps = !isTrueForAllOfPixel(stepsTaken < dispatch.stepBudget);
    } while (isUnfinished() && !isOutOfSteps);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        storeFilm(slot);
        storeLightSums(slot);
        storeSlot(slot);
        storeLight(slot);
    }
    addProgress();
}
