// The contract of startup_check.comp: operands, and what the device makes of them. Compiled as C++ and as GLSL.
#ifndef HYALITE_CHECK_RECORDS_H
#define HYALITE_CHECK_RECORDS_H

#ifdef __cplusplus
#include "shaders/layout/layout.h"

namespace hyalite::core::layout {
#endif

struct HardInput {
    float numerator;
    float denominator;
    float square; // its root is hard to round
    int integer;  // hard to round to a float
    float addend;
    float otherAddend;
    float factor;
    float otherFactor;
};

struct CheckResult {
    float quotient;
    float root;
    float sum;
    float difference;
    float product;
    float rounded;    // the integer
    int truncated;    // the numerator
    uint comparisons; // a bit each
    uint subgroup;    // in the workgroup
    uint lane;        // in the subgroup
    // Unused by the host: it makes the code differ by the width of vectors, which the key of Mesa's disk cache leaves
    // out.
    uint subgroupSize;
    uint pad1;
};

const uint isLess = 1u; // addend < otherAddend, and so on
const uint isAtMost = 2u;
const uint isEqual = 4u;
const uint isSumGreater = 8u;   // than the addend
const uint areZerosEqual = 16u; // 0 and -0
const uint isZeroNotLess = 32u; // -0 than 0

#ifdef __cplusplus
} // namespace hyalite::core::layout
#endif
#endif
