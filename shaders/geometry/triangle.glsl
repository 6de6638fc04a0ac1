// Watertight ray-triangle intersection.
//
// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. The vertices are sheared to where
// the ray is the z axis, so a vertex has one image for all triangles that share it. An edge function
// fl(fl(a b) - fl(c d)) never has the wrong sign, as rounding is monotone: it is right or 0, and 0 counts as inside.
// Hence no ray passes between triangles that share an edge or a vertex. Unlike the paper we need no second precision
// where an edge function is 0: the hit is confined to the triangle's own box, which also keeps needles from being
// hit where they are not. The limit: where all three are rounded to 0 there is no hit, which happens to needles whose
// width is below 1e-6 of their length.

struct TriangleRay {
    vec3 origin;
    uint axis;  // the largest component of the direction: 0, 1, 2
    vec3 shear; // direction[x]/direction[z], direction[y]/direction[z], 1/direction[z], with z = axis
};

struct TriangleHit {
    float distance; // not positive: no hit
    float u;        // weights of the first and the second vertex
    float v;
    bool isBehind; // the ray comes from where the vertices are clockwise
};

// Rotates components so that the given axis becomes z.
vec3 axisToZ(vec3 v, uint axis) {
    return axis == 0u ? vec3(v.y, v.z, v.x) : (axis == 1u ? vec3(v.z, v.x, v.y) : v);
}

TriangleRay makeTriangleRay(vec3 origin, vec3 direction) {
    vec3 size = abs(direction);
    TriangleRay ray;
    ray.origin = origin;
    ray.axis = size.z >= size.x && size.z >= size.y ? 2u : (size.y >= size.x ? 1u : 0u);
    vec3 along = axisToZ(direction, ray.axis);
    float inverse = divide(1.0, along.z);
    ray.shear = vec3(vec2(along) * inverse, inverse);
    return ray;
}

TriangleHit intersectTriangle(TriangleRay ray, BoxRay boxRay, vec3 v0, vec3 v1, vec3 v2) {
    vec3 to0 = v0 - ray.origin;
    vec3 to1 = v1 - ray.origin;
    vec3 to2 = v2 - ray.origin;
    vec3 a = axisToZ(to0, ray.axis);
    vec3 b = axisToZ(to1, ray.axis);
    vec3 c = axisToZ(to2, ray.axis);
    vec2 shear = vec2(ray.shear);
    vec2 p = vec2(a) - shear * a.z;
    vec2 q = vec2(b) - shear * b.z;
    vec2 r = vec2(c) - shear * c.z;
    float e0 = r.x * q.y - r.y * q.x;
    float e1 = p.x * r.y - p.y * r.x;
    float e2 = q.x * p.y - q.y * p.x;
    float least = lesser(lesser(e0, e1), e2);
    float greatest = greater(greater(e0, e1), e2);
    bool isInside = lesser(greatest, -least) <= 0.0; // least >= 0 or greatest <= 0
    float determinant = e0 + e1 + e2;
    float inverse = divide(1.0, determinant);
    float u = e0 * inverse;
    float v = e1 * inverse;
    float w = e2 * inverse;
    float depth = (u * a.z + v * b.z + w * c.z) * ray.shear.z;
    vec2 interval =
        relativeBoxInterval(boxRay, lesser(lesser(to0, to1), to2), greater(greater(to0, to1), to2));
    float distance = lesser(greater(depth, interval.x), interval.y);
    bool isHit = isInside && determinant != 0.0 && interval.x <= interval.y;
    // The determinant is twice the area of the image: of triangles seen from their front it has the sign of shear.z.
    bool isBehind = (determinant < 0.0) != (ray.shear.z < 0.0);
    return TriangleHit(isHit ? distance : 0.0, u, v, isBehind);
}

// The point at barycentric weights u, v, 1-u-v.
vec3 trianglePoint(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
    float w = 1.0 - u - v;
    return v0 * u + v1 * v + v2 * w;
}

// Error bound of trianglePoint, for each coordinate. The first part is the distance of the point from the plane, by
// Pharr, Jakob and Humphreys, "Physically Based Rendering", section 6.8.5, with 8 units of rounding in place of
// gamma(7). The second part is the apparent distance of a neighbour in the same plane, whose depth is uncertain by
// units of rounding of its size; the size of this triangle stands for it. Without the second part, the triangles of a
// floor at y = 0 would shadow each other.
vec3 trianglePointError(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
    float w = 1.0 - u - v;
    float extent = largestComponent(greater(abs(v1 - v0), abs(v2 - v0)));
    vec3 size = abs(v0 * u) + abs(v1 * v) + abs(v2 * w) + extent;
    return size * (8.0 / 16777216.0);
}
