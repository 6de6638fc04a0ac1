// What a kernel is given beside the scene (scene_data.glsl): buffers, push constants and specialization constants, as
// layout.h describes them.

layout(set = 0, binding = bindingFrame, std140) uniform FrameBuffer { FrameRecord frameConstants; };
layout(set = 0, binding = bindingProgress, std430) coherent buffer ProgressBuffer { DispatchProgress progress; };
layout(set = 0, binding = bindingPaths, std430) buffer PathBuffer { PathRecord pathRecords[]; };
layout(set = 0, binding = bindingStacks, std430) buffer StackBuffer { uint stackEntries[]; };
layout(set = 0, binding = bindingTrace, std430) writeonly buffer TraceBuffer { TraceEvent traceEvents[]; };

layout(push_constant) uniform DispatchBlock { DispatchConstants dispatchConstants; };

layout(constant_id = constantSphereCount) const uint sphereCount = 0u;
layout(constant_id = constantHasTriangles) const bool hasTriangles = true;
layout(constant_id = constantHasSpecular) const bool hasSpecular = true;
layout(constant_id = constantHasDielectric) const bool hasDielectric = true;
layout(constant_id = constantSampler) const uint samplerKind = samplerSobol;
layout(constant_id = constantStackSize) const uint stackSize = maxTreeDepth;
layout(constant_id = constantSamplesAbreast) const uint samplesAbreast = 1u;
layout(constant_id = constantLightCount) const uint lightCount = 1u;
layout(constant_id = constantPendingInRegisters) const uint pendingInRegisters = 0u;
layout(constant_id = constantEmitterCount) const uint emitterCount = 0u;
layout(constant_id = constantHasEmission) const bool hasEmission = true;
// Drivers read all of a kernel before they leave out what constants tell them to, and take their time: what few renders
// need is left out of kernels with RICH=0 (batching.cpp says when they will do). Over skip lists, which are for lavapipe,
// these also rely on its own division, and do not go on with samples that did not fit into a dispatch.
#ifndef RICH
#define RICH 1
#endif
#if RICH
layout(constant_id = constantIsCounting) const bool isCounting = false;
layout(constant_id = constantShowsCost) const bool showsCost = false;
layout(constant_id = constantIsTracing) const bool isTracing = false;
layout(constant_id = constantScattering) const uint scattering = 0u;
layout(constant_id = constantLighting) const uint lighting = 0u;
layout(constant_id = constantCamera) const uint camera = cameraPinhole;
layout(constant_id = constantTexturing) const uint texturing = 0u;
#else
const bool isCounting = false;
const bool showsCost = false;
const bool isTracing = false;
const uint scattering = 0u;
const uint lighting = 0u;
const uint camera = cameraPinhole;
const uint texturing = 0u;
#endif
#if RICH || !SKIP_LIST
layout(constant_id = constantExactDivision) const bool hasExactDivision = false;
layout(constant_id = constantIsResumable) const bool isResumable = true;
#else
const bool hasExactDivision = true;
const bool isResumable = false;
#endif

// Entry kernels begin with loadConstants(), and everything else reads these copies: inside of loops and branches
// lavapipe loads every word of a uniform buffer and of the push constants lane by lane.
FrameRecord frame;
DispatchConstants dispatch;

void loadConstants() {
    frame = frameConstants;
    dispatch = dispatchConstants;
}
