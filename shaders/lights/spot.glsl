// Lights without size.

// Fraction of a spot's intensity towards a point; `toSpot` leads from that point to the spot. It falls off between two
// angles by a smooth step.
float spotFalloff(vec3 toSpot, vec3 axis, float cosineOuter, float falloffScale) {
    float inside = -dotProduct(toSpot, axis) - cosineOuter;
    float scaled = inside * falloffScale;
    float t = greater(lesser(scaled, 1.0), 0.0);
    return t * t * (3.0 - 2.0 * t);
}
