// What all integrators do: samples begin, their rays are traced, surfaces are lit, and rounds go into the film.
//
// Stages follow each other so that all slots of a subgroup that are about the same work do it together; each stage
// does nothing for slots that are elsewhere. An integrator says what happens at its stages:

void beginSample(uint slot);  // stageNextSample: the primary ray
void shadeHit(uint slot);     // stageClosest: the nearest hit is known
void aimAtLight(uint slot);   // stageNextLight: on a surface that is to be lit
void addLight(uint slot);     // stageShadow: the shadow ray has arrived, or was stopped
void advancePaths();          // runs samples to their end, or until the step budget is spent

// What a pass does beside traversals, in steps of one: by the time that both take on lavapipe.
const uint workPerPass = 32u + sphereCount;

// Traces the rays that are ready, and shades what they meet.
void traceRays() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNewRay)
            beginClosest(slot);
    if (hasTriangles)
        traverse(stageClosest, false);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageClosest && !isTraversing(slot))
            shadeHit(slot);
    stepsTaken += 1u + sphereIterations;
    passWork += workPerPass;
}

// Lights the surfaces where paths stand.
void lightSurfaces() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNextLight)
            aimAtLight(slot);
    if (hasTriangles)
        traverse(stageShadow, true);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageShadow && !isTraversing(slot))
            addLight(slot);
    stepsTaken += 1u + sphereIterations;
    passWork += workPerPass;
}

void integrate() {
    loadConstants();
    preload();
    shareWork();
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        placeSlot(slot);
        loadFilm(slot);
        loadSlot(slot, film[slot].sampleCount);
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
        isOutOfSteps = !isTrueForAllAbreast(stepsTaken < dispatch.stepBudget);
    } while (isUnfinished() && !isOutOfSteps);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        storeFilm(slot);
        storeSlot(slot);
    }
    addProgress();
}
