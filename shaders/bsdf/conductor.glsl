// What metals reflect. Twin: host/reference/conductor.h.

// Fresnel's equations for unpolarised light at a surface from vacuum to the complex refractive index n + i k: Lagarde,
// "Memo on Fresnel equations", 2013. `cosine` in [0, 1].
float conductorReflectance(float cosine, float index, float extinction) {
    precise float squaredCosine = cosine * cosine;
    precise float squaredSine = 1.0 - squaredCosine;
    precise float squaredIndex = index * index;
    precise float squaredExtinction = extinction * extinction;
    precise float difference = squaredIndex - squaredExtinction - squaredSine;
    precise float squaredLength = difference * difference + 4.0 * squaredIndex * squaredExtinction;
    float length = squareRoot(squaredLength);
    precise float halfSum = 0.5 * (length + difference);
    precise float a = squareRoot(greater(halfSum, 0.0));
    precise float sum = length + squaredCosine;
    precise float twice = 2.0 * cosine * a;
    precise float acrossBelow = sum + twice;
    precise float acrossAbove = sum - twice;
    precise float otherSum = squaredCosine * length + squaredSine * squaredSine;
    precise float otherTwice = twice * squaredSine;
    precise float alongBelow = otherSum + otherTwice;
    precise float alongAbove = otherSum - otherTwice;
    float across = divide(acrossAbove, acrossBelow);
    float along = divide(alongAbove, alongBelow);
    precise float reflectance = 0.5 * across * (1.0 + along);
    return lesser(reflectance, 1.0);
}

vec3 conductorReflectance(float cosine, vec3 index, vec3 extinction) {
    return vec3(conductorReflectance(cosine, index.x, extinction.x), conductorReflectance(cosine, index.y, extinction.y),
                conductorReflectance(cosine, index.z, extinction.z));
}

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994: from `normal` seen head on to 1.
vec3 schlickReflectance(float cosine, vec3 normal) {
    precise float k = 1.0 - lesser(cosine, 1.0);
    precise float k2 = k * k;
    precise float grazing = k2 * k2 * k;
    precise vec3 reflectance = normal + (1.0 - normal) * grazing;
    return reflectance;
}
