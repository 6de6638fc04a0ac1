// Normal maps.

// Tangents: the directions on a surface in which u and v grow, of any length; 0 if unknown.
struct Tangent {
    vec3 alongU;
    vec3 alongV;
};

const float minSpan = 1e-30;        // of a triangle and of its texture coordinates
const float maxSpan = 1e30;          // of coordinates: the inverse is not subnormal
const float minDeterminant = 1e-20; // of coordinates on one line, up to rounding
const float minHeight = 0.01;       // of a mapped normal, and of the direction that it reflects, above the surface

// Coordinates and edges are scaled first, because their products would leave the range of floats.
Tangent triangleTangent(TriangleRecord triangle, Coordinates at) {
    vec3 edge1 = triangle.v1 - triangle.v0;
    vec3 edge2 = triangle.v2 - triangle.v0;
    vec2 step1 = at.uv1 - at.uv0;
    vec2 step2 = at.uv2 - at.uv0;
    float size = largestComponent(greater(abs(edge1), abs(edge2)));
    float span = greater(greater(abs(step1.x), abs(step1.y)), greater(abs(step2.x), abs(step2.y)));
    if (!(size > minSpan && span > minSpan && span < maxSpan))
        return Tangent(vec3(0.0), vec3(0.0));
    vec3 a = edge1 * divide(1.0, size);
    vec3 b = edge2 * divide(1.0, size);
    vec2 s = step1 * divide(1.0, span);
    vec2 t = step2 * divide(1.0, span);
    float determinant = s.x * t.y - t.x * s.y;
    if (!(abs(determinant) > minDeterminant))
        return Tangent(vec3(0.0), vec3(0.0));
    vec3 alongU = a * t.y - b * s.y;
    vec3 alongV = b * s.x - a * t.x;
    return determinant > 0.0 ? Tangent(alongU, alongV) : Tangent(-alongU, -alongV);
}

// Interpolated tangents of the vertices; w of each corner is the side of alongV. In a triangle without them it is 0,
// and so are these. `normal` is that of the shading.
Tangent vertexTangent(vec4 t0, vec4 t1, vec4 t2, vec3 normal, float u, float v) {
    vec3 alongU = trianglePoint(vec3(t0.x, t0.y, t0.z), vec3(t1.x, t1.y, t1.z), vec3(t2.x, t2.y, t2.z), u, v);
    vec3 alongV = crossProduct(normal, alongU) * t0.w;
    return Tangent(alongU, alongV);
}

bool isKnown(Tangent tangent) { return dotProduct(tangent.alongU, tangent.alongU) > 0.0; }

// Whether a lookup by the TextureRecord at `row` takes the second texture coordinates.
bool usesSecondUv(uint row) { return (textureWords(row).z & textureUsesSecondUv) != 0u; }

// Row of the tangents of a triangle's vertices.
uint tangentRow(uint triangleRecord) { return triangleRow(triangleRecord) + rowsPerTriangle(texturing) - 3u; }

vec4 fetchTangent(uint row) { return uintBitsToFloat(textureWords(row)); }

// Tangents at the point of a sphere with the outward normal `outward`.
Tangent sphereTangent(vec3 outward) {
    vec3 alongU = vec3(outward.z, 0.0, -outward.x);
    return Tangent(alongU, crossProduct(outward, alongU));
}

// Applies the normal map of a TextureRecord's row to a unit normal, which stays as it is if the tangents are unknown.
vec3 mappedNormal(vec3 normal, Tangent tangent, uint row, SurfaceUv at) {
    vec3 flatU = tangent.alongU - normal * dotProduct(normal, tangent.alongU);
    if (!(dotProduct(flatU, flatU) > minSpan))
        return normal;
    vec3 x = unitVector(flatU);
    vec3 left = crossProduct(normal, x);
    vec3 y = dotProduct(left, tangent.alongV) < 0.0 ? -left : left;
    float strength = uintBitsToFloat(textureWords(row).w);
    vec3 texel = lookUpTexture(row, at);
    vec3 turned = 2.0 * texel - 1.0;
    vec2 sideways = vec2(turned) * strength;
    vec3 mapped = x * sideways.x + y * sideways.y + normal * greater(turned.z, minHeight);
    return unitVector(mapped);
}

// Approximately the unit normal nearest to `normal` that faces a ray in `direction` and does not reflect it into the
// surface; normal maps guarantee neither. Keller et al., "The Iray Light Transport Simulation and Rendering System",
// 2017, section A.3.
vec3 visibleNormal(vec3 direction, vec3 normal, vec3 geometricNormal) {
    bool isBehind = dotProduct(direction, geometricNormal) > 0.0;
    vec3 facing = isBehind ? -normal : normal;
    vec3 up = isBehind ? -geometricNormal : geometricNormal;
    float lack = minHeight + dotProduct(direction, facing);
    vec3 raised = facing - direction * lack;
    if (lack > 0.0)
        facing = unitVector(raised);
    vec3 mirrored = mirrorDirection(direction, facing);
    float depth = minHeight - dotProduct(mirrored, up);
    if (depth > 0.0) {
        vec3 grazing = unitVector(mirrored + up * depth);
        facing = unitVector(grazing - direction);
    }
    return isBehind ? -facing : facing;
}
