// Fresnel reflectance and refraction of dielectrics.

struct Refraction {
    vec3 direction;    // of the transmitted ray, unit length; meaningless when total
    float reflectance; // share of the light that is reflected, in [0, 1]
    float transmittance; // the rest
    bool isTotal;      // nothing is transmitted
};

// Smooth glass for the Whitted integrator. The unit normal `facing` is on the side that `direction` comes from. `index`
// is the refractive index of the glass relative to its surroundings; `isEntering`: the ray comes from outside.
//
// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, with the cosine on the optically thinner
// side, so that the reflectance rises to 1 at the critical angle.
Refraction refractRay(vec3 direction, vec3 facing, float index, bool isEntering) {
    float eta = isEntering ? divide(1.0, index) : index;
    float cosIncident = -dotProduct(direction, facing);
    float radicand = 1.0 - eta * eta * (1.0 - cosIncident * cosIncident);
    float cosTransmitted = squareRoot(greater(radicand, 0.0));
    float along = eta * cosIncident - cosTransmitted;
    vec3 transmitted = direction * eta + facing * along;
    float below = 1.0 - index;
    float above = 1.0 + index;
    float ratio = divide(below, above);
    float normalReflectance = ratio * ratio;
    float k = 1.0 - lesser(isEntering ? cosIncident : cosTransmitted, 1.0);
    float k2 = k * k;
    float reflectance = normalReflectance + (1.0 - normalReflectance) * (k2 * k2 * k);
    float transmittance = 1.0 - reflectance;
    return Refraction(unitVector(transmitted), reflectance, transmittance, radicand < 0.0);
}

struct DielectricFresnel {
    vec3 refracted;    // direction, unit length; meaningless where the reflectance is 1
    float reflectance; // in [0, 1]; 1: total
};

// Fresnel's equations for unpolarised light at a smooth interface. `direction` comes from the side of the unit normal
// `facing`; `eta` is the refractive index on that side divided by that on the other side.
DielectricFresnel fresnelDielectric(vec3 direction, vec3 facing, float eta) {
    float cosIncident = -dotProduct(direction, facing);
    float radicand = 1.0 - eta * eta * (1.0 - cosIncident * cosIncident);
    float cosTransmitted = squareRoot(greater(radicand, 0.0));
    float along = eta * cosIncident - cosTransmitted;
    vec3 refracted = direction * eta + facing * along;
    float acrossBefore = eta * cosIncident;
    float alongBeyond = eta * cosTransmitted;
    float acrossDifference = acrossBefore - cosTransmitted;
    float acrossSum = acrossBefore + cosTransmitted;
    float alongDifference = cosIncident - alongBeyond;
    float alongSum = cosIncident + alongBeyond;
    float across = divide(acrossDifference, acrossSum);
    float parallel = divide(alongDifference, alongSum);
    float reflectance = 0.5 * (across * across + parallel * parallel);
    return DielectricFresnel(unitVector(refracted), radicand > 0.0 ? lesser(reflectance, 1.0) : 1.0);
}
