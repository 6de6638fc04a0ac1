// Ray-sphere intersection. Twin: host/reference/sphere.h.

// The smallest positive distance at which a ray meets a sphere, or a negative number. `direction` is of unit length.
//
// Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// chapter 7: the discriminant comes from the vector between the centre and its nearest point on the ray, and the
// roots from c/q and q, so that neither cancels for small or for giant spheres.
//
// A ray that starts on the sphere has one root that is 0 by definition, and the other is -2 f.d: it cannot find its
// own starting point again, whatever the rounding, and no offset is needed.
float intersectSphere(vec3 origin, vec3 direction, vec3 centre, float radius, bool startsOnSphere) {
    precise vec3 f = origin - centre;
    precise float b = dotProduct(f, direction);
    precise vec3 nearest = f - direction * b;
    precise float squaredRadius = radius * radius;
    precise float discriminant = squaredRadius - dotProduct(nearest, nearest);
    precise float c = dotProduct(f, f) - squaredRadius;
    precise float root = squareRoot(greater(discriminant, 0.0));
    precise float q = b >= 0.0 ? -b - root : root - b;
    float r = divide(c, q);
    precise float chord = -2.0 * b;
    float first = r < q ? r : q;
    float second = r < q ? q : r;
    // Along the tangent the sign of a chord is that of rounding.
    precise float shortest = radius * (8.0 / 16777216.0);
    float across = chord > shortest ? chord : -1.0;
    float distance = startsOnSphere ? across : (first > 0.0 ? first : second);
    return startsOnSphere || discriminant > 0.0 ? distance : -1.0;
}
