// The beginning of every integrator's kernel. RAYS is the number of path slots an invocation; further macros are choices
// (shaders/CMakeLists.txt has the rows):
//
//   MEMORY_TEXELS        1: the scene is read through texel buffers; 0: through storage buffers
//   TRAVERSAL_SKIP_LIST  1: the tree is a skip list without a stack; 0: nodes and a stack
//   TRAVERSAL_RAY_QUERY  1: the tree is the device's own; 0: ours. Not for skip lists
//   TREE_WIDE            1: nodes have up to eight children; 0: pairs. Not for skip lists
//   DRIVE_PLAIN          1: a lane goes on with whatever its path asks for; 0: lanes are in stages together
//   LANES_SHUFFLE        1: lanes of a subgroup exchange values; 0: lanes are independent
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#if TRAVERSAL_RAY_QUERY
#extension GL_EXT_ray_query : require
#endif
#if LANES_SHUFFLE
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif

#include "shaders/layout/layout.h"
#include "shaders/layout/buffers.h"
#include "layout_macros.h"

layout(local_size_x_id = 0) in;

#include "shaders/memory/bindings.glsl"
