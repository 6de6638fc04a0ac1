// Reductions over the lanes of a subgroup.

// Every lane gets the result; one lane is elected to write it. On lavapipe, one atomic operation per lane would take
// longer than a sample.
#if LANES_SHUFFLE
uint sumOfLanes(uint x) {
    x += gl_SubgroupSize > 1u ? subgroupShuffleXor(x, 1u) : 0u;
    x += gl_SubgroupSize > 2u ? subgroupShuffleXor(x, 2u) : 0u;
    x += gl_SubgroupSize > 4u ? subgroupShuffleXor(x, 4u) : 0u;
    x += gl_SubgroupSize > 8u ? subgroupShuffleXor(x, 8u) : 0u;
    x += gl_SubgroupSize > 16u ? subgroupShuffleXor(x, 16u) : 0u;
    return x;
}

uint maxOfLanes(uint x) {
    x = max(x, gl_SubgroupSize > 1u ? subgroupShuffleXor(x, 1u) : 0u);
    x = max(x, gl_SubgroupSize > 2u ? subgroupShuffleXor(x, 2u) : 0u);
    x = max(x, gl_SubgroupSize > 4u ? subgroupShuffleXor(x, 4u) : 0u);
    x = max(x, gl_SubgroupSize > 8u ? subgroupShuffleXor(x, 8u) : 0u);
    x = max(x, gl_SubgroupSize > 16u ? subgroupShuffleXor(x, 16u) : 0u);
    return x;
}

bool subgroupElected() { return gl_SubgroupInvocationID == 0u; }
#else
uint sumOfLanes(uint x) { return x; }

uint maxOfLanes(uint x) { return x; }

bool subgroupElected() { return true; }
#endif
