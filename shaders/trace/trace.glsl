// The traversal of the tree: enterTree, stopTraversal, isTraversing, traverse.
#if TRAVERSAL_SKIP_LIST
#include "shaders/trace/skip_list.glsl"
#include "shaders/trace/list.glsl"

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
#include "shaders/trace/stack.glsl"
#endif
