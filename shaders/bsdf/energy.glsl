// GGX directional albedo and Kulla-Conty energy compensation.
//
// A single-scattering model loses the light that one facet sends to another: up to half of it at roughness 1. Kulla and
// Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses, add it back as a second, diffuse
// lobe, (1 - E(o)) (1 - E(i)) / (pi (1 - average E)). It is reciprocal, and conserves energy exactly for the E of the
// table, because E and its averages are interpolated linearly.

struct Energy {
    float white;  // directional albedo of single scattering, by facets that reflect everything
    float grazing; // the same weighted by (1 - cos)^5: with Schlick's Fresnel, F0 mixes the two
};

struct EnergyPlace {
    uint cell;
    float share; // weight of the end of the cell
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

// Energy for the cosine `cosine` > 0 to the normal, at the roughness sqrt(alpha). Nodes are evenly spaced in the square
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

// Cosine-weighted averages over the hemisphere.
Energy averageEnergy(float roughness) {
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    LookupRow ends = fetchLookupRow(2u * energyCellCount + along.cell);
    return Energy(mixture(ends.value.x, ends.value.y, along.share),
                  mixture(ends.value.z, uintBitsToFloat(ends.word), along.share));
}

// Directional albedo of facets with the reflectance `normal` at normal incidence.
float energyAt(Energy energy, float normal) { return mixture(energy.grazing, energy.white, normal); }

// Colour of multiple scattering by facets with the average reflectance `average`, relative to the energy that single
// scattering loses; `white` is the average energy. Hill, "A Multi-Faceted Exploration", 2018, part 3.
vec3 multiScatterReflectance(vec3 average, float white) {
    vec3 above = average * average * white;
    vec3 below = 1.0 - average * (1.0 - white);
    return above * divide(1.0, below);
}
