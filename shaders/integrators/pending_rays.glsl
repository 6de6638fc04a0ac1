// Rays that glass has split off wait here, the last one first: in registers where they are few and need not outlive the
// dispatch, else in a buffer. lavapipe writes buffers lane by lane and word by word, so that a choice among all levels
// of depth is faster there.

#if MEMORY_TEXELS
layout(set = 0, binding = bindingPending, rgba32ui) uniform restrict uimageBuffer pendingTexels;

void storePendingRay(uint index, PendingRay ray) {
    int row = int(index) * 3;
    imageStore(pendingTexels, row, uvec4(floatBitsToUint(ray.origin), ray.excluded));
    imageStore(pendingTexels, row + 1, uvec4(floatBitsToUint(ray.direction), ray.depth));
    imageStore(pendingTexels, row + 2, uvec4(floatBitsToUint(ray.throughput), ray.medium));
}

PendingRay loadPendingRay(uint index) {
    int row = int(index) * 3;
    uvec4 a = imageLoad(pendingTexels, row);
    uvec4 b = imageLoad(pendingTexels, row + 1);
    uvec4 c = imageLoad(pendingTexels, row + 2);
    return PendingRay(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}
#else
layout(set = 0, binding = bindingPending, std430) buffer PendingBuffer { PendingRay pendingRays[]; };

void storePendingRay(uint index, PendingRay ray) { pendingRays[index] = ray; }

PendingRay loadPendingRay(uint index) { return pendingRays[index]; }
#endif

PendingRay pendingLevels[RAYS][maxPendingInRegisters];

// There is one.
PendingRay popPendingRay(uint slot) {
    uint level = path[slot].pendingCount - 1u;
    path[slot].pendingCount = level;
    if (pendingInRegisters == 0u)
        return loadPendingRay(level * slotCount() + slotIndex[slot]);
    PendingRay ray = pendingLevels[slot][0];
    [[unroll]] for (uint i = 1u; i < pendingInRegisters; ++i)
        if (i == level)
            ray = pendingLevels[slot][i];
    return ray;
}
