// How much light microfacets reflect at once, and what becomes of the rest.
//
// Light that one facet sends to another is lost to the model of single reflections; at roughness 1 that is up to half
// of it. Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses, give it back as a
// second, diffuse lobe, (1 - E(o)) (1 - E(i)) / (pi (1 - average E)), which is reciprocal and keeps energy exactly as
// long as E is that of the table: it is linear in between, and so are the averages of it.

struct Energy {
    float white;  // reflected at once by facets that reflect everything
    float grazing; // and of that the share (1 - cos)^5, summed: by F0 between 0 and 1, Schlick's facets reflect the mixture
};

struct EnergyPlace {
    uint cell;
    float share; // of the cell's end
};

EnergyPlace energyPlace(float position, uint nodeCount) {
    float scaled = position * float(nodeCount - 1u);
    float inside = greater(lesser(scaled, float(nodeCount - 1u)), 0.0);
    uint cell = min(uint(inside), nodeCount - 2u);
    float share = inside - float(cell);
    return EnergyPlace(cell, share);
}

float mixture(float a, float b, float share) {
    return a + (b - a) * share;
}

// Of a direction with the cosine `cosine` > 0 to the normal, at the roughness sqrt(alpha). Nodes are even in the square
// roots of both.
Energy energyOf(float cosine, float roughness) {
    EnergyPlace across = energyPlace(squareRoot(cosine), energyCosines);
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    uint row = 2u * (along.cell * (energyCosines - 1u) + across.cell);
    LookupRow white = fetchLookupRow(row);
    LookupRow grazing = fetchLookupRow(row + 1u);
    return Energy(mixture(mixture(white.value.x, white.value.y, across.share),
                          mixture(white.value.z, uintBitsToFloat(white.word), across.share), along.share),
                  mixture(mixture(grazing.value.x, grazing.value.y, across.share),
                          mixture(grazing.value.z, uintBitsToFloat(grazing.word), across.share), along.share));
}

// Averages over the hemisphere, weighted by the cosine.
Energy averageEnergy(float roughness) {
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    LookupRow ends = fetchLookupRow(2u * energyCellCount + along.cell);
    return Energy(mixture(ends.value.x, ends.value.y, along.share),
                  mixture(ends.value.z, uintBitsToFloat(ends.word), along.share));
}

// Of facets that reflect `normal` head on.
float energyAt(Energy energy, float normal) { return mixture(energy.grazing, energy.white, normal); }

// What is reflected twice and more often by facets whose reflectance is `average`, of what is not reflected at once;
// `white` is the average energy. Hill, "A Multi-Faceted Exploration", 2018, part 3.
vec3 multiScatterReflectance(vec3 average, float white) {
    vec3 above = average * average * white;
    vec3 below = 1.0 - average * (1.0 - white);
    return above * divide(1.0, below);
}
