// Entry kernel: the Whitted integrator, RAYS path slots an invocation, over a stack or a skip list (SKIP_LIST=1).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "layout.h"

layout(local_size_x_id = 0) in;

#include "bindings.glsl"
#include "scene_data.glsl"
#include "arithmetic.glsl"
#include "vector.glsl"
#include "random.glsl"
#include "camera.glsl"
#include "box.glsl"
#include "triangle.glsl"
#include "sphere.glsl"
#include "dielectric.glsl"
#include "surface.glsl"
#include "path_slots.glsl"
#include "meet_triangle.glsl"
#if SKIP_LIST
#include "traverse_skip.glsl"
#else
#include "traverse_stack.glsl"
#endif
#include "whitted.glsl"

void main() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        loadSlot(slot);
    while (isUnfinished() && stepsTaken < dispatch.stepBudget)
        advancePaths();
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        storeSlot(slot);
    addProgress();
}
