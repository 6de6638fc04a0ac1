// GGX directional albedo, and two ways to give back what single scattering loses.
//
// Opaque facets: Kulla-Conty. A single-scattering model loses the light that one facet sends to another: up to two
// thirds of it at roughness 1. Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017
// courses, add it back as a second, diffuse lobe, (1 - E(o)) (1 - E(i)) / (pi (1 - average E)). It is reciprocal, and
// conserves energy exactly for the E of the table, because E and its averages are interpolated linearly.
//
// Glass: Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", 2019. What single scattering
// reflects and transmits is divided by E(o), the albedo of both together for the side of the viewer. Directions and
// pdfs stay as they are. It keeps all energy, but is not reciprocal.

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

// Between the four corners of a cell.
float cellMixture(LookupRow corners, float across, float along) {
    return mixture(mixture(corners.value.x, corners.value.y, across),
                   mixture(corners.value.z, uintBitsToFloat(corners.word), across), along);
}

// Energy for the cosine `cosine` > 0 to the normal, at the roughness sqrt(alpha). Nodes are evenly spaced in the square
// roots of both.
Energy energyOf(float cosine, float roughness) {
    EnergyPlace across = energyPlace(squareRoot(cosine), energyCosines);
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    uint row = 2u * (along.cell * (energyCosines - 1u) + across.cell);
    LookupRow white = fetchLookupRow(row);
    LookupRow grazing = fetchLookupRow(row + 1u);
    return Energy(cellMixture(white, across.share, along.share), cellMixture(grazing, across.share, along.share));
}

// Position in the table of an `eta` in [1/10, 10]: in [0, 1], for either side of the surface. Nodes are evenly spaced
// in the square root of |eta - 1| / (eta + 1).
float indexPosition(float eta) {
    float difference = abs(eta - 1.0);
    float sum = eta + 1.0;
    float contrast = divide(difference, sum) * (11.0 / 9.0); // 1 at an index of 10
    return squareRoot(contrast);
}

// Share of the light that rough glass reflects and transmits at once, without the change of radiance by the square of
// the index. `cosine` > 0 is that of the viewer to the normal; `eta`, in [1/10, 10] and not 1, is as in Bsdf.
float glassEnergy(float cosine, float roughness, float eta) {
    EnergyPlace across = energyPlace(squareRoot(cosine), energyCosines);
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    EnergyPlace between = energyPlace(indexPosition(eta), energyIndices);
    uint layer = eta > 1.0 ? energyIndices + between.cell : between.cell;
    uint row = energyTexelCount + layer * energyCellCount + along.cell * (energyCosines - 1u) + across.cell;
    float low = cellMixture(fetchLookupRow(row), across.share, along.share);
    float high = cellMixture(fetchLookupRow(row + energyCellCount), across.share, along.share);
    return mixture(low, high, between.share);
}

// Cosine-weighted averages over the hemisphere.
Energy averageEnergy(float roughness) {
    EnergyPlace along = energyPlace(roughness, energyRoughnesses);
    LookupRow ends = fetchLookupRow(2u * energyCellCount + along.cell);
    return Energy(mixture(ends.value.x, ends.value.y, along.share),
                  mixture(ends.value.z, uintBitsToFloat(ends.word), along.share));
}

// Directional albedo of facets with the reflectance `normal` at normal incidence and `grazing` at grazing angles.
float energyAt(Energy energy, float normal, float grazing) {
    return energy.grazing * grazing + (energy.white - energy.grazing) * normal;
}

// Colour of multiple scattering by facets with the average reflectance `average`, relative to the energy that single
// scattering loses; `white` is the average energy. Hill, "A Multi-Faceted Exploration", 2018, part 3.
vec3 multiScatterReflectance(vec3 average, float white) {
    vec3 above = average * average * white;
    vec3 below = 1.0 - average * (1.0 - white);
    return above * divide(1.0, below);
}
