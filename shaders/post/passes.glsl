// The beginning of every pass of the denoiser: an invocation does a pixel of the tile, or an anchor. What passes hand
// on lies in texels of four words, several for a pixel (shaders/layout/denoiser_records.h), as drivers on CPUs read
// those quickly.
#extension GL_EXT_control_flow_attributes : require

#include "shaders/layout/layout.h"
#include "shaders/layout/denoiser_records.h"

layout(local_size_x_id = 0) in;

layout(push_constant) uniform DispatchBlock { DispatchConstants dispatchConstants; };
layout(constant_id = constantExactDivision) const bool hasExactDivision = false;

layout(set = 0, binding = bindingNoisy, rgba32ui) uniform restrict readonly uimageBuffer noisyTexels;
layout(set = 0, binding = bindingSplit, rgba32ui) uniform restrict uimageBuffer splitTexels;
layout(set = 0, binding = bindingVariances, rgba32ui) uniform restrict uimageBuffer varianceTexels;
layout(set = 0, binding = bindingLevels, rgba32ui) uniform restrict uimageBuffer levelTexels;
layout(set = 0, binding = bindingModels, rgba32ui) uniform restrict uimageBuffer modelTexels;
layout(set = 0, binding = bindingEstimates, rgba32ui) uniform restrict uimageBuffer estimateTexels;
layout(set = 0, binding = bindingChoices, rgba32ui) uniform restrict uimageBuffer choiceTexels;
layout(set = 0, binding = bindingCounts, rgba32ui) uniform restrict uimageBuffer countTexels;
layout(set = 0, binding = bindingDenoised, rgba32ui) uniform restrict writeonly uimageBuffer denoisedTexels;

#include "shaders/math/arithmetic.glsl"
#include "shaders/math/vector.glsl"
#include "shaders/math/functions.glsl"
#include "shaders/post/denoiser.glsl"

ivec2 tileSize;
ivec2 own; // the invocation's pixel or anchor

void readTileSize() { tileSize = ivec2(dispatchConstants.tileWidth, dispatchConstants.tileHeight); }

// Whether the invocation has a place among so many.
bool beginPassOver(ivec2 size) {
    int index = int(gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex);
    own = ivec2(index % size.x, index / size.x);
    return own.y < size.y;
}

// Whether the invocation has a pixel of the tile.
bool beginPass() {
    readTileSize();
    return beginPassOver(tileSize);
}

// Of the tile's pixel, or of the nearest one where it is outside.
int placeOf(ivec2 pixel) {
    ivec2 inside = clamp(pixel, ivec2(0), tileSize - 1);
    return inside.y * tileSize.x + inside.x;
}

ivec2 levelSizeOf(int fit) { return ivec2(levelSize(tileSize.x, fit), levelSize(tileSize.y, fit)); }

// Of a pixel of a level, in texels.
int placeInLevel(ivec2 pixel, ivec2 size, int fit) {
    return ((fit == fitCoarse ? tileSize.x * tileSize.y : 0) + pixel.y * size.x + pixel.x) * levelRows;
}

ivec2 anchorsOf(ivec2 levelSize) { return ivec2(anchorCount(levelSize.x), anchorCount(levelSize.y)); }

// That of the level whose surroundings the anchor's model fits.
ivec2 pixelOfAnchor(ivec2 anchor, ivec2 levelSize) {
    return min(ivec2(placeOfAnchor(anchor.x), placeOfAnchor(anchor.y)), levelSize - 1);
}

// Of the model of an anchor's first half, in texels; that of the second one is `modelRows` behind.
int placeOfModel(ivec2 anchor, ivec2 anchors, int fit) {
    ivec2 fine = anchorsOf(levelSizeOf(fitWide));
    int before = fit * fine.x * fine.y;
    return (before + anchor.y * anchors.x + anchor.x) * 2 * modelRows;
}

vec3 noisyVector(int place, int row) {
    return uintBitsToFloat(imageLoad(noisyTexels, place * noisyRows + row).xyz);
}
float noisyNumber(int place, int row) { return uintBitsToFloat(imageLoad(noisyTexels, place * noisyRows + row).w); }

#define loadTexel(texels, place) uintBitsToFloat(imageLoad(texels, place))
#define loadVector(texels, place) uintBitsToFloat(imageLoad(texels, place).xyz)
#define loadNumber(texels, place) uintBitsToFloat(imageLoad(texels, place).w)
#define storeVector(texels, place, v) imageStore(texels, place, uvec4(floatBitsToUint(v), 0u))
#define storeWithNumber(texels, place, v, x) imageStore(texels, place, uvec4(floatBitsToUint(v), floatBitsToUint(x)))
