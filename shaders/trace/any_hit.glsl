// The test of a triangle, for all traversals. A ray passes triangles that are culled, and points of alpha-tested ones,
// as if they were not there. isVisibility: any opaque hit ends a ray, and glass only dims; otherwise the nearest hit is
// found.

// A candidate hit on a triangle or sphere of the tree, before its alpha test.
struct Candidate {
    bool isMet; // false: the face is culled, or the hit is not nearer than the current one (shadow ray: than the light)
    TriangleHit hit;
    uint primitiveId;
    uint record;
    uint instance;
    uint flags; // of the TriangleRecord
    uint materialIndex;
};

// The candidate of a hit on a primitive. It does not count if the face is culled, or if the hit is not nearer than the
// current one (shadow ray: than its end). `record` and `instance` are where the primitive comes from.
Candidate candidateOf(uint i, TriangleHit hit, uint id, uint record, uint instance, uint flags, uint materialIndex,
                  const bool isVisibility) {
    bool isMet = hit.distance > 0.0;
    if ((anyHit & anyHitCulled) != 0u)
        isMet = isMet && !(hit.isBehind && (flags & triangleIsCulled) != 0u);
    if (isVisibility)
        isMet = isMet && hit.distance < traversal[i].hit.distance &&
                !(raysHaveTargets && traversal[i].ray.target == id);
    else
        isMet = isMet && (hit.distance < traversal[i].hit.distance ||
                          (hit.distance == traversal[i].hit.distance && id < traversal[i].hit.primitive));
    return Candidate(isMet, hit, id, record, instance, flags, materialIndex);
}

// Tests a triangle in world space.
Candidate testTriangle(uint i, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
                     const bool isVisibility) {
    uint id = triangle.primitiveId;
    bool isExcluded = id == traversal[i].ray.excluded;
    bool isSphere = treeSpheres == treeHasSpheresOnly ||
                    (treeSpheres == treeHasSpheresToo && (triangle.flags & triangleIsSphere) != 0u);
    TriangleHit hit = TriangleHit(0.0, 0.0, 0.0, false);
    if (treeSpheres != treeHasSpheresOnly && !isSphere) {
        hit = intersectTriangle(ray, boxRay, triangle.v0, triangle.v1, triangle.v2);
        hit.distance = isExcluded ? 0.0 : hit.distance;
    }
    if (treeSpheres != treeHasTriangles && isSphere) {
        hit.distance =
            intersectBoxedSphere(boxRay, traversal[i].ray.direction, triangle.v0, triangle.v1.x, isExcluded);
        record = id;
    }
    return candidateOf(i, hit, id, record, instance, triangle.flags, triangle.materialIndex, isVisibility);
}

bool needsAlphaTest(const Candidate candidate) {
    return (anyHit & anyHitAlpha) != 0u && candidate.isMet && (candidate.flags & triangleIsAlphaTested) != 0u;
}

// Whether the ray passes the alpha-tested triangle that it meets.
bool failsAlphaTest(uint i, const Candidate candidate) {
    float choice = 0.0;
    if ((anyHit & anyHitBlended) != 0u)
        choice = alphaTestNumber(traversal[i].key.pixel, frame.seed, traversal[i].key.sampleIndex,
                                 traversal[i].key.number, candidate.primitiveId);
    return isPassed(candidate.materialIndex, candidate.record, candidate.hit.u, candidate.hit.v, choice);
}

// Records what is met. isVisibility: an opaque hit ends the search and returns true, and glass only dims; otherwise the
// nearest hit is kept.
bool commitHit(uint i, const Candidate candidate, const bool isVisibility) {
    if (isVisibility) {
        bool isTransmissive = lightPassesGlass && (candidate.flags & triangleIsTransmissive) != 0u;
        if (candidate.isMet && isTransmissive)
            traversal[i].isDimmed = true;
        bool isBlocked = candidate.isMet && !isTransmissive;
        if (isBlocked)
            traversal[i].hit.primitive = candidate.primitiveId;
        return isBlocked;
    }
    if (candidate.isMet) {
        traversal[i].hit.distance = candidate.hit.distance;
        traversal[i].hit.u = candidate.hit.u;
        traversal[i].hit.v = candidate.hit.v;
        traversal[i].hit.primitive = candidate.primitiveId;
        traversal[i].hit.record = candidate.record;
        traversal[i].hit.instance = candidate.instance;
    }
    return false;
}

// All three in one.
bool meetTriangle(uint i, uint record, uint instance, TriangleRecord triangle, TriangleRay ray,
                  BoxRay boxRay, const bool isVisibility) {
    Candidate candidate = testTriangle(i, record, instance, triangle, ray, boxRay, isVisibility);
    if (needsAlphaTest(candidate) && failsAlphaTest(i, candidate))
        candidate.isMet = false;
    return commitHit(i, candidate, isVisibility);
}
