// Entry kernel of the layout test: reads every struct of layout.h as the renderer's kernels do (three from uniform
// buffers, one from push constants, the others from storage buffers) and writes its fields as a row of words. Of
// arrays it reads the second element.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/layout/layout.h"
#include "layout_macros.h"

layout(local_size_x = 1) in;

layout(push_constant) uniform DispatchBlock { DispatchConstants dispatch; };
layout(set = 0, binding = 0, std140) uniform FrameBuffer { FrameRecord frames[2]; };
layout(set = 0, binding = 1, std140) uniform SphereBuffer { SphereRecord spheres[2]; };
layout(set = 0, binding = 2, std140) uniform LightBuffer { LightRecord lights[2]; };
layout(set = 0, binding = 3, std430) readonly buffer MaterialBuffer { MaterialRecord materials[]; };
layout(set = 0, binding = 4, std430) readonly buffer NodeBuffer { NodePair nodes[]; };
layout(set = 0, binding = 5, std430) readonly buffer TriangleBuffer { TriangleRecord triangles[]; };
layout(set = 0, binding = 6, std430) readonly buffer NormalBuffer { NormalRecord normals[]; };
layout(set = 0, binding = 7, std430) readonly buffer FilmBuffer { FilmPixel films[]; };
layout(set = 0, binding = 8, std430) readonly buffer ProgressBuffer { DispatchProgress progresses[]; };
layout(set = 0, binding = 9, std430) readonly buffer TraceBuffer { TraceEvent traces[]; };
layout(set = 0, binding = 10, std430) readonly buffer PathBuffer { PathRecord paths[]; };
layout(set = 0, binding = 11, std430) readonly buffer PendingBuffer { PendingRay pendings[]; };
layout(set = 0, binding = 12, std430) readonly buffer SkipBuffer { SkipNode skips[]; };
layout(set = 0, binding = 13, std430) readonly buffer EmitterBuffer { EmitterRecord emitters[]; };
layout(set = 0, binding = 14, std430) readonly buffer TexelBuffer { LookupRow texels[]; };
layout(set = 0, binding = 15, std430) readonly buffer TextureRowBuffer { TextureRow textureRows[]; };
layout(set = 0, binding = 16, std430) readonly buffer TextureBuffer { TextureRecord textures[]; };
layout(set = 0, binding = 17, std430) readonly buffer InstanceBuffer { InstanceRecord instances[]; };
layout(set = 0, binding = 18, std430) readonly buffer LightNodeBuffer { LightNode lightNodes[]; };
layout(set = 0, binding = 19, std430) readonly buffer PairBuffer { TrianglePair pairs[]; };
layout(set = 0, binding = 20, std430) readonly buffer SampleBuffer { SampleRecord samples[]; };
layout(set = 0, binding = 21, std430) readonly buffer PlaceBuffer { PlaceRecord places[]; };
layout(set = 0, binding = 22, std430) readonly buffer WideBuffer { WideNode wides[]; };
layout(set = 0, binding = 23, std430) writeonly buffer WordBuffer { uint words[]; };

uint cursor = 0u;

void give(uint value) { words[cursor++] = value; }

void give(float value) { give(floatBitsToUint(value)); }

void give(vec3 value) {
    give(value.x);
    give(value.y);
    give(value.z);
}

#define GIVE(field) give(field);

void main() {
    FIELDS_FrameRecord(GIVE, frames[1])
    FIELDS_SphereRecord(GIVE, spheres[1])
    FIELDS_LightRecord(GIVE, lights[1])
    FIELDS_MaterialRecord(GIVE, materials[1])
    FIELDS_NodePair(GIVE, nodes[1])
    FIELDS_TriangleRecord(GIVE, triangles[1])
    FIELDS_NormalRecord(GIVE, normals[1])
    FIELDS_FilmPixel(GIVE, films[1])
    FIELDS_DispatchProgress(GIVE, progresses[1])
    FIELDS_TraceEvent(GIVE, traces[1])
    FIELDS_PathRecord(GIVE, paths[1])
    FIELDS_PendingRay(GIVE, pendings[1])
    FIELDS_SkipNode(GIVE, skips[1])
    FIELDS_EmitterRecord(GIVE, emitters[1])
    FIELDS_LookupRow(GIVE, texels[1])
    FIELDS_TextureRow(GIVE, textureRows[1])
    FIELDS_TextureRecord(GIVE, textures[1])
    FIELDS_InstanceRecord(GIVE, instances[1])
    FIELDS_LightNode(GIVE, lightNodes[1])
    FIELDS_TrianglePair(GIVE, pairs[1])
    FIELDS_SampleRecord(GIVE, samples[1])
    FIELDS_PlaceRecord(GIVE, places[1])
    FIELDS_WideNode(GIVE, wides[1])
    FIELDS_DispatchConstants(GIVE, dispatch)
}
