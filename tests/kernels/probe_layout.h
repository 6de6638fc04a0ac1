// Buffers and constants of the probe kernel: compiled as C++ and as GLSL.
#ifndef HYALITE_PROBE_LAYOUT_H
#define HYALITE_PROBE_LAYOUT_H

#ifdef __cplusplus
#include "shaders/layout/buffers.h"

namespace hyalite::core::testing {
using layout::bindingCount;
using layout::constantCount;
using layout::uint;
#endif

// Two bindings and three specialization constants beyond those of the renderer's kernels.
const uint bindingProbeInputs = bindingCount;
const uint bindingProbeOutputs = bindingCount + 1u;
const uint probeBindingCount = bindingCount + 2u;
const uint constantProbedFunction = constantCount;  // its number, or one of the two below
const uint constantInputWords = constantCount + 1u; // of one input
const uint constantOutputWords = constantCount + 2u;
const uint probeConstantCount = constantCount + 3u;

// Functions beside the leaves.
const uint probedQuotient = 0xFFFFFFFFu; // divide
const uint probedRoot = 0xFFFFFFFEu;     // squareRoot

#ifdef __cplusplus
} // namespace hyalite::core::testing
#endif
#endif
