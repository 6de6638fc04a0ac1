// The traversal for lavapipe: skip lists, without a stack (layout.h: SkipNode).
//
// On lavapipe an `if` skips no code, only the back edge of a loop branches, and a step costs the same for one lane as
// for eight. The lanes of a subgroup follow samples of the same pixels and reach their leaves together. So all path
// slots step until each is at a leaf, and then all test triangles until each has left its leaf. Traversal can stop
// after any step: its state is the cursor and the nearest hit.
//
// An alpha test takes longer than several steps, and all lanes would pay for it with each triangle. So a ray with an
// alpha-tested candidate waits until all others have come to their end or wait, too.

// Distances to the planes of the grid: q * scale + lower or upper, with q in the upper half of a word. A value in the
// lower half moves the plane up by less than a cell; it is left there only for upper planes, which it moves outward.
//
// Both are moved outward by 3 pads. With u the unit of rounding and M the reach, a pad is 16 u M: one is the pad of
// the triangle's own box (box.glsl), whose interval is rounded by 4 u M |inverse|, and the others cover the rounding
// here: at most u (3 |b| + 3 |q a| + |q a + b|) <= 8 u M |inverse|, for b = (gridMiddle - o) inverse with
// |b| <= M |inverse|, and q a = q gridScale inverse, at most half of the extent and so M |inverse|, nearly.
struct GridRay {
    vec3 scale;
    vec3 lower;
    vec3 upper;
};

GridRay makeGridRay(vec3 origin, BoxRay ray) {
    vec3 outward = 3.0 * ray.pad * ray.inverse;
    vec3 base = (frame.gridMiddle - origin) * ray.inverse;
    vec3 scale = frame.gridScale * ray.inverse * (1.0 / 65536.0);
    return GridRay(scale, base - outward, base + outward);
}

// Where there are instances, boxes are tested as those of placed meshes (instance.glsl), the scene's own tree included:
// its coordinates are those of its grid, in halves of a cell. The slack is 24 units of rounding of the grid's extent.
PlacedBoxRay makeTopRay(BoxRay ray) {
    vec3 cell = frame.gridScale * 0.5;
    return makePlacedBoxRay(ray, vec3(cell.x, 0.0, 0.0), vec3(0.0, cell.y, 0.0), vec3(0.0, 0.0, cell.z),
                            frame.gridMiddle, frame.gridScale * (24.0 * 32768.0 / 16777216.0));
}

PlacedBoxRay makeInstanceRay(BoxRay ray, InstanceRecord instance) {
    return makePlacedBoxRay(ray, instance.gridToX, instance.gridToY, instance.gridToZ,
                            vec3(instance.gridOffsetX, instance.gridOffsetY, instance.gridOffsetZ), instance.slack);
}

// The list in which nearer siblings mostly come first for this direction: the second list if the largest component is
// negative.
uint skipListFor(vec3 direction) {
    return largestComponent(abs(direction)) != largestComponent(direction) ? 1u : 0u;
}

// The end of the scene's own tree in that list.
int topEnd(vec3 direction) { return int(skipListFor(direction) * frame.skipListLength + frame.topListLength); }

// The list for a mesh which an instance places.
uint skipListFor(vec3 direction, InstanceRecord instance) {
    vec3 turned = instance.toX * direction.x + instance.toY * direction.y + instance.toZ * direction.z;
    return skipListFor(turned);
}

void enterTree(uint slot) {
    path[slot].cursorNode = skipListFor(path[slot].rayDirection) * frame.skipListLength;
    path[slot].cursorTriangle = noNode;
    path[slot].cursorInstance = noInstance;
}

void stopTraversal(uint slot) {
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
    path[slot].cursorInstance = noInstance;
}

// Cursor of a ray in the tree, in signed integers, which CPUs compare faster.
struct Cursor {
    int node;         // the next one to visit
    int end;          // of its list; 0: the slot has no ray to trace
    int leaf;         // the link to the next triangles to test (SkipNode), or 0
    bool isSearching; // for the next leaf
    uint instance;    // whose tree it is in, or noInstance
    int following;    // then the node after the instance's own
    bool isWaiting;   // for the alpha test of its candidate
};

