// The traversal of the tree: enterTree, stopTraversal, isTraversing, traverse.
#if TRAVERSAL_SKIP_LIST
#include "shaders/traversal/traverse_skip.glsl"
#include "shaders/traversal/traverse_list.glsl"

void traverse(uint stage, const bool isShadow) {
    Meeting waiting[RAYS]; // never used
    if (trianglePairs > 0u)
        traverseList(stage, isShadow);
    else if ((passing & passesSheer) != 0u)
        traverseSheerTree(stage, isShadow);
    else
        traverseTree(stage, isShadow, waiting);
}
#else
#include "shaders/traversal/traverse_stack.glsl"
#endif
