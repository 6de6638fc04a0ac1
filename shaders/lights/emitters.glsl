// Light samples: of lights without size, emitting spheres and triangles, and the environment.

struct LightSample {
    vec3 direction; // unit length, from the surface to the light
    float distance;
    vec3 radiance;  // divided by the pdf; of a point light: intensity / squared distance / probability
    float pdf;  // per solid angle, with the probability of the emitter; 0: a light without size
    uint target;    // the primitive at the end of the shadow ray
};

const float unboundedDistance = 3.4028234e38; // of directional lights and the environment

const LightSample noLight = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0, noPrimitive);

LightSample samplePoint(EmitterRecord emitter, float chance, vec3 position) {
    vec3 toLight = emitter.position - position;
    float distance = vectorLength(toLight);
    float squaredDistance = distance * distance;
    float share = squaredDistance * chance;
    vec3 direction = toLight * divide(1.0, distance);
    return LightSample(direction, distance, emitter.emission * divide(1.0, share), 0.0, noPrimitive);
}

LightSample sampleSpot(EmitterRecord emitter, float chance, vec3 position) {
    LightSample light = samplePoint(emitter, chance, position);
    light.radiance *= spotFalloff(light.direction, emitter.axis, emitter.cosineOuter, emitter.pdf);
    return light;
}

LightSample sampleProfiled(EmitterRecord emitter, float chance, vec3 position) {
    LightSample light = sampleSpot(emitter, chance, position);
    light.radiance *= profileShare(emitter.record, light.direction, emitter.axis);
    return light;
}

LightSample sampleDirectional(EmitterRecord emitter) {
    return LightSample(-emitter.axis, unboundedDistance, emitter.emission * divide(1.0, emitter.probability), 0.0,
                       noPrimitive);
}

LightSample sampleEnvironmentLight(EmitterRecord emitter, uvec2 bits) {
    EnvironmentLight found = sampleEnvironment(bits);
    float pdf = found.pdf * emitter.probability;
    return LightSample(found.direction, unboundedDistance,
                       pdf > 0.0 ? found.radiance * divide(1.0, pdf) : vec3(0.0), pdf, noPrimitive);
}

// Emission of a triangle at the point with these weights, relative to that of its material.
vec3 triangleEmission(vec3 emission, TriangleRecord triangle, uint record, vec2 weights) {
    MaterialRecord material = fetchMaterial(triangle.materialIndex);
    uint textures = material.textures;
    if ((anyHit & anyHitAlpha) != 0u && (triangle.flags & triangleIsAlphaTested) != 0u)
        emission = emission * presenceAt(material, record, weights.x, weights.y);
    if (textures == 0u)
        return emission;
    if ((texturing & texturesEmission) == 0u || !hasTexture(textures, slotEmission))
        return emission;
    return emission * lookUpTexture(textureRow(textures, slotEmission), triangleUvs(record, weights.x, weights.y));
}

// Emission of a sphere at the point `outward` from its centre, likewise.
vec3 sphereEmission(vec3 emission, SphereRecord sphere, vec3 outward) {
    uint textures = fetchMaterial(materialIndexOf(sphere)).textures;
    if (textures == 0u || !hasTexture(textures, slotEmission))
        return emission;
    vec2 uv = sphereUv(outward);
    return emission * lookUpTexture(textureRow(textures, slotEmission), SurfaceUv(uv, uv));
}

LightSample sampleTriangleLight(EmitterRecord emitter, float areaPdf, vec3 position, vec2 u) {
    TriangleRecord triangle = fetchTriangle(emitter.record);
    vec2 weights = sampleTriangle(u);
    Surface surface = triangleSurface(triangle, fetchNormals(emitter.record), weights.x, weights.y);
    vec3 toLight = surface.position - position;
    float distance = vectorLength(toLight);
    vec3 direction = toLight * divide(1.0, distance);
    float facing = -dotProduct(direction, surface.geometricNormal);
    float cosine = isTwoSided(emitter) ? abs(facing) : facing;
    float pdf = solidAnglePdf(areaPdf, distance, cosine);
    bool isSeen = cosine > 0.0 && distance > 0.0;
    vec3 emission = emitter.emission;
    if ((texturing & texturesEmission) != 0u || (anyHit & anyHitAlpha) != 0u)
        emission = triangleEmission(emission, triangle, emitter.record, weights);
    return LightSample(direction, distance, isSeen ? emission * divide(1.0, pdf) : vec3(0.0), pdf,
                       triangle.primitiveId);
}

