// Shared by all traversals: the position of a ray in the tree, and the test of a triangle. A ray passes triangles that
// are culled, and points of alpha-tested ones, as if they were not there.

bool isTraversing(uint slot) { return path[slot].cursorNode != noNode || path[slot].cursorTriangle != noNode; }

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
Candidate candidateOf(uint slot, TriangleHit hit, uint id, uint record, uint instance, uint flags, uint materialIndex,
                  const bool isShadow) {
    bool isMet = hit.distance > 0.0;
    if ((anyHit & anyHitCulled) != 0u)
        isMet = isMet && !(hit.isBehind && (flags & triangleIsCulled) != 0u);
    if (isShadow)
        isMet = isMet && hit.distance < path[slot].rayLength && !(raysHaveTargets && path[slot].rayTarget == id);
    else
        isMet = isMet && (hit.distance < path[slot].rayLength ||
                          (hit.distance == path[slot].rayLength && id < path[slot].hitPrimitive));
    return Candidate(isMet, hit, id, record, instance, flags, materialIndex);
}

// Tests a triangle in world space.
Candidate testTriangle(uint slot, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
                     const bool isShadow) {
    uint id = triangle.primitiveId;
    bool isExcluded = id == path[slot].rayExcluded;
    bool isSphere = treeSpheres == treeHasSpheresOnly ||
                    (treeSpheres == treeHasSpheresToo && (triangle.flags & triangleIsSphere) != 0u);
    TriangleHit hit = TriangleHit(0.0, 0.0, 0.0, false);
    if (treeSpheres != treeHasSpheresOnly && !isSphere) {
        hit = intersectTriangle(ray, boxRay, triangle.v0, triangle.v1, triangle.v2);
        hit.distance = isExcluded ? 0.0 : hit.distance;
    }
    if (treeSpheres != treeHasTriangles && isSphere) {
        hit.distance =
            intersectBoxedSphere(boxRay, path[slot].rayDirection, triangle.v0, triangle.v1.x, isExcluded);
        record = id;
    }
    return candidateOf(slot, hit, id, record, instance, triangle.flags, triangle.materialIndex, isShadow);
}

bool needsAlphaTest(Candidate candidate) {
    return (anyHit & anyHitAlpha) != 0u && candidate.isMet && (candidate.flags & triangleIsAlphaTested) != 0u;
}

// Whether the ray passes the alpha-tested triangle that it meets.
bool failsAlphaTest(uint slot, Candidate candidate, const bool isShadow) {
    float choice = 0.0;
    if ((anyHit & anyHitBlended) != 0u)
        choice = alphaTestNumber(imagePixel[slot], frame.seed, path[slot].sampleIndex,
                             2u * path[slot].rayDepth + (isShadow ? 1u : 0u), candidate.primitiveId);
    return isPassed(candidate.materialIndex, candidate.record, candidate.hit.u, candidate.hit.v, choice);
}

// Records what is met. isShadow: an opaque hit ends the search and returns true, and glass only dims; otherwise the
// nearest hit is kept.
bool commitHit(uint slot, Candidate candidate, const bool isShadow) {
    if (isShadow) {
        bool isTransmissive = lightPassesGlass && (candidate.flags & triangleIsTransmissive) != 0u;
        if (candidate.isMet && isTransmissive)
            path[slot].isLightDimmed = 1u;
        bool isBlocked = candidate.isMet && !isTransmissive;
        if (isBlocked)
            path[slot].hitPrimitive = candidate.primitiveId;
        return isBlocked;
    }
    if (candidate.isMet) {
        path[slot].rayLength = candidate.hit.distance;
        path[slot].hitU = candidate.hit.u;
        path[slot].hitV = candidate.hit.v;
        path[slot].hitPrimitive = candidate.primitiveId;
        path[slot].hitRecord = candidate.record;
        path[slot].hitInstance = candidate.instance;
    }
    return false;
}

// All three in one.
bool meetTriangle(uint slot, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
                  const bool isShadow) {
    Candidate candidate = testTriangle(slot, record, instance, triangle, ray, boxRay, isShadow);
    if (needsAlphaTest(candidate) && failsAlphaTest(slot, candidate, isShadow))
        candidate.isMet = false;
    return commitHit(slot, candidate, isShadow);
}
