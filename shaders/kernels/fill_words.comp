// Entry kernel: fills a buffer with words that are known (exercise_records.h). Few rounds exercise memory, many of them
// arithmetic.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/layout/exercise_records.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) writeonly buffer WordBuffer { uint words[]; };
layout(set = 0, binding = 1, std430) readonly buffer TaskBuffer { WordTask task; };

void main() {
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex; i < task.wordCount; i += stride)
        words[i] = wordOf((i + task.offset) % task.period, task.rounds) ^ task.mask;
}
