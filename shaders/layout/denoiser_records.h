// The contract of the denoiser's kernels (shaders/post): a noisy picture, what the passes hand on, and how far they
// look. Compiled as C++ and as GLSL.
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

// Pixels that a pass reads on each side of its own.
const int fireflyRadius = 2;
const int varianceRadius = 3;
const int guideRadius = 1;
const int regressionRadius = 5;
const int errorRadius = 2;
const int choiceRadius = 2;
const uint denoiserMargin =
    uint(fireflyRadius + varianceRadius + guideRadius + regressionRadius + errorRadius + choiceRadius);

// Bindings, of texels: rows of 16 bytes, so many for a pixel.
const uint bindingNoisy = 0u;     // a NoisyPixel
const uint bindingSplit = 1u;     // the means of both halves; their variance; the same, by their difference
const uint bindingVariances = 2u; // of the mean of all samples
const uint bindingGuides = 3u;    // means of both halves around the pixel; their variance
const uint bindingEstimates = 4u; // each with its error
const uint bindingChoices = 5u;   // the estimate's index
const uint bindingDenoised = 6u;  // the colour
const uint denoiserBindingCount = 7u;
const int noisyRows = 5;
const int splitRows = 4;
const int guideRows = 3;

// The regression: a constant, albedo, normal and depth, of which products are kept in the order (0,0) (1,0) (1,1) (2,0).
const int featureCount = 8;
const int productCount = 36;
const int estimateCount = 3;    // of the narrow bandwidth, of the wide one, and the noisy picture itself

#ifdef __cplusplus
static_assert(sizeof(NoisyPixel) == 80 && offsetof(NoisyPixel, normal) == 64);
static_assert(productCount == featureCount * (featureCount + 1) / 2);
} // namespace hyalite::core::layout
#endif
#endif
