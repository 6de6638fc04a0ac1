// Shared by all traversals: the position of a ray in the tree, and the test of a triangle. A ray passes triangles that are
// culled, and points of sheer ones, as if they were not there.

bool isTraversing(uint slot) { return path[slot].cursorNode != noNode || path[slot].cursorTriangle != noNode; }

// A triangle or sphere of the tree that a ray meets, unless it turns out to be sheer there.
struct Meeting {
    bool isMet; // false: there is none
    TriangleHit hit;
    uint primitiveId;
    uint record;
    uint instance;
    uint flags; // of the TriangleRecord
    uint materialIndex;
};

// What is met by a hit on a primitive, which is wanting where it is culled, behind the nearest hit so far, or behind the
// end of a shadow ray; `record` and `instance` are where the primitive comes from.
Meeting meetingOf(uint slot, TriangleHit hit, uint id, uint record, uint instance, uint flags, uint materialIndex,
                  const bool isShadow) {
    bool isMet = hit.distance > 0.0;
    if ((passing & passesCulled) != 0u)
        isMet = isMet && !(hit.isBehind && (flags & triangleIsCulled) != 0u);
    if (isShadow)
        isMet = isMet && hit.distance < path[slot].rayLength && !(raysHaveTargets && path[slot].rayTarget == id);
    else
        isMet = isMet && (hit.distance < path[slot].rayLength ||
                          (hit.distance == path[slot].rayLength && id < path[slot].hitPrimitive));
    return Meeting(isMet, hit, id, record, instance, flags, materialIndex);
}

// Tests a triangle in world space.
Meeting testTriangle(uint slot, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
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
    return meetingOf(slot, hit, id, record, instance, triangle.flags, triangle.materialIndex, isShadow);
}

bool maySlipThrough(Meeting meeting) {
    return (passing & passesSheer) != 0u && meeting.isMet && (meeting.flags & triangleIsSheer) != 0u;
}

// Whether the ray passes the sheer triangle that it meets.
bool slipsThrough(uint slot, Meeting meeting, const bool isShadow) {
    float choice = 0.0;
    if ((passing & passesBlended) != 0u)
        choice = sheerChoice(imagePixel[slot], frame.seed, path[slot].sampleIndex,
                             2u * path[slot].rayDepth + (isShadow ? 1u : 0u), meeting.primitiveId);
    return isPassed(meeting.materialIndex, meeting.record, meeting.hit.u, meeting.hit.v, choice);
}

// Records what is met. isShadow: an opaque hit ends the search and returns true, and glass only dims; otherwise the
// nearest hit is kept.
bool keepMeeting(uint slot, Meeting meeting, const bool isShadow) {
    if (isShadow) {
        bool isTransmissive = lightPassesGlass && (meeting.flags & triangleIsTransmissive) != 0u;
        if (meeting.isMet && isTransmissive)
            path[slot].isLightDimmed = 1u;
        bool isBlocked = meeting.isMet && !isTransmissive;
        if (isBlocked)
            path[slot].hitPrimitive = meeting.primitiveId;
        return isBlocked;
    }
    if (meeting.isMet) {
        path[slot].rayLength = meeting.hit.distance;
        path[slot].hitU = meeting.hit.u;
        path[slot].hitV = meeting.hit.v;
        path[slot].hitPrimitive = meeting.primitiveId;
        path[slot].hitRecord = meeting.record;
        path[slot].hitInstance = meeting.instance;
    }
    return false;
}

// All three in one.
bool meetTriangle(uint slot, uint record, uint instance, TriangleRecord triangle, TriangleRay ray, BoxRay boxRay,
                  const bool isShadow) {
    Meeting meeting = testTriangle(slot, record, instance, triangle, ray, boxRay, isShadow);
    if (maySlipThrough(meeting) && slipsThrough(slot, meeting, isShadow))
        meeting.isMet = false;
    return keepMeeting(slot, meeting, isShadow);
}
