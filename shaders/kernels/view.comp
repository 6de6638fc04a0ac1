// Entry kernel: views of what primary rays meet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = false;
const bool hasBounces = false;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/view.glsl"

void main() { integrate(); }
