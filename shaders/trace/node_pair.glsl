// The inner nodes of a tree of node pairs: two boxes each. What waits in the stack is a subtree.

uint nextSubtree(uint i) { return popEntry(i); }

uint visitNode(uint i, BoxRay ray, InstanceRecord instance) {
    NodePair node = fetchNode(traversal[i].cursorNode);
    countWork(i, true, uvec3(1u, (node.left != noNode ? 1u : 0u) + (node.right != noNode ? 1u : 0u), 0u));
    vec2 left = nodeInterval(i, ray, instance, node.leftLower, node.leftUpper);
    vec2 right = nodeInterval(i, ray, instance, node.rightLower, node.rightUpper);
    bool isLeftHit = node.left != noNode && left.x <= lesser(left.y, traversal[i].hit.distance);
    bool isRightHit = node.right != noNode && right.x <= lesser(right.y, traversal[i].hit.distance);
    bool isRightNearer = isRightHit && (!isLeftHit || right.x < left.x);
    uint nearer = isRightNearer ? node.right : node.left;
    if (isLeftHit && isRightHit)
        pushEntry(i, isRightNearer ? node.left : node.right);
    if (!isLeftHit && !isRightHit)
        nearer = nextSubtree(i);
    return nearer;
}
