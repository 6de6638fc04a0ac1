// Pdfs of light sampling.

const float fourPi = 12.566370614359173;

// Converts `areaPdf`, per unit of area, to solid angle; `cosine` > 0 is that at the light.
float solidAnglePdf(float areaPdf, float distance, float cosine) {
    float scaled = areaPdf * (distance * distance);
    return divide(scaled, cosine);
}

// Beyond this distance, in squared radii, a sphere is sampled by the cone of directions to it, else by area.
const float minConeDistance = 1.0001;

float squaredDistanceTo(vec3 centre, vec3 position) {
    vec3 toCentre = centre - position;
    return dotProduct(toCentre, toCentre);
}

// The pdf, per solid angle, of sampling the point of a sphere at `distance` from `position`; 0 if that point is never
// sampled. `outward` is the outward normal of the sphere there.
float pdfSphereLight(vec3 position, vec3 direction, float distance, vec3 centre, float radius, vec3 outward,
                         float areaPdf) {
    float squaredRadius = radius * radius;
    float squaredDistance = squaredDistanceTo(centre, position);
    if (squaredDistance > squaredRadius * minConeDistance)
        return areaPdf * (fourPi * squaredRadius) * pdfCone(coneHeight(squaredRadius, squaredDistance));
    float cosine = dotProduct(direction, outward);
    return cosine > 0.0 ? solidAnglePdf(areaPdf, distance, cosine) : 0.0;
}
