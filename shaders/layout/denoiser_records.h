// The contract of the denoiser's kernels (shaders/post): a noisy picture, what the passes hand on, and how far they
// look. Compiled as C++ and as GLSL.
#ifndef HYALITE_DENOISER_RECORDS_H
#define HYALITE_DENOISER_RECORDS_H

#ifdef __cplusplus
#include "shaders/layout/layout.h"
#define HYALITE_INLINE constexpr

namespace hyalite::core::layout {
#else
#define HYALITE_INLINE
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

// Fits: regressions over neighbours of colours on features, in two bandwidths over the pixels of the tile, which are
// the fine level, and in the wide one over the means of blocks of them, the coarse level.
const int fitWide = 0;
const int fitNarrow = 1;
const int fitCoarse = 2;
const int fitCount = 3;

// An estimate of a pixel's colour by each fit, and the noisy colour itself.
const int estimateNoisy = fitCount;
const int estimateCount = fitCount + 1;

// The weight of a pixel's own colour beside what the models of anchors say, which have at most 1 in all.
const float ownWeight = 0.0009765625f;

// Side of the coarse level's blocks, in pixels.
const int blockSide = 3;

HYALITE_INLINE int sideOfLevel(int fit) { return fit == fitCoarse ? blockSide : 1; }

// Pixels of the level along a side of the tile.
HYALITE_INLINE int levelSize(int tileSize, int fit) { return (tileSize + sideOfLevel(fit) - 1) / sideOfLevel(fit); }

// Pixels of the level on each side of one that is fitted.
HYALITE_INLINE int fitRadius(int fit) { return fit == fitCoarse ? 4 : 5; }

// How fast a fit's weights fall with the distance of colours: the standard deviation of the narrow one is 2^-1.5 times
// as large.
HYALITE_INLINE float sharpnessOf(int fit) { return fit == fitNarrow ? 4.0f : 0.5f; }

// Anchors are the pixels of a level that are fitted, each second one along a side. The last may be beyond its end.
const int anchorSpacing = 2;

HYALITE_INLINE int anchorCount(int levelSize) { return (levelSize + anchorSpacing - 1) / anchorSpacing; }
HYALITE_INLINE int placeOfAnchor(int anchor) { return anchorSpacing * anchor + 1; }

// Of anchors, in pixels of the tile: their distance, and the middle of the first.
HYALITE_INLINE int anchorStep(int fit) { return anchorSpacing * sideOfLevel(fit); }
HYALITE_INLINE int firstAnchor(int fit) { return sideOfLevel(fit) + (sideOfLevel(fit) - 1) / 2; }

// Both levels have the same blocks and anchors in every tile that begins at a multiple of this.
const int tileAlignment = 6;

// Pixels that a pass reads on each side of its own.
const int fireflyRadius = 2;
const int varianceRadius = 3;
const int guideRadius = 1;
const int errorRadius = 2;
const int choiceRadius = 2;
const int spreadRadius = 4; // between the counts that decide together

// Of a tile beyond its own pixels: what the passes above read, and estimates by a coarse fit, whose anchor is less than
// 6 pixels away, and its neighbours another 4 blocks, of which the last one ends a pixel further.
const int denoiserMargin = 36;

// Bindings, of texels: rows of 16 bytes, so many for a pixel.
const uint bindingNoisy = 0u;     // a NoisyPixel
const uint bindingSplit = 1u;     // the means of both halves; their variance; the same, by their difference
const uint bindingVariances = 2u; // of the mean of all samples
const uint bindingLevels = 3u;    // of the fine level, then of the coarse one
const uint bindingModels = 4u;    // of each fit's anchors, for both halves
const uint bindingEstimates = 5u; // each with its error
const uint bindingChoices = 6u;   // the estimate's index
const uint bindingDenoised = 7u;  // the colour
const uint denoiserBindingCount = 8u; // some devices allow no more
const uint bindingCounts = bindingVariances; // how many neighbours have chosen each estimate, when those are done with
const int noisyRows = 5;
const int splitRows = 4;

// Rows of a level's pixel: means of the halves, the first with the first samples' share, and their variance; the same
// of 3 x 3 pixels around, each with a number of the normal; albedo, with depth. Of a block, the first three are those
// of the pixels around its middle.
const int levelFirst = 0;
const int levelSecond = 1;
const int levelVariance = 2;
const int levelGuides = 3; // first, second, variance
const int levelAlbedo = 6;
const int levelRows = 7;

// The regression: a constant, albedo, normal and depth, of which products are kept in the order (0,0) (1,0) (1,1)
// (2,0).
const int featureCount = 8;
const int productCount = 36;

// Rows of a half's model: the colours by which it multiplies the first six features, each with a number of those of the
// two others.
const int modelRows = 6;

#ifdef __cplusplus
static_assert(sizeof(NoisyPixel) == 80 && offsetof(NoisyPixel, normal) == 64);
static_assert(productCount == featureCount * (featureCount + 1) / 2);
static_assert(4 * modelRows == 3 * featureCount);
static_assert(tileAlignment % anchorStep(fitWide) == 0 && tileAlignment % anchorStep(fitCoarse) == 0);
static_assert(denoiserMargin % tileAlignment == 0);
static_assert(estimateCount == 4); // a texel's numbers
} // namespace hyalite::core::layout
#endif
#undef HYALITE_INLINE
#endif
