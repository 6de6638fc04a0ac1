// The glass around the origins of primary rays, where these lie on both sides of its surface, as on a lens that is half
// in water. A ray goes straight from the eye, whose glass the host knows, to the origin, at depth 0, through
// everything, and counts the glass that it enters and leaves. Twin: host/reference/media_at_origin.h.

bool originsMeetGlass() { return (camera & cameraOriginsMeetGlass) != 0u; } // only where there is glass

// Goes on from a point of the way, or starts the primary ray at its end.
void goToOrigin(uint slot, vec3 from, uint excluded) {
    PrimaryRay ray = primaryRay(imagePixel[slot], path[slot].sampleIndex);
    WayToOrigin way = wayToOrigin(from, ray.origin);
    if (way.distance > 0.0)
        startRay(slot, from, way.direction, excluded, 0u, noMaterial);
    else
        startRay(slot, ray.origin, ray.direction, noPrimitive, 1u, mediumAround(path[slot].mediaInside));
}

// Starts the next sample in the glass that is around its origin, or ends the pixel.
void beginInMedia(uint slot) {
    sendPrimaryRay(slot);
    path[slot].mediaInside = hasDielectric ? frame.mediaAtEye : 0u;
    if (originsMeetGlass() && path[slot].stage == stageNewRay)
        goToOrigin(slot, frame.eye, noPrimitive);
}

// Stage: the nearest surface on the way to the origin is known.
void passOnWay(uint slot) {
    vec3 origin = primaryRay(imagePixel[slot], path[slot].sampleIndex).origin;
    bool isThere = path[slot].hitPrimitive == noPrimitive ||
                   path[slot].rayLength >= wayToOrigin(path[slot].rayOrigin, origin).distance;
    if (isThere) {
        goToOrigin(slot, origin, noPrimitive);
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    vec3 direction = path[slot].rayDirection;
    if (isGlass(fetchMaterial(materialIndex)))
        path[slot].mediaInside = dotProduct(direction, surface.geometricNormal) < 0.0
                                     ? enterMedium(path[slot].mediaInside, materialIndex)
                                     : leaveMedium(path[slot].mediaInside, materialIndex);
    goToOrigin(slot, offsetRayOrigin(surface, direction), path[slot].hitPrimitive);
}
