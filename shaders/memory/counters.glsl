// What a dispatch counts: the steps that bound it, and the work of its traversals.

uint stepsTaken = 0u;         // loop iterations of this dispatch, which end at dispatch.stepBudget
uint stepsForfeited = 0u;     // of these, steps that were skipped because the work budget of the dispatch was spent
uint passWork = 0u;           // other work, in the equivalent of steps
uint stackOverflowCount = 0u;
uvec4 workCounts = uvec4(0u); // nodes, boxes, triangles, deepest stack: only where isCounting
uvec2 passCounts = uvec2(0u); // passes of the subgroup through the traversal, rays busy in them: likewise
uint busyRaysBefore = 0u;     // the present pass

bool hasStepsLeft() { return stepsTaken < dispatch.stepBudget; }

// Counts a pass of the subgroup through a loop of the traversal: one of its busy lanes does.
void countPass() {
    if (!isCounting || passCounts.y == busyRaysBefore)
        return;
    passCounts.x += subgroupElect() ? 1u : 0u;
    busyRaysBefore = passCounts.y;
}
