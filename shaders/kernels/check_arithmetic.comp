// Entry kernel: the results of the device's own / and sqrt for hard inputs. The host compares them
// (host/gpu/arithmetic.cpp).
#version 450

layout(local_size_x = 64) in;

struct HardInput {
    float numerator;
    float denominator;
    float square;
};

layout(set = 0, binding = 0, std430) readonly buffer InputBuffer { HardInput inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer ResultBuffer { vec2 results[]; }; // quotient, root

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= inputs.length())
        return;
    float quotient = inputs[i].numerator / inputs[i].denominator;
    float root = sqrt(inputs[i].square);
    results[i] = vec2(quotient, root);
}
