// Rays on their way through the scene: what the drive hands to a traversal, and what it gets back.

const float unbounded = 3.4028234e38; // length of a ray without a hit

struct Ray {
    vec3 origin;
    float maxDistance; // hits at this distance and beyond do not count
    vec3 direction;    // unit length
    uint excluded;     // the primitive at its origin, which it cannot hit, or noPrimitive
    uint target;       // the primitive at which it is aimed, which does not block it, or noPrimitive
};

// What the random numbers of a ray's alpha tests are made of (alphaTestNumber).
struct RayKey {
    uvec2 pixel;
    uint sampleIndex;
    uint number; // among the rays of its sample
};

// A ray that can wait between any two steps. `hit` is the nearest one so far; of a ray of visibility, its primitive is
// what blocks the ray, and its distance stays that of the ray's end.
struct TraversalState {
    Ray ray;
    RayKey key;
    Hit hit;
    bool isDimmed;       // a ray of visibility has passed glass
    uint cursorNode;     // the inner node to visit next, or noNode
    uint cursorTriangle; // the triangle of the leaf to test next, in skip lists as a link has it, or noNode
    uint cursorInstance; // whose tree the cursor is in, or noInstance
    uint cursorReturn;   // skip lists: the node after the instance's own
    uint stackSize;      // subtrees in the stack
    uint stackIndex;     // which stack of the buffer is its own
    vec3 work;           // nodes, boxes and triangles tested: where showsCost
};

TraversalState traversal[RAYS]; // the rays of an invocation

bool isTraversing(uint i) { return traversal[i].cursorNode != noNode || traversal[i].cursorTriangle != noNode; }

// Counts a ray in a pass through a loop of the traversal.
void countBusyRay(bool isBusy) {
    if (isCounting && isBusy)
        passCounts.y += 1u;
}

// Counts the nodes, boxes and triangles that a ray tests.
void countWork(uint i, bool tests, uvec3 work) {
    if (!isCounting || !tests)
        return;
    workCounts.xyz += work;
    if (showsCost)
        traversal[i].work = traversal[i].work + vec3(work);
}
