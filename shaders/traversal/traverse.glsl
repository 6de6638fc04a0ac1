// The traversal of the tree: enterTree, stopTraversal, isTraversing, traverse.
#if TRAVERSAL_SKIP_LIST
#include "shaders/traversal/traverse_skip.glsl"
#else
#include "shaders/traversal/traverse_stack.glsl"
#endif
