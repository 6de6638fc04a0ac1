// Instances: triangles and boxes of a mesh where an instance places it.
//
// A triangle is brought to world space and tested there, by the operations by which the host flattens instances: so its
// hits have the bits of the flattened mesh. Boxes only have to be conservative, and are tested in world space too: the
// image of a box is a parallelepiped, and what is tested is the box around it. A test in the mesh's space would be
// tighter where meshes are rotated, but could lose hits: a hit on a sliver seen edge-on may lie anywhere in the
// triangle's own box in world space, to which it is confined (triangle.glsl), and far from the triangle.
//
// How wide must the box be? Let u be the unit of rounding, M the reach and p = 16 u M the pad of the ray's own box
// tests (box.glsl), m and t the map, and v the largest coordinates of the mesh. A vertex in world space is rounded by
// at most 5 u (|m| v + |t|). In distances along the ray, times |inverse|: the interval of the triangle's own box is p
// and another 4 u M wider than the triangle. Here each of the sums is rounded by at most 12 u (|m| v + |t - origin|).
// The record's slack is 24 u (|m| v + |t|), at least; with 2 p and 16 u |t - origin| all of it is covered.

struct PlacedBoxRay {
    vec3 perX; // what a unit of each coordinate of the mesh adds to the distances to the planes across x, y and z
    vec3 perY;
    vec3 perZ;
    vec3 base; // the distances for the mesh's origin
    vec3 pad;  // widens every box on every side, in distances
};

// `toX`, `toY`, `toZ` and `offset` are the map, `slack` what it needs in world space.
PlacedBoxRay makePlacedBoxRay(BoxRay ray, vec3 toX, vec3 toY, vec3 toZ, vec3 offset, vec3 slack) {
    vec3 between = offset - ray.origin;
    vec3 roundings = slack + abs(between) * boxPadScale + 2.0 * ray.pad;
    return PlacedBoxRay(vec3(toX.x, toY.x, toZ.x) * ray.inverse, vec3(toX.y, toY.y, toZ.y) * ray.inverse,
                        vec3(toX.z, toY.z, toZ.z) * ray.inverse, between * ray.inverse, roundings * abs(ray.inverse));
}

PlacedBoxRay makePlacedBoxRay(BoxRay ray, InstanceRecord instance) {
    return makePlacedBoxRay(ray, instance.toX, instance.toY, instance.toZ,
                            vec3(instance.offsetX, instance.offsetY, instance.offsetZ), instance.slack);
}

// As boxInterval, for the box `extent` on both sides of `middle` in the mesh's coordinates.
vec2 placedBoxInterval(PlacedBoxRay ray, vec3 middle, vec3 extent) {
    vec3 along = ray.perX * middle.x + ray.perY * middle.y + ray.perZ * middle.z + ray.base;
    vec3 around = abs(ray.perX) * extent.x + abs(ray.perY) * extent.y + abs(ray.perZ) * extent.z + ray.pad;
    float enter = greater(largestComponent(along - around), 0.0);
    float leave = smallestComponent(along + around);
    return vec2(enter, leave);
}

vec3 placedPoint(InstanceRecord instance, vec3 v) {
    return vec3(instance.toX.x * v.x + instance.toX.y * v.y + instance.toX.z * v.z + instance.offsetX,
                instance.toY.x * v.x + instance.toY.y * v.y + instance.toY.z * v.z + instance.offsetY,
                instance.toZ.x * v.x + instance.toZ.y * v.y + instance.toZ.z * v.z + instance.offsetZ);
}

// A triangle of the mesh in world space.
TriangleRecord placedTriangle(InstanceRecord instance, TriangleRecord triangle) {
    TriangleRecord placed = triangle;
    placed.v0 = placedPoint(instance, triangle.v0);
    placed.v1 = placedPoint(instance, triangle.v1);
    placed.v2 = placedPoint(instance, triangle.v2);
    placed.primitiveId = triangle.primitiveId + instance.firstPrimitive;
    return placed;
}

// Normals follow the cofactors of the map: the inverse transpose, except for a positive factor. (Where the map mirrors,
// the mesh's copy for mirroring instances has negative normals.) A normal of length 0 keeps its meaning.
vec3 placedNormal(InstanceRecord instance, vec3 normal) {
    vec3 size = greater(greater(abs(instance.toX), abs(instance.toY)), abs(instance.toZ));
    float scale = divide(1.0, largestComponent(size));
    vec3 x = instance.toX * scale;
    vec3 y = instance.toY * scale;
    vec3 z = instance.toZ * scale;
    vec3 turned = vec3(dotProduct(crossProduct(y, z), normal), dotProduct(crossProduct(z, x), normal),
                       dotProduct(crossProduct(x, y), normal));
    // Scaled first, because the square of a tiny vector leaves the range of floats.
    float largest = largestComponent(abs(turned));
    return largest > 0.0 ? unitVector(turned * divide(1.0, largest)) : vec3(0.0);
}

NormalRecord placedNormals(InstanceRecord instance, NormalRecord normals) {
    NormalRecord placed = normals;
    placed.n0 = placedNormal(instance, normals.n0);
    placed.n1 = placedNormal(instance, normals.n1);
    placed.n2 = placedNormal(instance, normals.n2);
    return placed;
}

// A tangent follows the map itself, and keeps the side in w: the mesh's copy for mirroring instances has the other one.
vec4 placedTangent(InstanceRecord instance, vec4 tangent) {
    vec3 along = vec3(instance.toX.x * tangent.x + instance.toX.y * tangent.y + instance.toX.z * tangent.z,
                      instance.toY.x * tangent.x + instance.toY.y * tangent.y + instance.toY.z * tangent.z,
                      instance.toZ.x * tangent.x + instance.toZ.y * tangent.y + instance.toZ.z * tangent.z);
    return vec4(along, tangent.w);
}