bool canMove(Cursor cursor) { return (anyHit & anyHitAlpha) == 0u || !cursor.isWaiting; }

bool isBeforeLeaf(Cursor cursor) { return cursor.leaf == 0 && cursor.node < cursor.end && canMove(cursor); }

bool isAtTriangle(Cursor cursor) { return cursor.leaf != 0 && canMove(cursor); }

vec2 gridBoxInterval(GridRay ray, ivec3 planes) {
    vec3 toLower = ray.lower + vec3(planes << 16u) * ray.scale;
    vec3 toUpper = ray.upper + vec3(planes) * ray.scale;
    float enter = greater(largestComponent(lesser(toLower, toUpper)), 0.0);
    return vec2(enter, smallestComponent(greater(toLower, toUpper)));
}

vec2 gridBoxInterval(PlacedBoxRay ray, ivec3 planes) {
    ivec3 lower = planes << 16u >> 16u;
    ivec3 upper = planes >> 16u;
    return placedBoxInterval(ray, vec3(lower + upper), vec3(upper - lower));
}

// A cursor on a triangle, or at the end, does not move.
void visitNode(inout Cursor cursor, GridRay ray, PlacedBoxRay placedRay, float rayLength) {
    SkipNode node = fetchSkipNode(uint(cursor.node));
    ivec3 planes = ivec3(node.x, node.y, node.z);
    int link = int(node.link);
    vec2 interval;
    if (hasInstances)
        interval = gridBoxInterval(placedRay, planes);
    else
        interval = gridBoxInterval(ray, planes);
    bool isHit = interval.x <= lesser(interval.y, rayLength);
    int following = cursor.node + 1;
    int next = isHit ? following : max(link, following); // the link of a leaf is negative
    int leaf = isHit ? min(link, 0) : 0;
    cursor.node = cursor.isSearching ? next : cursor.node;
    cursor.leaf = cursor.isSearching ? leaf : cursor.leaf;
    cursor.isSearching = isBeforeLeaf(cursor);
}

// Moves a cursor that has found an instance to the tree of its mesh.
void enterInstance(inout Cursor cursor, vec3 direction, InstanceRecord instance) {
    int list = int(skipListFor(direction, instance) * frame.skipListLength);
    cursor.following = cursor.node;
    cursor.node = list + int(instance.listBegin);
    cursor.end = list + int(instance.listEnd);
    cursor.leaf = 0;
}

// Moves a cursor to the end of the list: nothing else can be met.
void leaveAll(inout Cursor cursor, vec3 direction) {
    cursor.leaf = 0;
    cursor.node = cursor.end;
    cursor.following = topEnd(direction);
}

bool isAtEndOfInstance(Cursor cursor) {
    return hasInstances && cursor.instance != noInstance && cursor.leaf == 0 && cursor.node >= cursor.end;
}

// Moves a cursor out of the tree of an instance's mesh, to `node` of the scene's own.
void leaveTree(inout Cursor cursor, vec3 direction, int node) {
    cursor.node = node;
    cursor.end = topEnd(direction);
    cursor.instance = noInstance;
}

// Tests the next triangle of a leaf, and moves the cursor past it.
Candidate testNext(uint slot, inout Cursor cursor, InstanceRecord place, TriangleRay ray, BoxRay boxRay,
                 const bool isShadow) {
    uint record = uint(cursor.leaf) & ~leafFlag;
    TriangleRecord triangle = fetchTriangle(record);
    cursor.leaf = (triangle.flags & triangleEndsLeaf) != 0u ? 0 : cursor.leaf + 1;
    if (hasInstances && cursor.instance != noInstance)
        triangle = placedTriangle(place, triangle);
    return testTriangle(slot, record, cursor.instance, triangle, ray, boxRay, isShadow);
}

