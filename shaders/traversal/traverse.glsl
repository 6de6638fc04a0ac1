// The traversal of the tree: enterTree, stopTraversal, isTraversing, traverse.
#if TRAVERSAL_SKIP_LIST
#include "shaders/traversal/traverse_skip.glsl"
#include "shaders/traversal/traverse_list.glsl"

void traverse(uint stage, const bool isShadow) {
    Candidate waiting[RAYS]; // never used
    if (trianglePairs > 0u)
        traverseList(stage, isShadow);
    else if ((anyHit & anyHitAlpha) != 0u)
        traverseAlphaTestedTree(stage, isShadow);
    else
        traverseTree(stage, isShadow, waiting);
}
#else
#include "shaders/traversal/traverse_stack.glsl"
#endif
