// Lights without size.

// How much of a spot's intensity there is in the direction from which it is seen: `toSpot` leads to it. It fades between
// two angles as the cubic that is even at both ends.
float spotFalloff(vec3 toSpot, vec3 axis, float cosineOuter, float falloffScale) {
    float inside = -dotProduct(toSpot, axis) - cosineOuter;
    float scaled = inside * falloffScale;
    float t = greater(lesser(scaled, 1.0), 0.0);
    return t * t * (3.0 - 2.0 * t);
}
