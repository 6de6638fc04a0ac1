// Nested dielectrics: the glass at a point inside several overlapping solids.
//
// `inside` has 4 bits for each of the first dielectrics: the number of its surfaces that the path has entered and not
// left. The glass of the highest priority is there: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced
// Images", JGT 7(2), 2002. Materials are sorted by priority, so it is the first one with a count.

// The glass around the path, or noMaterial.
uint mediumAround(uint inside) { return inside == 0u ? noMaterial : uint(findLSB(inside)) / mediumBits; }

uint mediumCount(uint inside, uint material) { return inside >> material * mediumBits & 15u; }

// Counts saturate at 15.
uint enterMedium(uint inside, uint material) {
    return mediumCount(inside, material) < 15u ? inside + (1u << material * mediumBits) : inside;
}

// A count of 0 stays 0.
uint leaveMedium(uint inside, uint material) {
    return mediumCount(inside, material) > 0u ? inside - (1u << material * mediumBits) : inside;
}
