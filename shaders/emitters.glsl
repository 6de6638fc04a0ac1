// Light that a surface is aimed at: point lights, spheres and triangles that emit. Twin: host/reference/emitters.h.

struct LightSample {
    vec3 direction; // unit length, from the surface to the light
    float distance;
    vec3 radiance;  // divided by the density; of a point light the intensity / squared distance / probability
    float density;  // per solid angle, the choice of the emitter included; 0: a point light
    uint target;    // the primitive at its end
};

const LightSample noLight = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0, noPrimitive);

LightSample samplePoint(EmitterRecord emitter, vec3 position) {
    vec3 toLight = subtract(emitter.position, position);
    float distance = vectorLength(toLight);
    precise float squaredDistance = distance * distance;
    precise float share = squaredDistance * emitter.probability;
    return LightSample(toLight * divide(1.0, distance), distance, emitter.emission * divide(1.0, share), 0.0, noPrimitive);
}

LightSample sampleTriangleLight(EmitterRecord emitter, vec3 position, vec2 u) {
    TriangleRecord triangle = fetchTriangle(emitter.record);
    vec2 weights = sampleTriangle(u);
    Surface surface = triangleSurface(triangle, fetchNormals(emitter.record), weights.x, weights.y);
    vec3 toLight = subtract(surface.position, position);
    float distance = vectorLength(toLight);
    vec3 direction = toLight * divide(1.0, distance);
    precise float facing = -dotProduct(direction, surface.geometricNormal);
    float cosine = emitter.isTwoSided != 0u ? abs(facing) : facing;
    float density = solidAngleDensity(emitter.density, distance, cosine);
    bool isSeen = cosine > 0.0 && distance > 0.0;
    return LightSample(direction, distance, isSeen ? emitter.emission * divide(1.0, density) : vec3(0.0), density,
                       triangle.primitiveId);
}

LightSample sampleSphereLight(EmitterRecord emitter, vec3 position, vec2 u) {
    SphereRecord sphere = fetchSphere(emitter.record);
    precise float squaredRadius = sphere.radius * sphere.radius;
    vec3 toCentre = subtract(sphere.centre, position);
    float squaredDistance = dotProduct(toCentre, toCentre);
    bool isOutside = squaredDistance > squaredRadius * leastConeDistance;
    vec3 direction;
    float distance;
    float density;
    bool isSeen;
    if (isOutside) {
        float centreDistance = squareRoot(squaredDistance);
        float height = coneHeight(squaredRadius, squaredDistance);
        direction = sampleCone(toCentre * divide(1.0, centreDistance), height, u);
        float meeting = intersectSphere(position, direction, sphere.centre, sphere.radius, false);
        distance = meeting > 0.0 ? meeting : centreDistance; // past the rim by rounding
        density = emitter.probability * pdfCone(height);
        isSeen = sphere.normalSign > 0.0 || emitter.isTwoSided != 0u;
    } else {
        vec3 outward = sampleSphere(u);
        vec3 toLight = addProduct(toCentre, outward, vec3(sphere.radius));
        distance = vectorLength(toLight);
        direction = toLight * divide(1.0, distance);
        float cosine = dotProduct(direction, outward);
        density = solidAngleDensity(emitter.density, distance, cosine);
        isSeen = cosine > 0.0 && distance > 0.0 && (sphere.normalSign < 0.0 || emitter.isTwoSided != 0u);
    }
    return LightSample(direction, distance, isSeen ? emitter.emission * divide(1.0, density) : vec3(0.0), density,
                       emitter.record);
}

// Which emitter a number of 32 bits chooses; 0 where there is none.
uint chooseEmitter(uint bits) {
    uint first = 0u; // all before it end at or below `bits`
    for (int bit = findMSB(emitterCount); bit >= 0; --bit) {
        uint next = first + (1u << bit);
        if (next < emitterCount && fetchEmitter(next - 1u).cumulative <= bits)
            first = next;
    }
    return first;
}

// A point of an emitter as seen from `position`.
LightSample sampleEmitter(uint index, vec3 position, vec2 u) {
    if (emitterCount == 0u)
        return noLight;
    EmitterRecord emitter = fetchEmitter(index);
    if (emitter.kind == emitterPoint)
        return samplePoint(emitter, position);
    if (hasTriangles && emitter.kind == emitterTriangle)
        return sampleTriangleLight(emitter, position, u);
    return sampleSphereLight(emitter, position, u);
}
