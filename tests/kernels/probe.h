// The functions that the probe kernel can run, by their numbers: compiled as C++ and as GLSL.
#ifndef HYALITE_PROBE_H
#define HYALITE_PROBE_H

#ifdef __cplusplus
#include "shaders/layout/buffers.h"

namespace hyalite::core::testing {
using layout::bindingCount;
using layout::constantCount;
using layout::uint;
#endif

const uint probeDotProduct = 0u;
const uint probeCrossProduct = 1u;
const uint probeVectorLength = 2u;
const uint probeUnitVector = 3u;
const uint probeMirrorDirection = 4u;
const uint probeLargestComponent = 5u;
const uint probeSmallestComponent = 6u;
const uint probeHashKeys = 7u;
const uint probeOwenScramble = 8u;
const uint probeSecondSobolCoordinate = 9u;
const uint probeUnitFloat = 10u;
const uint probeSamplePixel = 11u;
const uint probePrimaryDirection = 12u;
const uint probeMakeBoxRay = 13u;
const uint probeBoxInterval = 14u;
const uint probeMakeTriangleRay = 15u;
const uint probeIntersectTriangle = 16u;
const uint probeTrianglePoint = 17u;
const uint probeTrianglePointError = 18u;
const uint probeIntersectSphere = 19u;
const uint probeRefractRay = 20u;
const uint probeSphereSurface = 21u;
const uint probeTriangleSurface = 22u;
const uint probeOffsetRayOrigin = 23u;
const uint probeDivide = 24u;
const uint probeSquareRoot = 25u;
const uint probeSampleBits = 26u;
const uint probeSineCosine = 27u;
const uint probeExpNegative = 28u;
const uint probeSampleCosine = 29u;
const uint probeSampleTriangle = 30u;
const uint probeSampleCone = 31u;
const uint probeSampleSphere = 32u;
const uint probePowerHeuristic = 33u;
const uint probeFresnelDielectric = 34u;
const uint probeMedia = 35u;
const uint probeSolidAnglePdf = 36u;
const uint probePdfSphereLight = 37u;
const uint probeConductorReflectance = 38u;
const uint probeFacets = 39u;
const uint probeFacetsAcross = 40u;
const uint probeEnergy = 41u;
const uint probeBsdf = 42u;
const uint probeAtan2Turns = 43u;
const uint probeSpotFalloff = 44u;
const uint probeEnvironmentFrom = 45u;
const uint probeSampleEnvironment = 46u;
const uint probePrimaryRay = 47u;
const uint probeLookUpTexture = 48u;
const uint probeTriangleUv = 49u;
const uint probeSphereUv = 50u;
const uint probeMappedNormal = 51u;
const uint probeVisibleNormal = 52u;
const uint probePlacedBoxInterval = 53u;
const uint probePlacedPoint = 54u;
const uint probePlacedNormal = 55u;
const uint probeIntersectPair = 56u;

// Two bindings and three specialization constants beyond those of the renderer's kernels.
const uint bindingProbeInputs = bindingCount;
const uint bindingProbeOutputs = bindingCount + 1u;
const uint probeBindingCount = bindingCount + 2u;
const uint constantProbedFunction = constantCount;
const uint constantInputWords = constantCount + 1u; // of one input
const uint constantOutputWords = constantCount + 2u;
const uint probeConstantCount = constantCount + 3u;

#ifdef __cplusplus
} // namespace hyalite::core::testing
#endif
#endif
