// Which glass is around a point, where solids of glass lie in each other or overlap.
//
// `inside` counts in 4 bits for each of the first dielectrics how many of its surfaces a path has entered and not left.
// What is there is the one of highest priority: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", JGT
// 7(2), 2002. As materials are sorted by priority, it is the lowest one that is counted.

const uint mediumBits = 4u;

// The material around, or noMaterial.
uint mediumAround(uint inside) { return inside == 0u ? noMaterial : uint(findLSB(inside)) / mediumBits; }

uint mediumCount(uint inside, uint material) { return inside >> material * mediumBits & 15u; }

// Beyond 15 nothing is counted.
uint enterMedium(uint inside, uint material) {
    return mediumCount(inside, material) < 15u ? inside + (1u << material * mediumBits) : inside;
}

// What was not entered is not left.
uint leaveMedium(uint inside, uint material) {
    return mediumCount(inside, material) > 0u ? inside - (1u << material * mediumBits) : inside;
}
