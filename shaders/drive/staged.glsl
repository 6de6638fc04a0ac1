// The drive of devices that compute on a CPU, where a subgroup pays for everything that any of its lanes does: all slots
// of a subgroup that are in the same stage do its work together, and rays of one kind are traced at a time. An integrator
// says by three constants what its paths do: `hasChains`, after a nearest hit they may ask for another one right away;
// `sendsShadowRays`; and `goesOn`, after these they may ask for more.

// Traces the rays of all slots in a stage.
void trace(const uint traced, const bool isVisibility) {
    if (!hasTriangles)
        return;
    bool takesPart[RAYS];
    EACH_RAY(slot, takesPart[slot] = stage[slot] == traced;)
    EACH_PATH(slot, traversal[slot].key = keyOfRay(isVisibility ? 1u : 0u);)
    advance(takesPart, isVisibility);
}

// Traces the rays whose nearest hits are wanted.
void followPaths() {
    EACH_PATH(slot, beginPath(slot);)
    trace(stageNearest, false);
    EACH_PATH(slot, if (isThere(slot, stageNearest)) answerNearest(slot);)
    endStage();
}

// Gives paths that are at a vertex their turn, and traces their shadow rays.
void lightVertices() {
    EACH_PATH(slot, takeTurn(slot);)
    trace(stageShadow, true);
    EACH_PATH(slot, if (isThere(slot, stageShadow)) answerVisibility(slot);)
    endStage();
}

// Runs samples to their end, or until no steps are left; regenerating: one pass.
void advancePaths() {
    do {
        do
            followPaths();
        while (hasChains && !regeneratesPaths && isAnyUpTo(stageNearest) && hasStepsLeft());
        if (sendsShadowRays)
            lightVertices();
        stepsTaken += 1u + stepsOfTurn();
    } while (goesOn && !regeneratesPaths && isAnyUpTo(stageShadow) && hasStepsLeft());
}
