// The traversal of a scene with few triangles: all of them in turn, from registers. First those that the line of the
// ray goes through, which takes arithmetic alone, and then these by the test of the tree's leaves, which gives the same
// bits.

void traverseList(uint stage, const bool isShadow) {
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    bool isMine[RAYS];
    uint candidates[RAYS]; // a bit for each triangle
    bool isRunning = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        isMine[slot] = path[slot].stage == stage && isTraversing(slot);
        boxRay[slot] =
            makeBoxRay(path[slot].rayOrigin, path[slot].rayDirection, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(path[slot].rayOrigin, path[slot].rayDirection);
        candidates[slot] = 0u;
        [[unroll]] for (uint i = 0u; i < trianglePairs; ++i)
            candidates[slot] |=
                trianglesOnRay(triangleRay[slot], boxRay[slot].pad, path[slot].rayLength, listedPairs[i]);
        candidates[slot] = isMine[slot] ? candidates[slot] : 0u;
        countSlot(slot, isMine[slot], uvec3(0u, 0u, frame.triangleCount));
    }
    countPass();
    do {
        isRunning = false;
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            if (candidates[slot] != 0u) {
                uint record = uint(findLSB(candidates[slot]));
                candidates[slot] &= candidates[slot] - 1u;
                if (meetTriangle(slot, record, noInstance, fetchTriangle(record), triangleRay[slot], boxRay[slot],
                                 isShadow))
                    candidates[slot] = 0u;
            }
            isRunning = isRunning || candidates[slot] != 0u;
        }
        stepsTaken += 1u;
    } while (isRunning); // at most maxListedTriangles times, whatever the step budget
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (isMine[slot])
            stopTraversal(slot);
}
