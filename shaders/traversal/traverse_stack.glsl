// The portable traversal: an explicit stack over the node pairs, in storage buffers.
//
// It steps all path slots of an invocation together, because on a CPU two independent rays hide each other's latency. A
// step visits at most one inner node and tests at most one triangle for each slot. Traversal can stop after any step:
// cursor, nearest hit and stack outlive the dispatch.

void pushSubtree(uint slot, uint subtree) {
    uint size = path[slot].stackSize;
    if (size < stackSize) {
        stackEntries[size * slotCount() + slotIndex[slot]] = subtree;
        path[slot].stackSize = size + 1u;
        if (isCounting)
            workCounts.w = max(workCounts.w, size + 1u);
    } else {
        stackOverflowCount += 1u;
    }
}

uint popSubtree(uint slot) {
    uint size = path[slot].stackSize;
    if (size == 0u)
        return noNode;
    path[slot].stackSize = size - 1u;
    return stackEntries[(size - 1u) * slotCount() + slotIndex[slot]];
}

void enterSubtree(uint slot, uint subtree) {
    bool isLeaf = subtree != noNode && (subtree & leafFlag) != 0u;
    path[slot].cursorNode = isLeaf ? noNode : subtree;
    path[slot].cursorTriangle = isLeaf ? subtree & ~leafFlag : noNode;
}

void enterTree(uint slot) { enterSubtree(slot, 0u); }

void stopTraversal(uint slot) {
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
    path[slot].stackSize = 0u;
}

void visitNode(uint slot, BoxRay ray) {
    NodePair node = fetchNode(path[slot].cursorNode);
    countWork(slot, uvec3(1u, (node.left != noNode ? 1u : 0u) + (node.right != noNode ? 1u : 0u), 0u));
    vec2 left = boxInterval(ray, node.leftLower, node.leftUpper);
    vec2 right = boxInterval(ray, node.rightLower, node.rightUpper);
    bool isLeftHit = node.left != noNode && left.x <= lesser(left.y, path[slot].rayLength);
    bool isRightHit = node.right != noNode && right.x <= lesser(right.y, path[slot].rayLength);
    bool isRightNearer = isRightHit && (!isLeftHit || right.x < left.x);
    uint nearer = isRightNearer ? node.right : node.left;
    if (isLeftHit && isRightHit)
        pushSubtree(slot, isRightNearer ? node.left : node.right);
    if (!isLeftHit && !isRightHit)
        nearer = popSubtree(slot);
    enterSubtree(slot, nearer);
}

void visitTriangle(uint slot, TriangleRay ray, BoxRay boxRay, const bool isShadow) {
    uint record = path[slot].cursorTriangle;
    TriangleRecord triangle = fetchTriangle(record);
    countWork(slot, uvec3(0u, 0u, 1u));
    bool isLast = (triangle.flags & triangleEndsLeaf) != 0u;
    uint next = record + 1u;
    if (isLast)
        next = popSubtree(slot);
    enterSubtree(slot, isLast ? next : next | leafFlag);
    if (meetTriangle(slot, record, triangle, ray, boxRay, isShadow))
        stopTraversal(slot);
}

// Traces the rays of all slots in `stage`, until all have left the tree or the step budget is spent. isShadow: any
// opaque hit ends a ray, and glass only dims; otherwise the nearest hit is found.
void traverse(uint stage, const bool isShadow) {
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    bool isRunning = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        boxRay[slot] = makeBoxRay(path[slot].rayOrigin, path[slot].rayDirection, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(path[slot].rayOrigin, path[slot].rayDirection);
        isRunning = isRunning || (path[slot].stage == stage && isTraversing(slot));
    }
    do {
        isRunning = false;
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            countSlot(slot, path[slot].stage == stage && isTraversing(slot), uvec3(0u));
            if (path[slot].stage == stage && path[slot].cursorNode != noNode)
                visitNode(slot, boxRay[slot]);
            if (path[slot].stage == stage && path[slot].cursorTriangle != noNode)
                visitTriangle(slot, triangleRay[slot], boxRay[slot], isShadow);
            isRunning = isRunning || (path[slot].stage == stage && isTraversing(slot));
        }
        countPass();
        stepsTaken += 1u;
    } while (isRunning && stepsTaken < dispatch.stepBudget);
}
