// Entry kernel: the path integrator, RAYS path slots an invocation, over a stack or a skip list (SKIP_LIST=1).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#if SKIP_LIST
#extension GL_KHR_shader_subgroup_shuffle : require
#endif

#include "layout.h"

layout(local_size_x_id = 0) in;

#include "bindings.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = hasEmission;
const bool hasBounces = true;

#include "scene_data.glsl"
#include "arithmetic.glsl"
#include "vector.glsl"
#include "random.glsl"
#include "functions.glsl"
#include "camera.glsl"
#include "box.glsl"
#include "triangle.glsl"
#include "sphere.glsl"
#include "dielectric.glsl"
#include "media.glsl"
#include "sampling.glsl"
#include "surface.glsl"
#include "texture.glsl"
#include "normal_map.glsl"
#include "emitter_density.glsl"
#include "lights.glsl"
#include "environment.glsl"
#include "emitters.glsl"
#include "conductor.glsl"
#include "microfacet.glsl"
#include "energy.glsl"
#include "rough.glsl"
#include "preloaded.glsl"
#include "path_slots.glsl"
#include "film.glsl"
#include "meet_triangle.glsl"
#if SKIP_LIST
#include "traverse_skip.glsl"
#else
#include "traverse_stack.glsl"
#endif
#include "rays.glsl"
#include "integrate.glsl"
#include "path.glsl"

void main() { integrate(); }
