// Fourth pass of the denoiser: the coarse level, whose pixels are means over blocks.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"
#include "shaders/post/level.glsl"

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
            LevelPixel other = loadLevel(placeOf(middle + ivec2(dx, dy)) * levelRows);
            share += other.firstShare;
            depth += other.depth;
            albedo += other.albedo;
            normal += other.normal;
        }
    LevelPixel block = loadLevel(placeOf(middle) * levelRows);
    block.first = block.firstGuide;
    block.second = block.secondGuide;
    block.variance = block.guideVariance;
    block.firstShare = share * (1.0 / 9.0);
    block.albedo = albedo * (1.0 / 9.0);
    block.normal = normal * (1.0 / 9.0);
    block.depth = depth * (1.0 / 9.0);
    storeLevel(placeInLevel(own, size, fitCoarse), block);
}
