// Entry kernel: adds the finished samples of a tile to the film, in the order of their indices, up to the first that is
// not finished (shaders/drive/regeneration.glsl). An invocation does a pixel.
#version 450
#extension GL_GOOGLE_include_directive : require

#define RAYS 1
#include "shaders/kernels/begin_kernel.glsl"

#include "shaders/math/arithmetic.glsl"
#include "shaders/math/vector.glsl"
#include "shaders/math/sums.glsl"
#include "shaders/drive/lanes.glsl"
#include "shaders/drive/places.glsl"

layout(set = 0, binding = bindingFilm, std430) buffer FilmPixelBuffer { FilmPixel filmPixels[]; };
layout(set = 0, binding = bindingSamples, std430) buffer SampleBuffer { SampleRecord samples[]; };

void main() {
    loadConstants();
    uint firstPlace = (gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex) * samplesInFlight;
    placeSlotAt(0u, firstPlace);
    FilmPixel pixel = filmPixels[isSlotUsed[0] ? filmIndex[0] : 0u];
    uint first = dispatch.sampleBegin + pixel.sampleCount;
    uint added = 0u;
    uvec4 rays = uvec4(0u); // shadow, reflection, refraction, bounce
    bool isNext = isSlotUsed[0];
    for (uint i = 0u; i < samplesInFlight; ++i) {
        uint place = (isNext ? firstPlace : 0u) + (first + i & samplesInFlight - 1u);
        uint record = place * recordsPerSample;
        SampleRecord found = samples[record];
        isNext = isNext && found.finished != 0u;
        if (isNext) {
            pixel = withSample(pixel, found.radiance, hasAlpha ? samples[record + 1u].radiance.x : 0.0);
            added += 1u;
            rays += unpackCounts(found.finished);
            samples[record].finished = 0u;
        }
    }
    pixel.sampleCount += added;
    if (added != 0u)
        filmPixels[filmIndex[0]] = pixel;
    added = sumOfLanes(added);
    rays = uvec4(sumOfLanes(rays.x), sumOfLanes(rays.y), sumOfLanes(rays.z), sumOfLanes(rays.w));
    if (!subgroupElected())
        return;
    atomicAdd(progress.finishedSamples, added);
    atomicAdd(progress.primaryRays, added);
    atomicAdd(progress.shadowRays, rays.x);
    atomicAdd(progress.reflectionRays, rays.y);
    atomicAdd(progress.refractionRays, rays.z);
    atomicAdd(progress.bounceRays, rays.w);
}
