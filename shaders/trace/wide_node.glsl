// The inner nodes of a wide tree: the boxes of up to eight children, in steps of a grid over them. Ylitie, Karras and
// Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017: children are in slots by the
// octant in which they lie, so that rays meet nearer ones first where they go through the slots in the order
// child ^ octant of their direction. What waits in the stack is a group: a node, and which of its children.
//
// Boxes enclose the children's own by the sums that are computed here (host/packing/wide_tree.h), so that no hit is lost.

layout(set = 0, binding = bindingNodes, std430) readonly buffer WideWordBuffer { uint wideWords[]; };

// Bit k is for child k ^ rayOctant(): lower bits come first.
uint rayOctant(uint i) {
    bvec3 isNegative = lessThan(traversal[i].ray.direction, vec3(0.0));
    return (isNegative.x ? 1u : 0u) | (isNegative.y ? 2u : 0u) | (isNegative.z ? 4u : 0u);
}

// The first child of a group; the others wait.
uint takeChild(uint i, uint node, uint group) {
    uint rest = group & (group - 1u);
    if (rest != 0u)
        pushEntry(i, node << 8u | rest);
    uint child = uint(findLSB(group)) ^ rayOctant(i);
    return wideWords[node * wideNodeWords + wideNodeChildren + child];
}

uint nextSubtree(uint i) {
    uint entry = popEntry(i);
    return entry >= leaveInstance ? entry : takeChild(i, entry >> 8u, entry & 0xFFu);
}

// Coordinate of a plane: that of the byte `child` of the two words, in steps of the grid from its origin.
float widePlane(float origin, float cell, uint first, uint last, const uint child) {
    return origin + cell * float((child < 4u ? first : last) >> 8u * (child & 3u) & 0xFFu);
}

uint visitNode(uint i, BoxRay ray, InstanceRecord instance) {
    uint index = traversal[i].cursorNode;
    WideNode node = fetchWideNode(index);
    countWork(i, true, uvec3(1u, bitCount(node.grid >> 24u), 0u));
    vec3 cell = uintBitsToFloat(uvec3(node.grid << 23u, node.grid >> 8u << 23u, node.grid >> 16u << 23u) & 0x7F800000u);
    uint octant = rayOctant(i);
    uint group = 0u;
    [[unroll]] for (uint child = 0u; child < 8u; ++child) {
        vec3 lower = vec3(widePlane(node.origin.x, cell.x, node.lowerX0, node.lowerX1, child),
                          widePlane(node.origin.y, cell.y, node.lowerY0, node.lowerY1, child),
                          widePlane(node.origin.z, cell.z, node.lowerZ0, node.lowerZ1, child));
        vec3 upper = vec3(widePlane(node.origin.x, cell.x, node.upperX0, node.upperX1, child),
                          widePlane(node.origin.y, cell.y, node.upperY0, node.upperY1, child),
                          widePlane(node.origin.z, cell.z, node.upperZ0, node.upperZ1, child));
        vec2 interval = nodeInterval(i, ray, instance, lower, upper);
        bool isHit = (node.grid >> (24u + child) & 1u) != 0u && interval.x <= lesser(interval.y, traversal[i].hit.distance);
        group |= isHit ? 1u << (child ^ octant) : 0u;
    }
    uint next;
    if (group != 0u)
        next = takeChild(i, index, group);
    else
        next = nextSubtree(i);
    return next;
}