// testNext where leaves may be pairs. The corners are fetched in the order in which the pair has them. Where the line
// of the ray goes through both triangles, the second one is tested again by itself: the cursor moves to it.
Candidate testNextPair(uint slot, inout Cursor cursor, InstanceRecord place, TriangleRay ray, BoxRay boxRay,
                     const bool isShadow) {
    uint leaf = uint(cursor.leaf);
    bool isPair = isPairOfTriangles(leaf);
    uint record = leafRecordOf(leaf);
    uint corner = firstCornerOf(leaf);
    uint next = corner == 2u ? 0u : corner + 1u;
    uint last = 3u - corner - next;
    uint secondCorner = secondCornerOf(leaf);
    uint secondApex = secondCorner == 0u ? 2u : secondCorner - 1u;
    uvec4 begin = fetchTriangleRow(record * 3u + corner);
    uvec4 end = fetchTriangleRow(record * 3u + next);
    uvec4 apex = fetchTriangleRow(record * 3u + last);
    uvec4 apexOfSecond = fetchTriangleRow(record * 3u + (isPair ? 3u + secondApex : 0u));
    // The words of the record stand beside its corners: the id beside the first, and so on.
    uint id = corner == 0u ? begin.w : (corner == 1u ? apex.w : end.w);
    uint materialIndex = corner == 0u ? end.w : (corner == 1u ? begin.w : apex.w);
    uint flags = corner == 0u ? apex.w : (corner == 1u ? end.w : begin.w);
    JoinedTriangles pair = JoinedTriangles(uintBitsToFloat(begin.xyz), uintBitsToFloat(end.xyz),
                                           uintBitsToFloat(apex.xyz), uintBitsToFloat(apexOfSecond.xyz), corner,
                                           secondCorner);
    if (hasInstances && cursor.instance != noInstance) {
        pair.begin = placedPoint(place, pair.begin);
        pair.end = placedPoint(place, pair.end);
        pair.firstApex = placedPoint(place, pair.firstApex);
        pair.secondApex = placedPoint(place, pair.secondApex);
        id += place.firstPrimitive;
    }
    bool takesSecond = isPair && id + 1u != path[slot].rayExcluded;
    PairHit found = intersectPair(ray, boxRay, pair, id != path[slot].rayExcluded, takesSecond);
    bool endsLeaf = isPair || (flags & triangleEndsLeaf) != 0u;
    cursor.leaf = found.isBoth ? int(leafFlag | (record + 1u)) : (endsLeaf ? 0 : cursor.leaf + 1);
    uint further = found.isSecond ? 1u : 0u;
    return candidateOf(slot, found.hit, id + further, record + further, cursor.instance, flags, materialIndex,
                       isShadow);
}

