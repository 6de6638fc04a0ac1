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

// A vertex as the ray sees it, for an origin at 0.
struct VertexImage {
    vec2 place;
    float along; // the ray's axis
};

VertexImage imageOfVertex(TriangleRay ray, vec3 toVertex) {
    vec3 turned = axisToZ(toVertex, ray.axis);
    return VertexImage(vec2(turned) - vec2(ray.shear) * turned.z, turned.z);
}

// Positive or negative: on which side of the edge from p to q the ray is. The edge from q to p has the opposite.
float edgeFunction(VertexImage p, VertexImage q) { return q.place.x * p.place.y - q.place.y * p.place.x; }

// Whether the line of the ray goes through the triangle with these edge functions.
bool isInside(float e0, float e1, float e2) {
    float least = lesser(lesser(e0, e1), e2);
    float greatest = greater(greater(e0, e1), e2);
    return lesser(greatest, -least) <= 0.0; // least >= 0 or greatest <= 0
}

// The hit of a triangle, from its edge functions and the depths of its vertices along the ray's axis, each by the
// number of its vertex, and its box, for an origin at 0.
TriangleHit hitOfTriangle(TriangleRay ray, BoxRay boxRay, vec3 edges, vec3 along, vec3 lower, vec3 upper) {
    float determinant = edges.x + edges.y + edges.z;
    float inverse = divide(1.0, determinant);
    float u = edges.x * inverse;
    float v = edges.y * inverse;
    float w = edges.z * inverse;
    float depth = (u * along.x + v * along.y + w * along.z) * ray.shear.z;
    vec2 interval = relativeBoxInterval(boxRay, lower, upper);
    float distance = lesser(greater(depth, interval.x), interval.y);
    bool isHit = isInside(edges.x, edges.y, edges.z) && determinant != 0.0 && interval.x <= interval.y;
    // The determinant is twice the area of the image: of triangles seen from their front it has the sign of shear.z.
    bool isBehind = (determinant < 0.0) != (ray.shear.z < 0.0);
    return TriangleHit(isHit ? distance : 0.0, u, v, isBehind);
}

TriangleHit intersectTriangle(TriangleRay ray, BoxRay boxRay, vec3 v0, vec3 v1, vec3 v2) {
    vec3 to0 = v0 - ray.origin;
    vec3 to1 = v1 - ray.origin;
    vec3 to2 = v2 - ray.origin;
    VertexImage p = imageOfVertex(ray, to0);
    VertexImage q = imageOfVertex(ray, to1);
    VertexImage r = imageOfVertex(ray, to2);
    vec3 edges = vec3(edgeFunction(q, r), edgeFunction(r, p), edgeFunction(p, q));
    return hitOfTriangle(ray, boxRay, edges, vec3(p.along, q.along, r.along), lesser(lesser(to0, to1), to2),
                         greater(greater(to0, to1), to2));
}

// Two triangles with a common edge, by what the kernels for lavapipe know of a leaf: the edge runs from `begin` to
// `end` in the first one, where `begin` is the vertex number `firstCorner`, and from `end` to `begin` in the second
// one, where `end` is number `secondCorner`.
struct JoinedTriangles {
    vec3 begin;
    vec3 end;
    vec3 firstApex;
    vec3 secondApex;
    uint firstCorner;
    uint secondCorner;
};

struct PairHit {
    TriangleHit hit;
    bool isSecond; // it is that of the second triangle
    bool isBoth;   // the line of the ray goes through the second triangle, too
};

// Values of a triangle's corners by their numbers, from those in turn from number `corner` on.
vec3 byCorner(vec3 inTurn, uint corner) {
    return corner == 0u ? inTurn
                        : (corner == 1u ? vec3(inTurn.z, inTurn.x, inTurn.y) : vec3(inTurn.y, inTurn.z, inTurn.x));
}

