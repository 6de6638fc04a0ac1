// The drive of GPUs: a lane that has its answer goes on with whatever its path asks for next. Rays of both kinds are
// traced together, by one traversal, so that no lane waits for the shadow rays of others.
#if RAYS != 1 || LANES_SHUFFLE
#error "a lane has one path, and waits for no other"
#endif

// Runs the sample to its end, or until no steps are left; one pass at least, so that each dispatch gets on.
void advancePaths() {
    const uint slot = 0u;
    do {
        beginPath(slot);
        bool isVisibility = stage[slot] == stageShadow;
        traversal[slot].key = keyOfRay(isVisibility ? 1u : 0u);
        if (hasTriangles)
            advance(bool[RAYS](true), isVisibility);
        if (isThere(slot, stageNearest))
            answerNearest(slot);
        if (sendsShadowRays) {
            takeTurn(slot);
            if (isThere(slot, stageShadow))
                answerVisibility(slot);
        }
        endStage();
        stepsTaken += stepsOfTurn();
    } while (stage[slot] <= stageShadow && hasStepsLeft());
}
