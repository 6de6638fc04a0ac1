// Lights without size.

// Fraction of a spot's intensity towards a point; `toSpot` leads from that point to the spot. It falls off between two
// angles, linearly in the cosine as t: by a smooth step, 3 t^2 - 2 t^3, or, where falloffScale is negative, by t^2
// (glTF's KHR_lights_punctual).
float spotFalloff(vec3 toSpot, vec3 axis, float cosineOuter, float falloffScale) {
    float inside = -dotProduct(toSpot, axis) - cosineOuter;
    float scaled = inside * abs(falloffScale);
    float t = greater(lesser(scaled, 1.0), 0.0);
    return t * t * (falloffScale < 0.0 ? 1.0 : 3.0 - 2.0 * t);
}
