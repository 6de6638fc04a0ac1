// The contract of the denoiser's kernels (shaders/post): a noisy picture, and what the passes hand on. Compiled as C++
// and as GLSL.
#ifndef HYALITE_DENOISER_RECORDS_H
#define HYALITE_DENOISER_RECORDS_H

#ifdef __cplusplus
#include "shaders/layout/layout.h"

namespace hyalite::core::layout {
#endif

// What the denoiser reads of a pixel. Colours are linear radiance.
struct NoisyPixel {
    vec3 colour;      // the mean of all samples
    float firstShare; // of the samples that are the first ones, in (0, 1)
    vec3 first;       // the mean of the first ones
    float depth;      // of what is seen beyond mirrors and glass, as are albedo and normal
    vec3 variance;    // of the mean of all samples, if they were independent
    uint unused0;
    vec3 albedo;
    uint unused1;
    vec3 normal;
    uint unused2;
};

#ifdef __cplusplus
static_assert(sizeof(NoisyPixel) == 80 && offsetof(NoisyPixel, normal) == 64);
} // namespace hyalite::core::layout
#endif
#endif
