// Surface points and the origins of rays that leave them.

struct Surface {
    vec3 position;
    vec3 error;           // bound on the rounding error of the position
    vec3 normal;          // for shading, unit length
    vec3 geometricNormal; // of the surface itself, unit length, on the side of `normal`
};

Surface sphereSurface(vec3 origin, vec3 direction, float distance, SphereRecord sphere) {
    vec3 position = origin + direction * distance;
    vec3 outward = position - sphere.centre;
    vec3 normal = unitVector(outward) * normalSignOf(sphere);
    return Surface(position, vec3(0.0), normal, normal);
}

// A triangle whose corners have no normals. The point of the hit keeps a distance of about 8 units of rounding of the
// largest coordinate from the edges, so that rounding does not carry it past the next wall of a closed mesh, where a
// ray would leave through the edge. In a triangle that is narrower than twice that it is in the middle.
Surface flatSurface(TriangleRecord triangle, float u, float v) {
    vec3 edge1 = triangle.v1 - triangle.v0;
    vec3 edge2 = triangle.v2 - triangle.v0;
    vec3 area = crossProduct(edge1, edge2);
    // Scaled first, because the square of a tiny or a giant area leaves the range of floats.
    float largest = largestComponent(abs(area));
    float inverse = divide(1.0, largest);
    vec3 geometric = largest > 0.0 ? unitVector(area * inverse) : vec3(0.0); // no area: no light
    // Of a weight, which is the height above an edge by that of the opposite corner: the area of both edges'
    // parallelogram by the length of the edge.
    float extent = largestComponent(greater(abs(edge1), abs(edge2)));
    float reach = largestComponent(greater(greater(abs(triangle.v0), abs(triangle.v1)), abs(triangle.v2)));
    float margin = lesser(reach * (8.0 / 16777216.0) * (extent * inverse), 1.0 / 3.0);
    float first = greater(lesser(u, 1.0 - 2.0 * margin), margin);
    float second = greater(lesser(v, 1.0 - margin - first), margin);
    Surface surface;
    surface.position = trianglePoint(triangle.v0, triangle.v1, triangle.v2, first, second);
    surface.error = trianglePointError(triangle.v0, triangle.v1, triangle.v2, first, second);
    surface.normal = geometric;
    surface.geometricNormal = geometric;
    return surface;
}

// With the normals of the corners, blended. Those of a corner without one are 0.
Surface triangleSurface(TriangleRecord triangle, NormalRecord normals, float u, float v) {
    Surface surface = flatSurface(triangle, u, v);
    vec3 blended = trianglePoint(normals.n0, normals.n1, normals.n2, u, v);
    if (dotProduct(blended, blended) > 0.0)
        surface.normal = unitVector(blended);
    if (dotProduct(surface.geometricNormal, surface.normal) < 0.0)
        surface.geometricNormal = -surface.geometricNormal;
    return surface;
}

// Origin of a ray that leaves the surface in `direction`: moved along the geometric normal, to the side of the
// direction, by the bound on the error in that direction (Wächter and Binder, "A Fast and Robust Method for Avoiding
// Self-Intersection", Ray Tracing Gems, chapter 6, and PBRT section 6.8.6, name the problem; trianglePointError has the
// bound). Spheres need no offset.
vec3 offsetRayOrigin(Surface surface, vec3 direction) {
    if (!hasTriangles)
        return surface.position; // the same, unless the normal is NaN
    float distance = dotProduct(abs(surface.geometricNormal), surface.error);
    float side = dotProduct(direction, surface.geometricNormal) < 0.0 ? -distance : distance;
    return surface.position + surface.geometricNormal * side;
}
