// The glass around the origins of primary rays, where these lie on both sides of its surface, as on a lens that is half
// in water. A ray goes straight from the eye, whose glass the host knows, to the origin, at depth 0, through
// everything, and counts the glass that it enters and leaves. Twin: host/reference/media_at_origin.h.

bool originsMeetGlass() { return (camera & cameraOriginsMeetGlass) != 0u; } // only where there is glass

// Goes on from a point of the way, or starts the primary ray at its end.
void goToOrigin(vec3 from, uint excluded) {
    PrimaryRay ray = primaryRay(path.key.pixel, path.key.sampleIndex);
    WayToOrigin way = wayToOrigin(from, ray.origin);
    path.key.depth = way.distance > 0.0 ? 0u : 1u;
    path.medium = way.distance > 0.0 ? noMaterial : mediumAround(path.mediaInside);
    if (way.distance > 0.0)
        askNearest(from, way.direction, excluded);
    else
        askNearest(ray.origin, ray.direction, noPrimitive);
}

// Begins a sample in the glass that is around its origin.
void beginInMedia() {
    askPrimary();
    path.mediaInside = hasDielectric ? frame.mediaAtEye : 0u;
    if (originsMeetGlass())
        goToOrigin(frame.eye, noPrimitive);
}

// The nearest surface on the way to the origin is known.
void passOnWay(const Answer answer) {
    vec3 origin = primaryRay(path.key.pixel, path.key.sampleIndex).origin;
    bool isThere = answer.hit.primitive == noPrimitive ||
                   answer.hit.distance >= wayToOrigin(request.ray.origin, origin).distance;
    if (isThere) {
        goToOrigin(origin, noPrimitive);
        return;
    }
    uint materialIndex;
    vec3 direction = request.ray.direction;
    Surface surface = hitSurface(answer.hit, request.ray.origin, direction, materialIndex);
    if (holdsMedium(fetchMaterial(materialIndex)))
        path.mediaInside = dotProduct(direction, surface.geometricNormal) < 0.0
                               ? enterMedium(path.mediaInside, materialIndex)
                               : leaveMedium(path.mediaInside, materialIndex);
    goToOrigin(offsetRayOrigin(surface, direction), answer.hit.primitive);
}
