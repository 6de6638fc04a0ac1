// How densely a way of aiming at light covers directions.

const float fourPi = 12.566370614359173;

// Per solid angle, of a point chosen with `areaPdf` per unit of area; `cosine` > 0 is that at the light.
float solidAnglePdf(float areaPdf, float distance, float cosine) {
    float scaled = areaPdf * (distance * distance);
    return divide(scaled, cosine);
}

// Seen from further away than this, in squared radii, a sphere is sampled by the cone of directions to it, else by area.
const float minConeDistance = 1.0001;

float squaredDistanceTo(vec3 centre, vec3 position) {
    vec3 toCentre = centre - position;
    return dotProduct(toCentre, toCentre);
}

// The density with which a sphere is aimed at from `position` in a direction that meets it after `distance`; 0 where that
// point is never chosen. `outward` is the sphere's outward normal there.
float pdfSphereLight(vec3 position, vec3 direction, float distance, vec3 centre, float radius, vec3 outward,
                         float areaPdf) {
    float squaredRadius = radius * radius;
    float squaredDistance = squaredDistanceTo(centre, position);
    if (squaredDistance > squaredRadius * minConeDistance)
        return areaPdf * (fourPi * squaredRadius) * pdfCone(coneHeight(squaredRadius, squaredDistance));
    float cosine = dotProduct(direction, outward);
    return cosine > 0.0 ? solidAnglePdf(areaPdf, distance, cosine) : 0.0;
}
