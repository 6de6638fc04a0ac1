// The path slots of an invocation, and what they count.
#include "shaders/drive/lanes.glsl"
#include "shaders/drive/places.glsl"
#include "shaders/drive/stages.glsl"

uint stage[RAYS];

uint unfinishedCount = 0u; // slots that have given up their samples
uint finishedSampleCount = 0u;
uvec4 finishedRayCounts = uvec4(0u); // of samples in the film: primary, shadow, reflection, refraction
uint finishedBounceCount = 0u;

// A statement for each slot, whose path is `path` meanwhile.
#if RAYS == 1
#define EACH_PATH(slot, statement) { const uint slot = 0u; statement }
#else
#define EACH_PATH(slot, statement) \
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) { \
        activePath = slot; \
        statement \
    }
#endif

// Tells the path of a slot where it is.
void placePath(uint slot) {
    path.key.index = slotIndex[slot];
    path.key.pixel = imagePixel[slot];
    traversal[slot].stackIndex = slotIndex[slot];
}

// Leaves the slots one pass if others have spent the work budget of the dispatch.
void shareWork() {
    stepsForfeited = progress.workDone >= dispatch.workBudget ? dispatch.stepBudget : 0u;
    stepsTaken = stepsForfeited;
}

// Adds what slots left unfinished, and the work of the dispatch.
void addWork(uint unfinished) {
    unfinished = sumOfLanes(unfinished);
    uint work = maxOfLanes(stepsTaken - stepsForfeited + passWork);
    if (!subgroupElected())
        return;
    atomicAdd(progress.workDone, work);
    if (unfinished != 0u)
        atomicAdd(progress.unfinishedSlots, unfinished);
}

void addProgress() {
    if (isCounting) {
        atomicAdd(progress.nodesVisited, workCounts.x);
        atomicAdd(progress.boxesTested, workCounts.y);
        atomicAdd(progress.trianglesTested, workCounts.z);
        atomicMax(progress.deepestStack, workCounts.w);
        atomicAdd(progress.traversalPasses, passCounts.x);
        atomicAdd(progress.busySlots, passCounts.y);
    }
    uint unfinished = 0u;
    EACH_RAY(slot, unfinished += stage[slot] != stageDone ? 1u : 0u;)
    addWork(unfinished);
    uint overflows = sumOfLanes(stackOverflowCount);
    uint samples = sumOfLanes(finishedSampleCount);
    uvec4 rays = uvec4(sumOfLanes(finishedRayCounts.x), sumOfLanes(finishedRayCounts.y),
                       sumOfLanes(finishedRayCounts.z), sumOfLanes(finishedRayCounts.w));
    uint bounces = hasBounces ? sumOfLanes(finishedBounceCount) : 0u;
    if (!subgroupElected())
        return;
    if (overflows != 0u)
        atomicAdd(progress.stackOverflows, overflows);
    atomicAdd(progress.finishedSamples, samples);
    atomicAdd(progress.primaryRays, rays.x);
    atomicAdd(progress.shadowRays, rays.y);
    if (hasSpecular)
        atomicAdd(progress.reflectionRays, rays.z);
    if (hasDielectric)
        atomicAdd(progress.refractionRays, rays.w);
    if (hasBounces)
        atomicAdd(progress.bounceRays, bounces);
}
