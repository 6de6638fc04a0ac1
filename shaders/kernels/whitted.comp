// Entry kernel: the Whitted integrator.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = hasDielectric;
const bool raysHaveTargets = false;
const bool hasBounces = false;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/pending_rays.glsl"
#include "shaders/integrators/whitted.glsl"

void main() { integrate(); }
