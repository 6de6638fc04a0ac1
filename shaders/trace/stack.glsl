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

// Enters a subtree, and on the way an instance, or leaves one.
void enterSubtree(uint slot, uint subtree) {
    if (hasInstances && subtree == leaveInstance) {
        path[slot].cursorInstance = noInstance;
        subtree = popSubtree(slot);
    }
    if (hasInstances && isInstance(subtree)) {
        pushSubtree(slot, leaveInstance);
        path[slot].cursorInstance = instanceOf(subtree);
        subtree = fetchInstance(path[slot].cursorInstance).root;
    }
    bool isLeaf = subtree != noNode && (subtree & leafFlag) != 0u;
    path[slot].cursorNode = isLeaf ? noNode : subtree;
    path[slot].cursorTriangle = isLeaf ? subtree & ~leafFlag : noNode;
}

void enterTree(uint slot) {
    path[slot].cursorInstance = noInstance;
    enterSubtree(slot, 0u);
}

void stopTraversal(uint slot) {
    path[slot].cursorNode = noNode;
    path[slot].cursorTriangle = noNode;
    path[slot].cursorInstance = noInstance;
    path[slot].stackSize = 0u;
}

// The interval of a box, placed by `instance` if the cursor is in one.
vec2 nodeInterval(uint slot, BoxRay ray, InstanceRecord instance, vec3 lower, vec3 upper) {
    if (hasInstances && path[slot].cursorInstance != noInstance) {
        PlacedBoxRay placedRay = makePlacedBoxRay(ray, instance);
        return placedBoxInterval(placedRay, 0.5 * (lower + upper), 0.5 * (upper - lower));
    }
    return boxInterval(ray, lower, upper);
}

void visitNode(uint slot, BoxRay ray, InstanceRecord instance) {
    NodePair node = fetchNode(path[slot].cursorNode);
    countWork(slot, uvec3(1u, (node.left != noNode ? 1u : 0u) + (node.right != noNode ? 1u : 0u), 0u));
    vec2 left = nodeInterval(slot, ray, instance, node.leftLower, node.leftUpper);
    vec2 right = nodeInterval(slot, ray, instance, node.rightLower, node.rightUpper);
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

void visitTriangle(uint slot, TriangleRay ray, BoxRay boxRay, InstanceRecord instance, const bool isShadow) {
    uint record = path[slot].cursorTriangle;
    uint instanceIndex = path[slot].cursorInstance;
    TriangleRecord triangle = fetchTriangle(record);
    if (hasInstances && instanceIndex != noInstance)
        triangle = placedTriangle(instance, triangle);
    countWork(slot, uvec3(0u, 0u, 1u));
    bool isLast = (triangle.flags & triangleEndsLeaf) != 0u;
    uint next = record + 1u;
    if (isLast)
        next = popSubtree(slot);
    enterSubtree(slot, isLast ? next : next | leafFlag);
    if (meetTriangle(slot, record, instanceIndex, triangle, ray, boxRay, isShadow))
        stopTraversal(slot);
}

// Keeps `instance`, whose index is `loaded`, that of the cursor.
void loadInstance(uint slot, inout uint loaded, inout InstanceRecord instance) {
    uint index = path[slot].cursorInstance;
    if (!hasInstances || index == noInstance || index == loaded)
        return;
    instance = fetchInstance(index);
    loaded = index;
}

// Traces the rays of all slots in `stage`, until all have left the tree or the step budget is spent. isShadow: any
// opaque hit ends a ray, and glass only dims; otherwise the nearest hit is found.
void traverse(uint stage, const bool isShadow) {
    BoxRay boxRay[RAYS];
    TriangleRay triangleRay[RAYS];
    InstanceRecord instance[RAYS];
    uint instanceIndex[RAYS]; // of `instance`
    bool isRunning = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
        boxRay[slot] = makeBoxRay(path[slot].rayOrigin, path[slot].rayDirection, frame.boundsLower, frame.boundsUpper);
        triangleRay[slot] = makeTriangleRay(path[slot].rayOrigin, path[slot].rayDirection);
        instanceIndex[slot] = noInstance;
        isRunning = isRunning || (path[slot].stage == stage && isTraversing(slot));
    }
    do {
        isRunning = false;
        [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot) {
            countSlot(slot, path[slot].stage == stage && isTraversing(slot), uvec3(0u));
            if (path[slot].stage == stage && path[slot].cursorNode != noNode) {
                loadInstance(slot, instanceIndex[slot], instance[slot]);
                visitNode(slot, boxRay[slot], instance[slot]);
            }
            if (path[slot].stage == stage && path[slot].cursorTriangle != noNode) {
                loadInstance(slot, instanceIndex[slot], instance[slot]);
                visitTriangle(slot, triangleRay[slot], boxRay[slot], instance[slot], isShadow);
            }
            isRunning = isRunning || (path[slot].stage == stage && isTraversing(slot));
        }
        countPass();
        stepsTaken += 1u;
    } while (isRunning && stepsTaken < dispatch.stepBudget);
}