// `waiting` gets the alpha-tested triangles that rays meet. These rays have stopped on the way.
void traverseTree(uint stage, const bool isShadow, inout Candidate waiting[RAYS]) {
    GridRay gridRay[RAYS];
    PlacedBoxRay placedRay[RAYS];
    InstanceRecord instance[RAYS];
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    Cursor cursor[RAYS];
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        vec3 origin = path[slot].rayOrigin;
        vec3 direction = path[slot].rayDirection;
        boxRay[slot] = makeBoxRay(origin, direction, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(origin, direction);
        if (hasInstances)
            placedRay[slot] = makeTopRay(boxRay[slot]);
        else
            gridRay[slot] = makeGridRay(origin, boxRay[slot]);
        bool isMine = path[slot].stage == stage && isTraversing(slot);
        bool isAtLeaf = path[slot].cursorTriangle != noNode;
        cursor[slot].node = isMine ? int(path[slot].cursorNode) : 0;
        cursor[slot].end = isMine ? topEnd(direction) : 0;
        cursor[slot].leaf = isMine && isAtLeaf ? int(path[slot].cursorTriangle | leafFlag) : 0;
        cursor[slot].instance = noInstance;
        cursor[slot].isWaiting = false;
        if (hasInstances && isMine && path[slot].cursorInstance != noInstance) {
            cursor[slot].instance = path[slot].cursorInstance;
            cursor[slot].following = int(path[slot].cursorReturn);
            instance[slot] = fetchInstance(cursor[slot].instance);
            placedRay[slot] = makeInstanceRay(boxRay[slot], instance[slot]);
            cursor[slot].end =
                int(skipListFor(direction, instance[slot]) * frame.skipListLength + instance[slot].listEnd);
        }
    }
    bool isRunning;
    do {
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            cursor[slot].isSearching = isBeforeLeaf(cursor[slot]);
        bool isAnySearching;
        do {
            isAnySearching = false;
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
                countSlot(slot, cursor[slot].isSearching, uvec3(1u, 1u, 0u));
                visitNode(cursor[slot], gridRay[slot], placedRay[slot], path[slot].rayLength);
                isAnySearching = isAnySearching || cursor[slot].isSearching;
            }
            countPass();
            stepsTaken += 1u;
        } while (isAnySearching && stepsTaken < dispatch.stepBudget);
        if (hasInstances)
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
                if (isInstance(uint(cursor[slot].leaf))) {
                    cursor[slot].instance = instanceOf(uint(cursor[slot].leaf));
                    instance[slot] = fetchInstance(cursor[slot].instance);
                    placedRay[slot] = makeInstanceRay(boxRay[slot], instance[slot]);
                    enterInstance(cursor[slot], path[slot].rayDirection, instance[slot]);
                }
        do {
            isRunning = false;
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
                uint triangles = hasPairs && isPairOfTriangles(uint(cursor[slot].leaf)) ? 2u : 1u;
                countSlot(slot, isAtTriangle(cursor[slot]), uvec3(0u, 0u, triangles));
                if (isAtTriangle(cursor[slot])) {
                    Candidate candidate;
                    if (hasPairs)
                        candidate = testNextPair(slot, cursor[slot], instance[slot], triangleRay[slot], boxRay[slot],
                                               isShadow);
                    else
                        candidate =
                            testNext(slot, cursor[slot], instance[slot], triangleRay[slot], boxRay[slot], isShadow);
                    if (needsAlphaTest(candidate)) {
                        waiting[slot] = candidate;
                        cursor[slot].isWaiting = true;
                    } else if (commitHit(slot, candidate, isShadow)) {
                        leaveAll(cursor[slot], path[slot].rayDirection);
                    }
                }
                isRunning = isRunning || isAtTriangle(cursor[slot]);
            }
            countPass();
            stepsTaken += 1u;
        } while (isRunning && stepsTaken < dispatch.stepBudget);
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            if (isAtEndOfInstance(cursor[slot])) {
                placedRay[slot] = makeTopRay(boxRay[slot]);
                leaveTree(cursor[slot], path[slot].rayDirection, cursor[slot].following);
            }
            isRunning = isRunning || (cursor[slot].node < cursor[slot].end && canMove(cursor[slot]));
        }
        stepsTaken += 1u;
    } while (isRunning && stepsTaken < dispatch.stepBudget);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        if (cursor[slot].end == 0)
            continue;
        bool isAtLeaf = cursor[slot].leaf != 0;
        bool isDone = !isAtLeaf && cursor[slot].node >= cursor[slot].end;
        path[slot].cursorNode = isDone ? noNode : uint(cursor[slot].node);
        path[slot].cursorTriangle = isAtLeaf ? uint(cursor[slot].leaf) & ~leafFlag : noNode;
        path[slot].cursorInstance = cursor[slot].instance;
        path[slot].cursorReturn = uint(cursor[slot].following);
    }
}

// The traversal of a scene with alpha tests.
void traverseAlphaTestedTree(uint stage, const bool isShadow) {
    bool isAnyLeft;
    do {
        Candidate waiting[RAYS];
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            waiting[slot].isMet = false;
        traverseTree(stage, isShadow, waiting);
        isAnyLeft = false;
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            if (waiting[slot].isMet && !failsAlphaTest(slot, waiting[slot], isShadow) &&
                commitHit(slot, waiting[slot], isShadow))
                stopTraversal(slot);
            isAnyLeft = isAnyLeft || (path[slot].stage == stage && isTraversing(slot));
        }
        stepsTaken += 2u; // and a loop in the lookup
    } while (isAnyLeft && stepsTaken < dispatch.stepBudget);
}
