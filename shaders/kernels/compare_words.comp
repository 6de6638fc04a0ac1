// Entry kernel: compares the words of a buffer with those that it should have (exercise_records.h), and counts and
// records those that differ. It reads from the last word to the first, where fill_words.comp writes from the first on.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/layout/exercise_records.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer WordBuffer { uint words[]; };
layout(set = 0, binding = 1, std430) readonly buffer ExpectedBuffer { uint expectedWords[]; }; // task.period of them
layout(set = 0, binding = 2, std430) coherent buffer TaskBuffer {
    WordTask task;
    WrongWord wrong[maxWrongWords];
};

void main() {
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint k = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex; k < task.wordCount; k += stride) {
        uint i = task.wordCount - 1u - k;
        uint expected = expectedWords[(i + task.offset) % task.period] ^ task.mask;
        uint found = words[i];
        if (found != expected) {
            atomicAdd(task.wrongCount, 1u);
            atomicMin(task.firstWrong, i);
            uint place = atomicAdd(task.recordedCount, 1u);
            if (place < maxWrongWords)
                wrong[place] = WrongWord(i, found, expected);
        }
    }
}