LightSample sampleSphereLight(EmitterRecord emitter, float chance, float areaPdf, vec3 position, vec2 u) {
    SphereRecord sphere = fetchSphere(emitter.record);
    SphereShape shape = makeSphereShape(sphere.centre, sphere.radius);
    vec3 toCentre = sphere.centre - position;
    float squaredDistance = dotProduct(toCentre, toCentre);
    bool isOutside = squaredDistance > shape.squaredRadius * minConeDistance;
    vec3 direction;
    float distance;
    float pdf;
    bool isSeen;
    if (isOutside) {
        float centreDistance = squareRoot(squaredDistance);
        float height = coneHeight(shape.squaredRadius, squaredDistance);
        direction = sampleCone(toCentre * divide(1.0, centreDistance), height, u);
        float hitDistance = intersectSphere(position, direction, shape, false);
        distance = hitDistance > 0.0 ? hitDistance : centreDistance; // rounding moved the direction past the rim
        pdf = chance * pdfCone(height);
        isSeen = normalSignOf(sphere) > 0.0 || isTwoSided(emitter);
    } else {
        vec3 outward = sampleSphere(u);
        vec3 toLight = toCentre + outward * sphere.radius;
        distance = vectorLength(toLight);
        direction = toLight * divide(1.0, distance);
        float cosine = dotProduct(direction, outward);
        pdf = solidAnglePdf(areaPdf, distance, cosine);
        isSeen = cosine > 0.0 && distance > 0.0 && (normalSignOf(sphere) < 0.0 || isTwoSided(emitter));
    }
    vec3 emission = emitter.emission;
    if ((texturing & texturesEmission) != 0u)
        emission = sphereEmission(emission, sphere, position + direction * distance - sphere.centre);
    return LightSample(direction, distance, isSeen ? emission * divide(1.0, pdf) : vec3(0.0), pdf,
                       emitter.record);
}

// The emitter selected by a 32-bit random number by power; 0 if there is none.
uint chooseByPower(uint bits) {
    uint first = 0u; // the cumulative values of all before it are at most `bits`
    for (int bit = findMSB(emitterCount); bit >= 0; --bit) {
        uint next = first + (1u << bit);
        if (next < emitterCount && fetchEmitter(next - 1u).cumulative <= bits)
            first = next;
    }
    return first;
}

// Of 2^32 random numbers, as many choose each of the emitters that are not in the light tree.
uint numbersPerInfiniteEmitter() { return 0xFFFFFFFFu / (infiniteEmitterCount + 1u); }

float chanceOfInfiniteEmitter() { return floatOf(numbersPerInfiniteEmitter()) * (1.0 / 4294967296.0); }

// The chance of a choice in the light tree at all.
float chanceOfTree() { return 1.0 - float(infiniteEmitterCount) * chanceOfInfiniteEmitter(); }

// The emitter at which a shadow ray from the point aims. By power, its record has the chance.
EmitterChoice chooseEmitter(LitPoint point, uint bits) {
    if (!hasLightTree)
        return EmitterChoice(chooseByPower(bits), 1.0);
    if (infiniteEmitterCount == 0u)
        return chooseInTree(point, bits);
    uint numbers = numbersPerInfiniteEmitter();
    uint infinite = bits / numbers;
    if (infinite < infiniteEmitterCount)
        return EmitterChoice(infinite, chanceOfInfiniteEmitter());
    uint before = numbers * infiniteEmitterCount;
    EmitterChoice choice = chooseInTree(point, spreadNumber(bits - before, 0u - before));
    choice.chance = choice.chance * chanceOfTree();
    return choice;
}

// The pdf, per unit of area, of the light sample at a place of the emitter, whose material has `emitterPdf`. Only
// emitters that the light tree knows are sampled there.
float pdfOfEmitter(uint index, float emitterPdf, LitPoint point) {
    if (!hasLightTree)
        return emitterPdf;
    if (index == noEmitter)
        return 0.0;
    EmitterRecord emitter = fetchEmitter(index);
    float chance = chanceInTree(point, emitter.cumulative);
    float chosen = chance * chanceOfTree();
    return emitter.pdf * (infiniteEmitterCount == 0u ? chance : chosen);
}

// Whether the emitter is of this kind; known at compile time if the scene has no other.
bool isEmitter(EmitterRecord emitter, uint kind) {
    uint bit = 1u << kind;
    return (lighting & bit) != 0u && (lighting == bit || emitter.kind == kind);
}

// Samples a point of an emitter, as seen from `position`, by two 32-bit random numbers.
LightSample sampleEmitter(EmitterChoice choice, vec3 position, uvec2 bits) {
    if (emitterCount == 0u || choice.chance <= 0.0)
        return noLight;
    EmitterRecord emitter = fetchEmitter(choice.index);
    float chance = hasLightTree ? choice.chance : emitter.probability;
    float areaPdf = hasLightTree ? emitter.pdf * choice.chance : emitter.pdf;
    if (isEmitter(emitter, emitterPoint))
        return samplePoint(emitter, chance, position);
    if (isEmitter(emitter, emitterSpot))
        return sampleSpot(emitter, chance, position);
    if (isEmitter(emitter, emitterProfiled))
        return sampleProfiled(emitter, chance, position);
    if (isEmitter(emitter, emitterDirectional))
        return sampleDirectional(emitter);
    if (isEmitter(emitter, emitterEnvironment))
        return sampleEnvironmentLight(emitter, bits);
    if (isEmitter(emitter, emitterTriangle))
        return sampleTriangleLight(emitter, areaPdf, position, unitFloats(bits));
    if ((lighting & lightsBySpheres) != 0u)
        return sampleSphereLight(emitter, chance, areaPdf, position, unitFloats(bits));
    return noLight;
}
