// Fourth pass of the denoiser: the coarse level, whose pixels are means over blocks.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    readTileSize();
    ivec2 size = levelSizeOf(fitCoarse);
    if (!beginPassOver(size))
        return;
    ivec2 middle = blockSide * own + blockSide / 2;
    float share = 0.0;
    float depth = 0.0;
    vec3 albedo = vec3(0.0);
    vec3 normal = vec3(0.0);
    [[unroll]] for (int dy = -1; dy <= 1; ++dy)
        [[unroll]] for (int dx = -1; dx <= 1; ++dx) {
            int other = placeOf(middle + ivec2(dx, dy)) * levelRows;
            share += loadNumber(levelTexels, other + levelFirst);
            depth += loadNumber(levelTexels, other + levelAlbedo);
            albedo += loadVector(levelTexels, other + levelAlbedo);
            normal += loadVector(levelTexels, other + levelNormal);
        }
    int level = placeInLevel(own, size, fitCoarse);
    int fine = placeOf(middle) * levelRows + levelGuides;
    [[unroll]] for (int i = 0; i < 3; ++i) {
        vec3 mean = loadVector(levelTexels, fine + i);
        storeWithNumber(levelTexels, level + levelFirst + i, mean, share * (1.0 / 9.0));
        storeVector(levelTexels, level + levelGuides + i, mean);
    }
    storeWithNumber(levelTexels, level + levelAlbedo, albedo * (1.0 / 9.0), depth * (1.0 / 9.0));
    storeVector(levelTexels, level + levelNormal, normal * (1.0 / 9.0));
}
