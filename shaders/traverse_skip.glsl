// The traversal for lavapipe: skip lists, without a stack (layout.h: SkipNode).
//
// There an `if` skips no code, only the back edge of a loop branches, and a step costs the same for one lane as for
// eight. The lanes of a subgroup follow samples of the same pixels and find their leaves together: so all path slots step
// until each stands at a leaf, then all test triangles until each has left its leaf. It can stop after any step: the
// cursor and the nearest hit are all there is to keep.

// Distances to the planes of the grid: q * scale + near for planes that are met first, q * scale + far for the others.
//
// Both are moved outward by 3 pads. With u the unit of rounding and M the reach, a pad is 16 u M: one is the pad of
// the triangle's own box (box.glsl), whose interval is rounded by 4 u M |inverse|, and the others cover the rounding
// here: at most u (4 |b| + 4 |65535 a| + 2 |q a + b|) <= 20 u M |inverse|, for b = (gridOrigin - o) inverse with
// |b| <= M |inverse|, and 65535 a = extent inverse, at most 2 M |inverse|.
struct GridRay {
    vec3 scale;
    vec3 near;
    vec3 far;
};

GridRay makeGridRay(vec3 origin, BoxRay ray) {
    vec3 outward = abs(3.0 * ray.pad * ray.inverse);
    vec3 base = subtract(frame.gridOrigin, origin) * ray.inverse;
    return GridRay(frame.gridScale * ray.inverse, subtract(base, outward), add(base, outward));
}

// The list in which nearer siblings come first for most of these directions.
uint skipOrder(vec3 d) {
    if (skipOrders == 8u)
        return (d.x < 0.0 ? 1u : 0u) | (d.y < 0.0 ? 2u : 0u) | (d.z < 0.0 ? 4u : 0u);
    return skipOrders == 2u && largestComponent(abs(d)) != largestComponent(d) ? 1u : 0u;
}

void enterTree(uint slot) {
    path[slot].cursorNode = skipOrder(path[slot].rayDirection) * frame.skipListLength;
    path[slot].cursorTriangle = noNode;
}

void stopTraversal(uint slot) {
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
}

// A slot whose cursor stands on a triangle waits.
void visitNode(uint slot, GridRay ray) {
    uint cursor = path[slot].cursorNode;
    SkipNode node = fetchSkipNode(cursor);
    uvec3 planes = uvec3(node.x, node.y, node.z);
    uvec3 first = planes & 0xFFFFu;
    uvec3 second = planes >> 16u;
    if (skipOrders != 8u) {
        bvec3 isTurned = lessThan(ray.scale, vec3(0.0));
        first = mix(planes & 0xFFFFu, planes >> 16u, isTurned);
        second = mix(planes >> 16u, planes & 0xFFFFu, isTurned);
    }
    vec3 enter = addProduct(ray.near, vec3(first), ray.scale);
    vec3 leave = addProduct(ray.far, vec3(second), ray.scale);
    bool isHit = greater(largestComponent(enter), 0.0) <= lesser(smallestComponent(leave), path[slot].rayLength);
    bool isLeaf = (node.link & leafFlag) != 0u;
    bool isWaiting = path[slot].cursorTriangle != noNode;
    uint next = isHit || isLeaf ? cursor + 1u : node.link;
    path[slot].cursorNode = isWaiting ? cursor : next;
    path[slot].cursorTriangle = !isWaiting && isHit && isLeaf ? node.link & ~leafFlag : path[slot].cursorTriangle;
}

void traverse(uint stage, const bool isShadow) {
    GridRay gridRay[RAYS];
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    uint end[RAYS];
    bool isRunning = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        vec3 origin = path[slot].rayOrigin;
        vec3 direction = path[slot].rayDirection;
        boxRay[slot] = makeBoxRay(origin, direction, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(origin, direction);
        gridRay[slot] = makeGridRay(origin, boxRay[slot]);
        bool isMine = path[slot].stage == stage && isTraversing(slot);
        end[slot] = isMine ? (skipOrder(direction) + 1u) * frame.skipListLength : 0u;
        isRunning = isRunning || isMine;
    }
    do {
        bool isSearching;
        do {
            isSearching = false;
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
                if (path[slot].cursorNode < end[slot])
                    visitNode(slot, gridRay[slot]);
                isSearching = isSearching || (path[slot].cursorNode < end[slot] && path[slot].cursorTriangle == noNode);
            }
            stepsTaken += 1u;
        } while (isSearching && stepsTaken < dispatch.stepBudget);
        do {
            isRunning = false;
            [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
                if (end[slot] != 0u && path[slot].cursorTriangle != noNode) {
                    uint record = path[slot].cursorTriangle;
                    TriangleRecord triangle = fetchTriangle(record);
                    path[slot].cursorTriangle = (triangle.flags & triangleEndsLeaf) != 0u ? noNode : record + 1u;
                    if (meetTriangle(slot, record, triangle, triangleRay[slot], boxRay[slot], isShadow))
                        stopTraversal(slot);
                }
                isRunning = isRunning || (end[slot] != 0u && path[slot].cursorTriangle != noNode);
            }
            stepsTaken += 1u;
        } while (isRunning && stepsTaken < dispatch.stepBudget);
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
            isRunning = isRunning || path[slot].cursorNode < end[slot];
        stepsTaken += 1u;
    } while (isRunning && stepsTaken < dispatch.stepBudget);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (end[slot] != 0u && path[slot].cursorNode >= end[slot] && path[slot].cursorTriangle == noNode)
            stopTraversal(slot);
}
