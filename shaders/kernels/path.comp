// Entry kernel: the path integrator.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = hasEmission;
const bool hasBounces = true;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/path.glsl"

void main() { integrate(); }