// Of the triangles to be taken, the first whose image the line of the ray goes through, with the bits of
// intersectTriangle. The edge functions decide which it is, so that the rest is computed once: it takes little longer
// than one triangle.
PairHit intersectPair(TriangleRay ray, BoxRay boxRay, JoinedTriangles pair, bool takesFirst, bool takesSecond) {
    vec3 toBegin = pair.begin - ray.origin;
    vec3 toEnd = pair.end - ray.origin;
    vec3 toFirst = pair.firstApex - ray.origin;
    vec3 toSecond = pair.secondApex - ray.origin;
    VertexImage p = imageOfVertex(ray, toBegin);
    VertexImage q = imageOfVertex(ray, toEnd);
    VertexImage r = imageOfVertex(ray, toFirst);
    VertexImage s = imageOfVertex(ray, toSecond);
    vec3 first = vec3(edgeFunction(q, r), edgeFunction(r, p), edgeFunction(p, q));
    vec3 second = vec3(edgeFunction(p, s), edgeFunction(s, q), edgeFunction(q, p));
    bool isFirst = takesFirst && isInside(first.x, first.y, first.z);
    bool isSecond = takesSecond && isInside(second.x, second.y, second.z);
    vec3 edges = isFirst ? first : second;
    vec3 along = isFirst ? vec3(p.along, q.along, r.along) : vec3(q.along, p.along, s.along);
    vec3 toApex = isFirst ? toFirst : toSecond;
    uint corner = isFirst ? pair.firstCorner : pair.secondCorner;
    TriangleHit hit = hitOfTriangle(ray, boxRay, byCorner(edges, corner), byCorner(along, corner),
                                    lesser(lesser(toBegin, toEnd), toApex), greater(greater(toBegin, toEnd), toApex));
    hit.distance = isFirst || isSecond ? hit.distance : 0.0;
    return PairHit(hit, !isFirst, isFirst && isSecond);
}

// The triangles of a pair that intersectTriangle may find hit up to `rayLength`: those whose image the line of the ray
// goes through, unless both are behind the origin or beyond, along the axis. The interval of the axis holds those of
// their boxes, by the same operations (relativeBoxInterval), so that no hit is lost.
uint trianglesOnRay(TriangleRay ray, float pad, float rayLength, TrianglePair pair) {
    VertexImage p = imageOfVertex(ray, pair.v0 - ray.origin);
    VertexImage q = imageOfVertex(ray, pair.v1 - ray.origin);
    VertexImage r = imageOfVertex(ray, pair.v2 - ray.origin);
    VertexImage s = imageOfVertex(ray, pair.v3 - ray.origin);
    float diagonal = edgeFunction(r, p);
    uint found = isInside(edgeFunction(p, q), edgeFunction(q, r), diagonal) ? pair.first : 0u;
    found |= isInside(edgeFunction(r, s), edgeFunction(s, p), -diagonal) ? pair.second : 0u;
    float least = lesser(lesser(p.along, q.along), lesser(r.along, s.along));
    float greatest = greater(greater(p.along, q.along), greater(r.along, s.along));
    float toLower = (least - pad) * ray.shear.z;
    float toUpper = (greatest + pad) * ray.shear.z;
    return greater(toLower, toUpper) > 0.0 && lesser(toLower, toUpper) <= rayLength ? found : 0u;
}

// The point at barycentric weights u, v, 1-u-v. Differences to a corner keep most of the error in proportion to the
// size of the triangle instead of its distance from the origin of the world.
vec3 trianglePoint(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
    vec3 along = (v0 - v2) * u + (v1 - v2) * v;
    return v2 + along;
}

// Bound, for each coordinate, on how far a ray must start above trianglePoint to be above the plane of the triangle,
// and above neighbours in that plane. With r = 2^-24, the unit of rounding, and first-order terms (Pharr, Jakob and
// Humphreys, "Physically Based Rendering", section 6.8.1):
//
//     edges              v0 - v2, v1 - v2      r |edge|: with its product, 2 r (|first| + |second|)
//     products           first, second
//     their sum          along                 r |along|
//     point, origin      v2 + along, offset    r |point| each
//     a neighbour's hit  depth                 2 r extent: its size, for which that of this triangle stands
//
// The depth of a hit is uncertain by more where the neighbour is a needle: one in a million rays at cosines from 1e-4
// to 1 is stopped by the next triangle of a face 100 times as long as wide. A larger bound would carry origins through
// walls: at the corners of closed meshes it is below 8 units in the last place of the largest coordinate.
vec3 trianglePointError(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
    vec3 edge0 = v0 - v2;
    vec3 edge1 = v1 - v2;
    vec3 first = edge0 * u;
    vec3 second = edge1 * v;
    vec3 along = first + second;
    float extent = largestComponent(greater(abs(edge0), abs(edge1)));
    vec3 size = 2.0 * (abs(first) + abs(second) + abs(v2 + along)) + abs(along) + 2.0 * extent;
    return size * (1.0 / 16777216.0);
}
