// Kernel inputs beside the scene (scene_data.glsl): buffers, push constants and specialization constants. layout.h and
// buffers.h describe them.

layout(set = 0, binding = bindingFrame, std140) uniform FrameBuffer { FrameRecord frameConstants; };
layout(set = 0, binding = bindingProgress, std430) coherent buffer ProgressBuffer { DispatchProgress progress; };
layout(set = 0, binding = bindingFilm, std430) buffer FilmBuffer { uint filmWords[]; };
layout(set = 0, binding = bindingPaths, std430) buffer PathBuffer { PathRecord pathRecords[]; };
layout(set = 0, binding = bindingStacks, std430) buffer StackBuffer { uint stackEntries[]; };
layout(set = 0, binding = bindingTrace, std430) writeonly buffer TraceBuffer { TraceEvent traceEvents[]; };

layout(push_constant) uniform DispatchBlock { DispatchConstants dispatchConstants; };

layout(constant_id = constantSphereCount) const uint sphereCount = 0u; // outside the tree
layout(constant_id = constantHasTriangles) const bool hasTriangles = true;
layout(constant_id = constantHasNormals) const bool hasNormals = true;
layout(constant_id = constantHasInstances) const bool hasInstances = true;
layout(constant_id = constantTreeSpheres) const uint treeSpheres = treeHasTriangles;
layout(constant_id = constantHasSpecular) const bool hasSpecular = true;
layout(constant_id = constantHasDielectric) const bool hasDielectric = true;
layout(constant_id = constantSampler) const uint samplerKind = samplerSobol;
layout(constant_id = constantStackSize) const uint stackSize = maxTreeDepth;
layout(constant_id = constantSamplesInFlight) const uint samplesInFlight = 1u;
layout(constant_id = constantLightCount) const uint lightCount = 1u;
layout(constant_id = constantPendingInRegisters) const uint pendingInRegisters = 0u;
layout(constant_id = constantEmitterCount) const uint emitterCount = 0u;
layout(constant_id = constantHasLightTree) const bool hasLightTree = false;
layout(constant_id = constantInfiniteEmitters) const uint infiniteEmitterCount = 0u;
layout(constant_id = constantHasEmission) const bool hasEmission = true;
layout(constant_id = constantIsCounting) const bool isCounting = false;
layout(constant_id = constantShowsCost) const bool showsCost = false;
layout(constant_id = constantIsTracing) const bool isTracing = false;
layout(constant_id = constantIsResumable) const bool isResumable = true;
layout(constant_id = constantScattering) const uint scattering = 0u;
layout(constant_id = constantLighting) const uint lighting = 0u;
layout(constant_id = constantCamera) const uint camera = cameraPinhole;
layout(constant_id = constantTexturing) const uint texturing = 0u;
layout(constant_id = constantAnyHit) const uint anyHit = 0u;
layout(constant_id = constantAlpha) const uint alphaKind = alphaOfNothing;
const bool hasAlpha = alphaKind != alphaOfNothing;
layout(constant_id = constantTrianglePairs) const uint trianglePairs = 0u;
layout(constant_id = constantPathRegeneration) const bool regeneratesPaths = false;
layout(constant_id = constantBroadcasts) const bool exchangesByBroadcast = false;
layout(constant_id = constantPlaceCount) const uint placeCount = 1u;
layout(constant_id = constantTallies) const bool tallies = false;
layout(constant_id = constantLightClasses) const uint lightClasses = 0u;
layout(constant_id = constantLightGroups) const uint lightGroups = 0u;
layout(constant_id = constantHasPairs) const bool hasPairs = false;
layout(constant_id = constantExactDivision) const bool hasExactDivision = false;

// Copies of the constants. Entry kernels begin with loadConstants(), and all other code reads the copies, because
// inside loops and branches lavapipe loads every word of a uniform buffer and of the push constants lane by lane. No
// branch and no loop length may depend on them alone: lavapipe would compile the values into the kernel, anew for each
// dispatch (tests/kernels/uniform_branch_test.cpp).
FrameRecord frame;
DispatchConstants dispatch;

void loadConstants() {
    frame = frameConstants;
    dispatch = dispatchConstants;
}

uint pathCount() { return dispatch.tileWidth * dispatch.tileHeight * samplesInFlight; } // of the tile
