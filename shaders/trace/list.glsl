// The traversal of a scene with few triangles: all of them in turn, from registers. First those that the line of the
// ray goes through, which takes arithmetic alone, and then these by the test of the tree's leaves, which gives the same
// bits.

struct ListWalk {
    BoxRay box;
    TriangleRay triangle;
    uint candidates; // a bit for each triangle
};

ListWalk listWalks[RAYS];

void beginListWalk(uint i, bool takesPart) {
    BoxRay box = makeBoxRay(traversal[i].ray.origin, traversal[i].ray.direction, frame.boundsLower, frame.boundsUpper);
    TriangleRay triangle = makeTriangleRay(traversal[i].ray.origin, traversal[i].ray.direction);
    uint candidates = 0u;
    [[unroll]] for (uint pair = 0u; pair < trianglePairs; ++pair)
        candidates |= trianglesOnRay(triangle, box.pad, traversal[i].hit.distance, listedPairs[pair]);
    countBusyRay(takesPart);
    countWork(i, takesPart, uvec3(0u, 0u, frame.triangleCount));
    listWalks[i] = ListWalk(box, triangle, takesPart ? candidates : 0u);
}

// Returns whether candidates are left.
bool testCandidate(uint i, const bool isVisibility) {
    if (listWalks[i].candidates != 0u) {
        uint record = uint(findLSB(listWalks[i].candidates));
        listWalks[i].candidates &= listWalks[i].candidates - 1u;
        if (meetTriangle(i, record, noInstance, fetchTriangle(record), listWalks[i].triangle, listWalks[i].box,
                         isVisibility))
            listWalks[i].candidates = 0u;
    }
    return listWalks[i].candidates != 0u;
}

void advanceInList(bool takesPart[RAYS], const bool isVisibility) {
    EACH_RAY(i, beginListWalk(i, takesPart[i]);)
    countPass();
    bool isRunning;
    do {
        isRunning = false;
        EACH_RAY(i, isRunning = testCandidate(i, isVisibility) || isRunning;)
        stepsTaken += 1u;
    } while (isRunning); // at most maxListedTriangles times, whatever the step budget
    EACH_RAY(i, if (takesPart[i]) stopTraversal(i);)
}
