// Reductions over the lanes of a subgroup, and values that the slots of a pixel exchange.

#if LANES_SHUFFLE
// Every lane gets the result; one lane is elected to write it. On lavapipe, one atomic operation per lane would take
// longer than a sample.
uint sumOfLanes(uint x) { return subgroupAdd(x); }

uint maxOfLanes(uint x) { return subgroupMax(x); }

bool subgroupElected() { return subgroupElect(); }

const uint maxSamplesInFlight = 8u;

uint firstLaneOfPixel() { return gl_SubgroupInvocationID & ~(samplesInFlight - 1u); }

// The values of the slots of a pixel, in the order of their samples. Where shuffles are loops over the lanes, every
// lane gets all values instead and selects those of its pixel (host/gpu/lane_exchange.h).
void exchangeInPixel(uint mine, out uint values[maxSamplesInFlight]) {
    if (!exchangesByBroadcast) {
        [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane)
            values[lane] = subgroupShuffle(mine, firstLaneOfPixel() + lane);
        return;
    }
    uint all[broadcastLanes] = uint[](
        subgroupBroadcast(mine, 0u), subgroupBroadcast(mine, 1u), subgroupBroadcast(mine, 2u),
        subgroupBroadcast(mine, 3u), subgroupBroadcast(mine, 4u), subgroupBroadcast(mine, 5u),
        subgroupBroadcast(mine, 6u), subgroupBroadcast(mine, 7u), subgroupBroadcast(mine, 8u),
        subgroupBroadcast(mine, 9u), subgroupBroadcast(mine, 10u), subgroupBroadcast(mine, 11u),
        subgroupBroadcast(mine, 12u), subgroupBroadcast(mine, 13u), subgroupBroadcast(mine, 14u),
        subgroupBroadcast(mine, 15u));
    [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane) {
        values[lane] = all[lane];
        [[unroll]] for (uint first = samplesInFlight; first < broadcastLanes; first += samplesInFlight)
            values[lane] = firstLaneOfPixel() == first ? all[first + lane] : values[lane];
    }
}

bool isTrueForAllOfPixel(bool value) {
    if (exchangesByBroadcast) {
        const uint ofPixel =
            samplesInFlight == 8u ? 0xFFu : (samplesInFlight == 4u ? 0xFu : (samplesInFlight == 2u ? 3u : 1u));
        return (subgroupBallot(value).x >> firstLaneOfPixel() & ofPixel) == ofPixel;
    }
    uint all = value ? 1u : 0u;
    all &= samplesInFlight > 1u ? subgroupShuffleXor(all, 1u) : 1u;
    all &= samplesInFlight > 2u ? subgroupShuffleXor(all, 2u) : 1u;
    all &= samplesInFlight > 4u ? subgroupShuffleXor(all, 4u) : 1u;
    return all != 0u;
}
#else
uint sumOfLanes(uint x) { return x; }

uint maxOfLanes(uint x) { return x; }

bool subgroupElected() { return true; }

const uint maxSamplesInFlight = 1u;

void exchangeInPixel(uint mine, out uint values[maxSamplesInFlight]) { values[0] = mine; }

bool isTrueForAllOfPixel(bool value) { return value; }
#endif
