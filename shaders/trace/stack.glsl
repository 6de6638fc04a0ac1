// The traversals with an explicit stack, over node pairs or wide nodes in storage buffers. The files of nodes define
//
//   uint nextSubtree(uint i)                                         the subtree that is next in the stack, or noNode
//   uint visitNode(uint i, BoxRay ray, InstanceRecord instance)      tests boxes, and returns the subtree to go on with
//
// A step visits at most one inner node and tests at most one triangle for each ray. Traversal can stop after any step:
// cursor, nearest hit and stack outlive the dispatch.

void pushEntry(uint i, uint entry) {
    uint size = traversal[i].stackSize;
    if (size < stackSize) {
        stackEntries[size * pathCount() + traversal[i].stackIndex] = entry;
        traversal[i].stackSize = size + 1u;
        if (isCounting)
            workCounts.w = max(workCounts.w, size + 1u);
    } else {
        stackOverflowCount += 1u;
    }
}

uint popEntry(uint i) {
    uint size = traversal[i].stackSize;
    if (size == 0u)
        return noNode;
    traversal[i].stackSize = size - 1u;
    return stackEntries[(size - 1u) * pathCount() + traversal[i].stackIndex];
}

// The interval of a box, placed by `instance` if the cursor is in one.
vec2 nodeInterval(uint i, BoxRay ray, InstanceRecord instance, vec3 lower, vec3 upper) {
    if (hasInstances && traversal[i].cursorInstance != noInstance) {
        PlacedBoxRay placedRay = makePlacedBoxRay(ray, instance);
        return placedBoxInterval(placedRay, 0.5 * (lower + upper), 0.5 * (upper - lower));
    }
    return boxInterval(ray, lower, upper);
}

#if TREE_WIDE
#include "shaders/trace/wide_node.glsl"
#else
#include "shaders/trace/node_pair.glsl"
#endif

// Enters a subtree, and on the way an instance, or leaves one.
void enterSubtree(uint i, uint subtree) {
    if (hasInstances && subtree == leaveInstance) {
        traversal[i].cursorInstance = noInstance;
        subtree = nextSubtree(i);
    }
    if (hasInstances && isInstance(subtree)) {
        pushEntry(i, leaveInstance);
        traversal[i].cursorInstance = instanceOf(subtree);
        subtree = fetchInstance(traversal[i].cursorInstance).root;
    }
    bool isLeaf = subtree != noNode && (subtree & leafFlag) != 0u;
    traversal[i].cursorNode = isLeaf ? noNode : subtree;
    traversal[i].cursorTriangle = isLeaf ? subtree & ~leafFlag : noNode;
}

void enterTree(uint i) {
    traversal[i].cursorInstance = noInstance;
    enterSubtree(i, 0u);
}

void stopTraversal(uint i) {
    traversal[i].cursorNode = noNode;
    traversal[i].cursorTriangle = noNode;
    traversal[i].cursorInstance = noInstance;
    traversal[i].stackSize = 0u;
}

void visitTriangle(uint i, TriangleRay ray, BoxRay boxRay, InstanceRecord instance,
                   const bool isVisibility) {
    uint record = traversal[i].cursorTriangle;
    uint instanceIndex = traversal[i].cursorInstance;
    TriangleRecord triangle = fetchTriangle(record);
    if (hasInstances && instanceIndex != noInstance)
        triangle = placedTriangle(instance, triangle);
    countWork(i, true, uvec3(0u, 0u, 1u));
    bool isLast = (triangle.flags & triangleEndsLeaf) != 0u;
    uint next = record + 1u;
    if (isLast)
        next = nextSubtree(i);
    enterSubtree(i, isLast ? next : next | leafFlag);
    if (meetTriangle(i, record, instanceIndex, triangle, ray, boxRay, isVisibility))
        stopTraversal(i);
}

struct StackWalk {
    BoxRay box;
    TriangleRay triangle;
    InstanceRecord instance;
    uint loaded; // the index of `instance`
};

StackWalk walks[RAYS];

void beginWalk(uint i) {
    walks[i].box =
        makeBoxRay(traversal[i].ray.origin, traversal[i].ray.direction, frame.boundsLower, frame.boundsUpper);
    walks[i].triangle = makeTriangleRay(traversal[i].ray.origin, traversal[i].ray.direction);
    walks[i].loaded = noInstance;
}

// Keeps the walk's instance that of the cursor.
void loadInstance(uint i) {
    uint index = traversal[i].cursorInstance;
    if (!hasInstances || index == noInstance || index == walks[i].loaded)
        return;
    walks[i].instance = fetchInstance(index);
    walks[i].loaded = index;
}

// Returns whether the ray goes on.
bool stepWalk(uint i, bool takesPart, const bool isVisibility) {
    countBusyRay(takesPart && isTraversing(i));
    if (takesPart && traversal[i].cursorNode != noNode) {
        loadInstance(i);
        enterSubtree(i, visitNode(i, walks[i].box, walks[i].instance));
    }
    if (takesPart && traversal[i].cursorTriangle != noNode) {
        loadInstance(i);
        visitTriangle(i, walks[i].triangle, walks[i].box, walks[i].instance, isVisibility);
    }
    return takesPart && isTraversing(i);
}

void advance(bool takesPart[RAYS], const bool isVisibility) {
    EACH_RAY(i, beginWalk(i);)
    bool isRunning;
    do {
        isRunning = false;
        EACH_RAY(i, isRunning = stepWalk(i, takesPart[i], isVisibility) || isRunning;)
        countPass();
        stepsTaken += 1u;
    } while (isRunning && hasStepsLeft());
}
