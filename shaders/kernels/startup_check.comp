// Entry kernel: the device's own arithmetic on hard inputs, and where its lanes are. The host compares
// (host/gpu/startup_check.cpp).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require

#include "shaders/layout/layout.h"
#include "shaders/layout/check_records.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer InputBuffer { HardInput inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer ResultBuffer { CheckResult results[]; };

void main() {
    uint i = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    if (i >= inputs.length())
        return;
    HardInput given = inputs[i];
    CheckResult result;
    result.quotient = given.numerator / given.denominator;
    result.root = sqrt(given.square);
    result.sum = given.addend + given.otherAddend;
    result.difference = given.addend - given.otherAddend;
    result.product = given.factor * given.otherFactor;
    result.rounded = float(given.integer);
    result.truncated = int(given.numerator);
    float zero = given.addend - given.addend;
    result.comparisons = (given.addend < given.otherAddend ? isLess : 0u) |
                         (given.addend <= given.otherAddend ? isAtMost : 0u) |
                         (given.addend == given.otherAddend ? isEqual : 0u) |
                         (result.sum > given.addend ? isSumGreater : 0u) | (zero == -zero ? areZerosEqual : 0u) |
                         (!(-zero < zero) ? isZeroNotLess : 0u);
    result.subgroup = gl_SubgroupID;
    result.lane = gl_SubgroupInvocationID;
    result.subgroupSize = gl_SubgroupSize;
    result.pad1 = 0u;
    results[i] = result;
}
