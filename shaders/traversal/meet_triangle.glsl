// Shared by all traversals: the position of a ray in the tree, and the test of a triangle. A ray passes triangles that are
// culled, and points of sheer ones, as if they were not there.

bool isTraversing(uint slot) { return path[slot].cursorNode != noNode || path[slot].cursorTriangle != noNode; }

// Tests a triangle in world space and records a hit; `record` and `instance` are where it comes from. isShadow: an opaque hit ends the search and returns true, and glass only dims;
// otherwise the nearest hit is kept.
bool meetTriangle(uint slot, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
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
    bool isHit = hit.distance > 0.0;
    if ((passing & passesCulled) != 0u)
        isHit = isHit && !(hit.isBehind && (triangle.flags & triangleIsCulled) != 0u);
    if ((passing & passesSheer) != 0u && (triangle.flags & triangleIsSheer) != 0u && isHit) {
        float choice = 0.0;
        if ((passing & passesBlended) != 0u)
            choice = sheerChoice(imagePixel[slot], frame.seed, path[slot].sampleIndex,
                                 2u * path[slot].rayDepth + (isShadow ? 1u : 0u), id);
        isHit = !isPassed(triangle.materialIndex, record, hit.u, hit.v, choice);
    }
    if (isShadow) {
        bool isBetween =
            isHit && hit.distance < path[slot].rayLength && !(raysHaveTargets && path[slot].rayTarget == id);
        bool isTransmissive = lightPassesGlass && (triangle.flags & triangleIsTransmissive) != 0u;
        if (isBetween && isTransmissive)
            path[slot].isLightDimmed = 1u;
        bool isBlocked = isBetween && !isTransmissive;
        if (isBlocked)
            path[slot].hitPrimitive = id;
        return isBlocked;
    }
    bool isNearer = hit.distance < path[slot].rayLength ||
                    (hit.distance == path[slot].rayLength && id < path[slot].hitPrimitive);
    if (isHit && isNearer) {
        path[slot].rayLength = hit.distance;
        path[slot].hitU = hit.u;
        path[slot].hitV = hit.v;
        path[slot].hitPrimitive = id;
        path[slot].hitRecord = record;
        path[slot].hitInstance = instance;
    }
    return false;
}
