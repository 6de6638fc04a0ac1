// Traversals. Each defines
//
//   void enterTree(uint i), void stopTraversal(uint i)           begin and end of the cursor of ray i
//   void advance(bool takesPart[RAYS], const bool isVisibility)  takes rays on, several at once
//
// until all have left the tree, or no steps are left: it can stop after any step and go on in another dispatch, but for ray
// queries. The state of rays is in arrays that functions share (ray.glsl), and no parameter, because functions copy these.

// A statement for each ray of an invocation. One ray has no loop, so that its state is in registers from the beginning.
#if RAYS == 1
#define EACH_RAY(i, statement) { const uint i = 0u; statement }
#else
#define EACH_RAY(i, statement) [[unroll]] for (uint i = 0u; i < RAYS; ++i) { statement }
#endif

#include "shaders/trace/any_hit.glsl"
#if TRAVERSAL_SKIP_LIST
#include "shaders/trace/skip_list.glsl"
#elif TRAVERSAL_RAY_QUERY
#include "shaders/trace/ray_query.glsl"
#else
#include "shaders/trace/stack.glsl"
#endif
