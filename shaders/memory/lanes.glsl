// Reductions over the lanes of a subgroup, and values that the slots of a pixel exchange.

#if LANES_SHUFFLE
// Every lane gets the result; one lane is elected to write it. On lavapipe, one atomic operation per lane would take
// longer than a sample.
uint sumOfLanes(uint x) { return subgroupAdd(x); }

uint maxOfLanes(uint x) { return subgroupMax(x); }

bool subgroupElected() { return subgroupElect(); }

const uint maxSamplesAbreast = 8u;

uint firstLaneAbreast() { return gl_SubgroupInvocationID & ~(samplesAbreast - 1u); }

uint laneAbreast() { return gl_SubgroupInvocationID & (samplesAbreast - 1u); }

// The values of the slots of a pixel, in the order of their samples. Where shuffles are loops over the lanes, every lane
// gets all values instead and selects those of its pixel (host/gpu/lane_exchange.h).
void exchangeAbreast(uint mine, out uint values[maxSamplesAbreast]) {
    if (!exchangesByBroadcast) {
        [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane)
            values[lane] = subgroupShuffle(mine, firstLaneAbreast() + lane);
        return;
    }
    uint all[broadcastLanes] = uint[](
        subgroupBroadcast(mine, 0u), subgroupBroadcast(mine, 1u), subgroupBroadcast(mine, 2u),
        subgroupBroadcast(mine, 3u), subgroupBroadcast(mine, 4u), subgroupBroadcast(mine, 5u),
        subgroupBroadcast(mine, 6u), subgroupBroadcast(mine, 7u), subgroupBroadcast(mine, 8u),
        subgroupBroadcast(mine, 9u), subgroupBroadcast(mine, 10u), subgroupBroadcast(mine, 11u),
        subgroupBroadcast(mine, 12u), subgroupBroadcast(mine, 13u), subgroupBroadcast(mine, 14u),
        subgroupBroadcast(mine, 15u));
    [[unroll]] for (uint lane = 0u; lane < samplesAbreast; ++lane) {
        values[lane] = all[lane];
        [[unroll]] for (uint first = samplesAbreast; first < broadcastLanes; first += samplesAbreast)
            values[lane] = firstLaneAbreast() == first ? all[first + lane] : values[lane];
    }
}

bool isTrueForAllAbreast(bool value) {
    if (exchangesByBroadcast) {
        const uint ofPixel = samplesAbreast == 8u ? 0xFFu : (samplesAbreast == 4u ? 0xFu : (samplesAbreast == 2u ? 3u : 1u));
        return (subgroupBallot(value).x >> firstLaneAbreast() & ofPixel) == ofPixel;
    }
    uint all = value ? 1u : 0u;
    all &= samplesAbreast > 1u ? subgroupShuffleXor(all, 1u) : 1u;
    all &= samplesAbreast > 2u ? subgroupShuffleXor(all, 2u) : 1u;
    all &= samplesAbreast > 4u ? subgroupShuffleXor(all, 4u) : 1u;
    return all != 0u;
}
#else
uint sumOfLanes(uint x) { return x; }

uint maxOfLanes(uint x) { return x; }

bool subgroupElected() { return true; }

const uint maxSamplesAbreast = 1u;

void exchangeAbreast(uint mine, out uint values[maxSamplesAbreast]) { values[0] = mine; }

bool isTrueForAllAbreast(bool value) { return value; }
#endif
