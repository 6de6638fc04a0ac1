// Pending rays: a stack of the rays that glass has split off. It is in registers if it is small and need not outlive
// the dispatch, else in a buffer. lavapipe writes buffers lane by lane and word by word, so selecting among all
// registers is faster there.

#if MEMORY_TEXELS
layout(set = 0, binding = bindingPending, rgba32ui) uniform restrict uimageBuffer pendingTexels;

void storePendingRay(uint index, PendingRay ray) { STORE_PendingRay(pendingTexels, index, ray) }

PendingRay loadPendingRay(uint index) { LOAD_PendingRay(pendingTexels, index) }
#else
layout(set = 0, binding = bindingPending, std430) buffer PendingBuffer { PendingRay pendingRays[]; };

void storePendingRay(uint index, PendingRay ray) { pendingRays[index] = ray; }

PendingRay loadPendingRay(uint index) { return pendingRays[index]; }
#endif

// The stack is not empty.
PendingRay popPendingRay() {
    uint top = path.pending.count - 1u;
    path.pending.count = top;
    if (pendingInRegisters == 0u)
        return loadPendingRay(top * pathCount() + path.key.index);
    PendingRay ray = path.pending.levels[0];
    [[unroll]] for (uint i = 1u; i < pendingInRegisters; ++i)
        if (i == top)
            ray = path.pending.levels[i];
    return ray;
}
