// The contract of fill_words.comp and compare_words.comp, which exercise memory and arithmetic of a device and compare
// what came of it. Compiled as C++ and as GLSL.
#ifndef HYALITE_EXERCISE_RECORDS_H
#define HYALITE_EXERCISE_RECORDS_H

#include "shaders/layout/layout.h"

#ifdef __cplusplus
#include <glm/common.hpp>

namespace hyalite::core::layout {
using glm::floatBitsToUint;
using glm::uintBitsToFloat;
#define HYALITE_INLINE inline
#else
#define HYALITE_INLINE
#endif

/// A word that is not as it should be.
struct WrongWord {
    uint index;
    uint found;
    uint expected;
};

const uint maxWrongWords = 64u; // of which the comparison tells more than their number

// Word i of a buffer is wordOf((i + offset) % period, rounds) ^ mask. Of films, which are compared only, any word.
struct WordTask {
    uint wordCount;
    uint period; // > 0; prime: words whose addresses differ in a bit are not alike
    uint offset; // wordCount + offset < 2^32
    uint mask;
    uint rounds;
    // What a comparison finds.
    uint wrongCount;
    uint firstWrong; // the least index, or noWord
    uint recordedCount;
};

const uint noWord = 0xFFFFFFFFu;

/// A permutation of 32 bits (O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
/// Random Number Generation", 2014: RXS-M-XS).
HYALITE_INLINE uint permuted(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// A word whose every bit depends on all that computed it: integer products, shifts, and sums and products of floats
/// from 1 to 6, whose rounding IEEE 754 fixes.
HYALITE_INLINE uint wordOf(uint index, uint rounds) {
    uint x = permuted(index);
    for (uint i = 0u; i < rounds; ++i) {
        float a = uintBitsToFloat(0x3F800000u | (x >> 9u));
        float b = uintBitsToFloat(0x3F800000u | (x & 0x7FFFFFu));
        float c = a * b + a - b * 0.25f;
        x = permuted(x ^ floatBitsToUint(c));
    }
    return x;
}

#ifdef __cplusplus
} // namespace hyalite::core::layout
#endif
#undef HYALITE_INLINE
#endif
