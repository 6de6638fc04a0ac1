// The traversal for lavapipe: skip lists, without a stack (layout.h: SkipNode).
//
// On lavapipe an `if` skips no code, only the back edge of a loop branches, and a step costs the same for one lane as
// for eight. The lanes of a subgroup follow samples of the same pixels and reach their leaves together. So all rays
// step until each is at a leaf, and then all test triangles until each has left its leaf. Traversal can stop after any
// step: its state is the cursor and the nearest hit.
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

void enterTree(uint i) {
    traversal[i].cursorNode = skipListFor(traversal[i].ray.direction) * frame.skipListLength;
    traversal[i].cursorTriangle = noNode;
    traversal[i].cursorInstance = noInstance;
}

void stopTraversal(uint i) {
    traversal[i].cursorNode = noNode;
    traversal[i].cursorTriangle = noNode;
    traversal[i].cursorInstance = noInstance;
}

// Cursor of a ray in the tree, in signed integers, which CPUs compare faster.
struct Cursor {
    int node;         // the next one to visit
    int end;          // of its list; 0: the ray takes no part
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

// A ray on its way, with what its tests need.
struct SkipWalk {
    BoxRay box;
    TriangleRay triangle;
    GridRay grid;        // where there are no instances
    PlacedBoxRay placed; // where there are
    InstanceRecord instance;
    Cursor cursor;
    Candidate waiting; // where the cursor waits, its alpha-tested candidate
};

SkipWalk walks[RAYS];

// Tests the next triangle of a leaf, and moves the cursor past it.
Candidate testNext(uint i, const bool isVisibility) {
    uint record = uint(walks[i].cursor.leaf) & ~leafFlag;
    TriangleRecord triangle = fetchTriangle(record);
    walks[i].cursor.leaf = (triangle.flags & triangleEndsLeaf) != 0u ? 0 : walks[i].cursor.leaf + 1;
    if (hasInstances && walks[i].cursor.instance != noInstance)
        triangle = placedTriangle(walks[i].instance, triangle);
    return testTriangle(i, record, walks[i].cursor.instance, triangle, walks[i].triangle, walks[i].box, isVisibility);
}

// testNext where leaves may be pairs. The corners are fetched in the order in which the pair has them. Where the line
// of the ray goes through both triangles, the second one is tested again by itself: the cursor moves to it.
Candidate testNextPair(uint i, const bool isVisibility) {
    uint leaf = uint(walks[i].cursor.leaf);
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
    if (hasInstances && walks[i].cursor.instance != noInstance) {
        pair.begin = placedPoint(walks[i].instance, pair.begin);
        pair.end = placedPoint(walks[i].instance, pair.end);
        pair.firstApex = placedPoint(walks[i].instance, pair.firstApex);
        pair.secondApex = placedPoint(walks[i].instance, pair.secondApex);
        id += walks[i].instance.firstPrimitive;
    }
    bool takesSecond = isPair && id + 1u != traversal[i].ray.excluded;
    PairHit found = intersectPair(walks[i].triangle, walks[i].box, pair, id != traversal[i].ray.excluded, takesSecond);
    bool endsLeaf = isPair || (flags & triangleEndsLeaf) != 0u;
    walks[i].cursor.leaf = found.isBoth ? int(leafFlag | (record + 1u)) : (endsLeaf ? 0 : walks[i].cursor.leaf + 1);
    uint further = found.isSecond ? 1u : 0u;
    return candidateOf(i, found.hit, id + further, record + further, walks[i].cursor.instance, flags, materialIndex,
                       isVisibility);
}

void beginWalk(uint i, bool takesPart) {
    vec3 direction = traversal[i].ray.direction;
    walks[i].box = makeBoxRay(traversal[i].ray.origin, direction, frame.boundsLower, frame.boundsUpper);
    walks[i].triangle = makeTriangleRay(traversal[i].ray.origin, direction);
    if (hasInstances)
        walks[i].placed = makeTopRay(walks[i].box);
    else
        walks[i].grid = makeGridRay(traversal[i].ray.origin, walks[i].box);
    bool isMine = takesPart && isTraversing(i);
    bool isAtLeaf = traversal[i].cursorTriangle != noNode;
    walks[i].cursor.node = isMine ? int(traversal[i].cursorNode) : 0;
    walks[i].cursor.end = isMine ? topEnd(direction) : 0;
    walks[i].cursor.leaf = isMine && isAtLeaf ? int(traversal[i].cursorTriangle | leafFlag) : 0;
    walks[i].cursor.instance = noInstance;
    walks[i].cursor.isWaiting = false;
    if (hasInstances && isMine && traversal[i].cursorInstance != noInstance) {
        walks[i].cursor.instance = traversal[i].cursorInstance;
        walks[i].cursor.following = int(traversal[i].cursorReturn);
        walks[i].instance = fetchInstance(walks[i].cursor.instance);
        walks[i].placed = makeInstanceRay(walks[i].box, walks[i].instance);
        walks[i].cursor.end =
            int(skipListFor(direction, walks[i].instance) * frame.skipListLength + walks[i].instance.listEnd);
    }
}

// Returns whether the ray searches on for its next leaf.
bool seekLeaf(uint i) {
    countBusyRay(walks[i].cursor.isSearching);
    countWork(i, walks[i].cursor.isSearching, uvec3(1u, 1u, 0u));
    visitNode(walks[i].cursor, walks[i].grid, walks[i].placed, traversal[i].hit.distance);
    return walks[i].cursor.isSearching;
}

// Enters the instance that the ray has found, if it has.
void enterFound(uint i) {
    if (!hasInstances || !isInstance(uint(walks[i].cursor.leaf)))
        return;
    walks[i].cursor.instance = instanceOf(uint(walks[i].cursor.leaf));
    walks[i].instance = fetchInstance(walks[i].cursor.instance);
    walks[i].placed = makeInstanceRay(walks[i].box, walks[i].instance);
    enterInstance(walks[i].cursor, traversal[i].ray.direction, walks[i].instance);
}

// Returns whether the ray has more triangles of its leaf to test.
bool testLeaf(uint i, const bool isVisibility) {
    bool isBusy = isAtTriangle(walks[i].cursor);
    countBusyRay(isBusy);
    countWork(i, isBusy, uvec3(0u, 0u, hasPairs && isPairOfTriangles(uint(walks[i].cursor.leaf)) ? 2u : 1u));
    if (isBusy) {
        Candidate candidate;
        if (hasPairs)
            candidate = testNextPair(i, isVisibility);
        else
            candidate = testNext(i, isVisibility);
        if (needsAlphaTest(candidate)) {
            walks[i].waiting = candidate;
            walks[i].cursor.isWaiting = true;
        } else if (commitHit(i, candidate, isVisibility)) {
            leaveAll(walks[i].cursor, traversal[i].ray.direction);
        }
    }
    return isAtTriangle(walks[i].cursor);
}

// Leaves an instance at its end. Returns whether the ray goes on.
bool leaveFinished(uint i) {
    if (isAtEndOfInstance(walks[i].cursor)) {
        walks[i].placed = makeTopRay(walks[i].box);
        leaveTree(walks[i].cursor, traversal[i].ray.direction, walks[i].cursor.following);
    }
    return walks[i].cursor.node < walks[i].cursor.end && canMove(walks[i].cursor);
}

void endWalk(uint i) {
    if (walks[i].cursor.end == 0)
        return;
    bool isAtLeaf = walks[i].cursor.leaf != 0;
    bool isDone = !isAtLeaf && walks[i].cursor.node >= walks[i].cursor.end;
    traversal[i].cursorNode = isDone ? noNode : uint(walks[i].cursor.node);
    traversal[i].cursorTriangle = isAtLeaf ? uint(walks[i].cursor.leaf) & ~leafFlag : noNode;
    traversal[i].cursorInstance = walks[i].cursor.instance;
    traversal[i].cursorReturn = uint(walks[i].cursor.following);
}

// Rays stop on their way at alpha-tested candidates, which wait in their walks.
void advanceInTree(bool takesPart[RAYS], const bool isVisibility) {
    EACH_RAY(i, beginWalk(i, takesPart[i]);)
    bool isRunning;
    do {
        EACH_RAY(i, walks[i].cursor.isSearching = isBeforeLeaf(walks[i].cursor);)
        bool isAnySearching;
        do {
            isAnySearching = false;
            EACH_RAY(i, isAnySearching = seekLeaf(i) || isAnySearching;)
            countPass();
            stepsTaken += 1u;
        } while (isAnySearching && hasStepsLeft());
        EACH_RAY(i, enterFound(i);)
        do {
            isRunning = false;
            EACH_RAY(i, isRunning = testLeaf(i, isVisibility) || isRunning;)
            countPass();
            stepsTaken += 1u;
        } while (isRunning && hasStepsLeft());
        EACH_RAY(i, isRunning = leaveFinished(i) || isRunning;)
        stepsTaken += 1u;
    } while (isRunning && hasStepsLeft());
    EACH_RAY(i, endWalk(i);)
}

// Tests the candidate that waits. Returns whether the ray goes on.
bool testWaiting(uint i, bool takesPart, const bool isVisibility) {
    if (walks[i].cursor.isWaiting && !failsAlphaTest(i, walks[i].waiting) &&
        commitHit(i, walks[i].waiting, isVisibility))
        stopTraversal(i);
    return takesPart && isTraversing(i);
}

void advanceWithAlphaTests(bool takesPart[RAYS], const bool isVisibility) {
    bool isAnyLeft;
    do {
        advanceInTree(takesPart, isVisibility);
        isAnyLeft = false;
        EACH_RAY(i, isAnyLeft = testWaiting(i, takesPart[i], isVisibility) || isAnyLeft;)
        stepsTaken += 2u; // and a loop in the lookup
    } while (isAnyLeft && hasStepsLeft());
}

#include "shaders/trace/list.glsl"

void advance(bool takesPart[RAYS], const bool isVisibility) {
    if (trianglePairs > 0u)
        advanceInList(takesPart, isVisibility);
    else if ((anyHit & anyHitAlpha) != 0u)
        advanceWithAlphaTests(takesPart, isVisibility);
    else
        advanceInTree(takesPart, isVisibility);
}
