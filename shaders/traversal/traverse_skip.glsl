// The traversal for lavapipe: skip lists, without a stack (layout.h: SkipNode).
//
// On lavapipe an `if` skips no code, only the back edge of a loop branches, and a step costs the same for one lane as
// for eight. The lanes of a subgroup follow samples of the same pixels and reach their leaves together. So all path
// slots step until each is at a leaf, and then all test triangles until each has left its leaf. Traversal can stop
// after any step: its state is the cursor and the nearest hit.

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

// The list in which nearer siblings mostly come first for this direction: the second list if the largest component is
// negative.
uint skipListFor(vec3 direction) {
    return largestComponent(abs(direction)) != largestComponent(direction) ? 1u : 0u;
}

void enterTree(uint slot) {
    path[slot].cursorNode = skipListFor(path[slot].rayDirection) * frame.skipListLength;
    path[slot].cursorTriangle = noNode;
}

void stopTraversal(uint slot) {
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
}

// Cursor of a ray in the tree, in signed integers, which CPUs compare faster.
struct Cursor {
    int node;         // the next one to visit
    int end;          // of its list; 0: the slot has no ray to trace
    int leaf;         // leafFlag | the next triangle to test, or 0
    bool isSearching; // for the next leaf
};

bool isBeforeLeaf(Cursor cursor) { return cursor.leaf == 0 && cursor.node < cursor.end; }

// A cursor on a triangle, or at the end, does not move.
void visitNode(inout Cursor cursor, GridRay ray, float rayLength) {
    SkipNode node = fetchSkipNode(uint(cursor.node));
    ivec3 planes = ivec3(node.x, node.y, node.z);
    int link = int(node.link);
    vec3 toLower = ray.lower + vec3(planes << 16u) * ray.scale;
    vec3 toUpper = ray.upper + vec3(planes) * ray.scale;
    float enter = greater(largestComponent(lesser(toLower, toUpper)), 0.0);
    float leave = lesser(smallestComponent(greater(toLower, toUpper)), rayLength);
    bool isHit = enter <= leave;
    int following = cursor.node + 1;
    int next = isHit ? following : max(link, following); // the link of a leaf is negative
    int leaf = isHit ? min(link, 0) : 0;
    cursor.node = cursor.isSearching ? next : cursor.node;
    cursor.leaf = cursor.isSearching ? leaf : cursor.leaf;
    cursor.isSearching = isBeforeLeaf(cursor);
}

void traverse(uint stage, const bool isShadow) {
    GridRay gridRay[RAYS];
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    Cursor cursor[RAYS];
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        vec3 origin = path[slot].rayOrigin;
        vec3 direction = path[slot].rayDirection;
        boxRay[slot] = makeBoxRay(origin, direction, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(origin, direction);
        gridRay[slot] = makeGridRay(origin, boxRay[slot]);
        bool isMine = path[slot].stage == stage && isTraversing(slot);
        bool isAtLeaf = path[slot].cursorTriangle != noNode;
        cursor[slot].node = isMine ? int(path[slot].cursorNode) : 0;
        cursor[slot].end = isMine ? int((skipListFor(direction) + 1u) * frame.skipListLength) : 0;
        cursor[slot].leaf = isMine && isAtLeaf ? int(path[slot].cursorTriangle | leafFlag) : 0;
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
                visitNode(cursor[slot], gridRay[slot], path[slot].rayLength);
                isAnySearching = isAnySearching || cursor[slot].isSearching;
            }
            countPass();
            stepsTaken += 1u;
        } while (isAnySearching && stepsTaken < dispatch.stepBudget);
        do {
            isRunning = false;
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
                countSlot(slot, cursor[slot].leaf != 0, uvec3(0u, 0u, 1u));
                if (cursor[slot].leaf != 0) {
                    uint record = uint(cursor[slot].leaf) & ~leafFlag;
                    TriangleRecord triangle = fetchTriangle(record);
                    cursor[slot].leaf = (triangle.flags & triangleEndsLeaf) != 0u ? 0 : cursor[slot].leaf + 1;
                    if (meetTriangle(slot, record, triangle, triangleRay[slot], boxRay[slot], isShadow)) {
                        cursor[slot].leaf = 0;
                        cursor[slot].node = cursor[slot].end;
                    }
                }
                isRunning = isRunning || cursor[slot].leaf != 0;
            }
            countPass();
            stepsTaken += 1u;
        } while (isRunning && stepsTaken < dispatch.stepBudget);
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            isRunning = isRunning || cursor[slot].node < cursor[slot].end;
        stepsTaken += 1u;
    } while (isRunning && stepsTaken < dispatch.stepBudget);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        if (cursor[slot].end == 0)
            continue;
        bool isAtLeaf = cursor[slot].leaf != 0;
        bool isDone = !isAtLeaf && cursor[slot].node >= cursor[slot].end;
        path[slot].cursorNode = isDone ? noNode : uint(cursor[slot].node);
        path[slot].cursorTriangle = isAtLeaf ? uint(cursor[slot].leaf) & ~leafFlag : noNode;
    }
}
