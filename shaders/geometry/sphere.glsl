// Ray-sphere intersection.

struct SphereShape {
    vec3 centre;
    float squaredRadius;
    float minChord; // a chord shorter than this is only rounding error
};

SphereShape makeSphereShape(vec3 centre, float radius) {
    float squaredRadius = radius * radius;
    float minChord = radius * (8.0 / 16777216.0);
    return SphereShape(centre, squaredRadius, minChord);
}

// The smallest positive distance at which a ray hits a sphere, or a negative number. `direction` has unit length.
//
// Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// chapter 7: the discriminant comes from the vector between the centre and its nearest point on the ray, and the
// roots from c/q and q, so that neither cancels for small or for giant spheres.
//
// A ray that starts on the sphere has one root that is 0 by definition; the other one is -2 f.d. So it cannot hit its
// own starting point, however values are rounded, and needs no offset.
float intersectSphere(vec3 origin, vec3 direction, SphereShape sphere, bool startsOnSphere) {
    vec3 f = origin - sphere.centre;
    float b = dotProduct(f, direction);
    vec3 nearest = f - direction * b;
    float discriminant = sphere.squaredRadius - dotProduct(nearest, nearest);
    float c = dotProduct(f, f) - sphere.squaredRadius;
    float root = squareRoot(greater(discriminant, 0.0));
    float q = b >= 0.0 ? -b - root : root - b;
    float r = divide(c, q);
    float chord = -2.0 * b;
    float first = r < q ? r : q;
    float second = r < q ? q : r;
    float across = chord > sphere.minChord ? chord : -1.0;
    float distance = startsOnSphere ? across : (first > 0.0 ? first : second);
    return startsOnSphere || discriminant > 0.0 ? distance : -1.0;
}

// Margin of a sphere's own box on each side: 4 units of rounding, which cover the rounding of the corners.
vec3 sphereBoxMargin(vec3 centre, float radius) { return (abs(centre) + radius) * (4.0 / 16777216.0); }

// As intersectSphere, for a sphere in a tree. Like that of a triangle (triangle.glsl), the hit is confined to the
// interval of the sphere's own box: so no tree can lose or change it (box.glsl). Trees are built over the same box.
float intersectBoxedSphere(BoxRay ray, vec3 direction, vec3 centre, float radius, bool startsOnSphere) {
    float distance = intersectSphere(ray.origin, direction, makeSphereShape(centre, radius), startsOnSphere);
    vec3 margin = sphereBoxMargin(centre, radius);
    vec2 interval = boxInterval(ray, centre - radius - margin, centre + radius + margin);
    float confined = lesser(greater(distance, interval.x), interval.y);
    return distance > 0.0 && interval.x <= interval.y ? confined : 0.0;
}
