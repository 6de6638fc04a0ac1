// The light tree: emitters are chosen by how much light they may send to the point to be lit. Conty and Kulla,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; the bounds on cosines are those of
// Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition, section 12.6.3, with spheres instead of
// boxes.
//
// Each child of a node is a cluster of emitters. The choice goes down from the root by one random number, of which the
// part that has decided is taken away. Numbers are compared as integers, so that the probability that is computed is
// the one with which an emitter is chosen.

// A point to be lit.
struct LitPoint {
    vec3 position;
    vec3 normal;         // for shading, unit length
    bool isTransmitting; // light from behind the surface counts, too
};

struct EmitterChoice {
    uint index;
    float chance; // 0: no emitter can light the point
};

float sineOf(float cosine) { return squareRoot(greater(1.0 - cosine * cosine, 0.0)); }

// The cosine of the angle a - b, or 1 if b is the larger one; both are in [0, pi].
float cosineOfDifference(float cosineA, float sineA, float cosineB, float sineB) {
    float cosine = cosineA * cosineB + sineA * sineB;
    return cosineA > cosineB ? 1.0 : cosine;
}

// Added to cosines of bounds. An emitter that lights a point is so never passed over because of rounding, which near a
// cosine of 1 moves a sine by up to 4e-4.
const float cosineMargin = 0.001;

// Bound on the share of its parent's light that a cluster sends to the point, except for the distance.
float clusterBound(LightNode cluster, LitPoint point, vec3 toCentre, float squaredDistance) {
    bool isAround = squaredDistance <= cluster.squaredRadius;
    float inverse = divide(1.0, squareRoot(greater(squaredDistance, 1e-30)));
    vec3 direction = toCentre * inverse;
    // The cluster is seen within this angle of its centre.
    float sineSeen = lesser(squareRoot(cluster.squaredRadius) * inverse, 1.0);
    float cosineSeen = sineOf(sineSeen);

    float cosineAxis = -dotProduct(direction, cluster.axis);
    cosineAxis = (cluster.reference & lightNodeIsTwoSided) != 0u ? abs(cosineAxis) : cosineAxis;
    float cosineNormal = cosineOfDifference(cosineAxis, sineOf(cosineAxis), cluster.cosineNormals, cluster.sineNormals);
    float cosineLeaving = cosineOfDifference(cosineNormal, sineOf(cosineNormal), cosineSeen, sineSeen) + cosineMargin;
    cosineLeaving = isAround ? 1.0 : cosineLeaving;
    float emission = cosineLeaving - lesser(cluster.cosineEmission, 0.0);
    emission = cosineLeaving > cluster.cosineEmission ? emission : 0.0;

    float cosineSurface = dotProduct(direction, point.normal);
    cosineSurface = point.isTransmitting ? abs(cosineSurface) : cosineSurface;
    float cosineArriving =
        cosineOfDifference(cosineSurface, sineOf(cosineSurface), cosineSeen, sineSeen) + cosineMargin;
    return cluster.share * emission * (isAround ? 1.0 : greater(cosineArriving, 0.0));
}

// The share of 2^32, in steps of 2^8.
uint numberBelow(float share) { return uint(lesser(share, 16777215.0 / 16777216.0) * 16777216.0) << 8u; }

// How a node divides the random numbers among its children.
struct LightSplit {
    uint leftNumbers; // those below choose the left child
    uint left;        // references
    uint right;
    bool isDark; // neither child can light the point
};

// The split between the two children from index `first` on. Distances below a cluster's radius count as that.
LightSplit splitLights(uint first, LitPoint point) {
    LightNode left = fetchLightNode(first);
    LightNode right = fetchLightNode(first + 1u);
    vec3 toLeft = left.centre - point.position;
    vec3 toRight = right.centre - point.position;
    float leftSquared = dotProduct(toLeft, toLeft);
    float rightSquared = dotProduct(toRight, toRight);
    float leftBound = clusterBound(left, point, toLeft, leftSquared);
    float rightBound = clusterBound(right, point, toRight, rightSquared);
    // In proportion to 1 / squared distance; the shares of both distances in their sum do not leave the range of
    // floats.
    float leftFar = greater(leftSquared, left.squaredRadius);
    float rightFar = greater(rightSquared, right.squaredRadius);
    float inverse = divide(1.0, greater(leftFar + rightFar, 1e-30));
    float leftImportance = leftBound * greater(rightFar * inverse, 1e-12);
    float rightImportance = rightBound * greater(leftFar * inverse, 1e-12);
    float sum = leftImportance + rightImportance;
    float share = divide(leftImportance, greater(sum, 1e-37));
    uint numbers = numberBelow(share);
    numbers = leftImportance > 0.0 ? max(numbers, 1u) : 0u;
    numbers = rightImportance > 0.0 ? numbers : 0xFFFFFFFFu;
    return LightSplit(numbers, left.reference, right.reference, !(sum > 0.0));
}

// The chance after one more choice. Below 1e-30 it counts as 0: drivers may flush what is smaller still.
float chanceAfter(float chance, LightSplit split, bool isRight) {
    float leftShare = floatOf(split.leftNumbers) * (1.0 / 4294967296.0);
    float rightShare = 1.0 - leftShare;
    float after = chance * (isRight ? rightShare : leftShare);
    return split.isDark || after < 1e-30 ? 0.0 : after;
}

// A random number from 2^32 made of one that is below `count` (0: 2^32), with new random bits where that leaves gaps.
uint spreadNumber(uint number, uint count) {
    uint fresh = hashKeys(uvec3(number, count, 0x9E3779B9u)).x;
    float range = count == 0u ? 4294967296.0 : floatOf(count);
    float unit = divide(floatOf(number) + unitFloat(fresh), range);
    return numberBelow(unit) | (fresh & 0xFFu);
}

uint lightNodeIndex(uint reference) { return reference & ~(leafFlag | lightNodeIsTwoSided); }

// Whether the way down the tree has ended. The loops below ask at their head: SwiftShader and Mesa 22 run a loop's body
// for lanes that have left it, too, with loads that give 0, and of what it computes only the values that the head
// merges are kept for them.
bool isWayOver(uint reference, float chance) { return (reference & leafFlag) != 0u || chance <= 0.0; }

EmitterChoice chooseInTree(LitPoint point, uint bits) {
    uint reference = 0u;
    float chance = 1.0;
    while (!isWayOver(reference, chance)) {
        LightSplit split = splitLights(lightNodeIndex(reference), point);
        bool isRight = bits >= split.leftNumbers;
        uint before = isRight ? split.leftNumbers : 0u;
        uint end = isRight ? 0u : split.leftNumbers;
        reference = isRight ? split.right : split.left;
        chance = chanceAfter(chance, split, isRight);
        bits = spreadNumber(bits - before, end - before);
    }
    return EmitterChoice(lightNodeIndex(reference), chance);
}

// The chance with which chooseInTree chooses an emitter; `turns` are those on the way to it, from the lowest bit on, 1
// for a right child.
float chanceInTree(LitPoint point, uint turns) {
    uint reference = 0u;
    float chance = 1.0;
    while (!isWayOver(reference, chance)) {
        LightSplit split = splitLights(lightNodeIndex(reference), point);
        bool isRight = (turns & 1u) != 0u;
        reference = isRight ? split.right : split.left;
        chance = chanceAfter(chance, split, isRight);
        turns = turns >> 1u;
    }
    return chance;
}
