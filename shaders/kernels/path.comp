// Entry kernel: the path integrator, RAYS path slots an invocation, over a stack or a skip list (SKIP_LIST=1).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#if SKIP_LIST
#extension GL_KHR_shader_subgroup_shuffle : require
#endif

#include "shaders/layout/layout.h"

layout(local_size_x_id = 0) in;

#include "shaders/memory/bindings.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = hasEmission;
const bool hasBounces = true;

#include "shaders/memory/scene_data.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"
#include "shaders/traversal/preloaded.glsl"
#include "shaders/integrators/path_slots.glsl"
#include "shaders/memory/film.glsl"
#include "shaders/traversal/meet_triangle.glsl"
#if SKIP_LIST
#include "shaders/traversal/traverse_skip.glsl"
#else
#include "shaders/traversal/traverse_stack.glsl"
#endif
#include "shaders/traversal/rays.glsl"
#include "shaders/integrators/integrate.glsl"
#include "shaders/integrators/path.glsl"

void main() { integrate(); }
