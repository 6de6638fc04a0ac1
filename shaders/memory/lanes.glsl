// Reductions over the lanes of a subgroup.

// Every lane gets the result; one lane is elected to write it. On lavapipe, one atomic operation per lane would take
// longer than a sample.
#if LANES_SHUFFLE
uint sumOfLanes(uint x) { return subgroupAdd(x); }

uint maxOfLanes(uint x) { return subgroupMax(x); }

bool subgroupElected() { return subgroupElect(); }
#else
uint sumOfLanes(uint x) { return x; }

uint maxOfLanes(uint x) { return x; }

bool subgroupElected() { return true; }
#endif
