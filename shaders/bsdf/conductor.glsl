// Fresnel reflectance of conductors.

// Fresnel's equations for unpolarised light at a surface from vacuum to the complex refractive index n + i k: Lagarde,
// "Memo on Fresnel equations", 2013. `cosine` in [0, 1].
float conductorReflectance(float cosine, float index, float extinction) {
    float squaredCosine = cosine * cosine;
    float squaredSine = 1.0 - squaredCosine;
    float squaredIndex = index * index;
    float squaredExtinction = extinction * extinction;
    float difference = squaredIndex - squaredExtinction - squaredSine;
    float squaredLength = difference * difference + 4.0 * squaredIndex * squaredExtinction;
    float length = squareRoot(squaredLength);
    float halfSum = 0.5 * (length + difference);
    float a = squareRoot(greater(halfSum, 0.0));
    float sum = length + squaredCosine;
    float twice = 2.0 * cosine * a;
    float acrossBelow = sum + twice;
    float acrossAbove = sum - twice;
    float otherSum = squaredCosine * length + squaredSine * squaredSine;
    float otherTwice = twice * squaredSine;
    float alongBelow = otherSum + otherTwice;
    float alongAbove = otherSum - otherTwice;
    float across = divide(acrossAbove, acrossBelow);
    float along = divide(alongAbove, alongBelow);
    float reflectance = 0.5 * across * (1.0 + along);
    return lesser(reflectance, 1.0);
}

vec3 conductorReflectance(float cosine, vec3 index, vec3 extinction) {
    return vec3(conductorReflectance(cosine, index.x, extinction.x),
                conductorReflectance(cosine, index.y, extinction.y),
                conductorReflectance(cosine, index.z, extinction.z));
}

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994: from `normal` at normal incidence to
// `grazing`.
vec3 schlickReflectance(float cosine, vec3 normal, float grazing) {
    float k = 1.0 - lesser(cosine, 1.0);
    float k2 = k * k;
    float share = k2 * k2 * k;
    return normal + (grazing - normal) * share;
}
