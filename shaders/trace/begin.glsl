// Rays of the path slots, for every integrator: how they start, and their hits. An integrator defines
// `lightPassesGlass`: glass dims shadow rays and does not block them; and `raysHaveTargets`: a shadow ray ends on a
// primitive, which does not block it.

void startRay(uint slot, vec3 origin, vec3 direction, uint excluded, uint depth, uint medium) {
    path[slot].rayOrigin = origin;
    path[slot].rayDirection = direction;
    path[slot].rayExcluded = excluded;
    path[slot].rayDepth = depth;
    path[slot].rayMedium = medium;
    path[slot].stage = stageNewRay;
}

// Starts the next sample with its primary ray, or ends the pixel.
void sendPrimaryRay(uint slot) {
    path[slot].sampleRadiance = vec3(0.0);
    path[slot].throughput = vec3(1.0);
    path[slot].stage = stageSampleDone;
    if (path[slot].sampleIndex < dispatch.sampleEnd) {
        PrimaryRay ray = primaryRay(imagePixel[slot], path[slot].sampleIndex);
        startRay(slot, ray.origin, ray.direction, noPrimitive, 1u,
                 hasDielectric ? frame.mediumAtEye : noMaterial);
        rayCounts[slot].x += 1u;
    }
}

bool isTarget(uint slot, uint primitive) { return raysHaveTargets && path[slot].rayTarget == primitive; }

void meetSphere(uint slot, uint id, SphereShape shape) {
    bool areAllPrimary = !hasSpecular && !hasBounces; // so none starts on a surface
    float distance = intersectSphere(path[slot].rayOrigin, path[slot].rayDirection, shape,
                                     !areAllPrimary && path[slot].rayExcluded == id);
    bool isNearer = distance > 0.0 && distance < path[slot].rayLength;
    path[slot].rayLength = isNearer ? distance : path[slot].rayLength;
    path[slot].hitPrimitive = isNearer ? id : path[slot].hitPrimitive;
}

void meetSphereInShadow(uint slot, uint i, SphereShape shape) {
    uint id = sphereIds[i];
    float hitDistance =
        intersectSphere(path[slot].rayOrigin, path[slot].rayDirection, shape, path[slot].rayExcluded == id);
    bool isBetween = hitDistance > 0.0 && hitDistance < path[slot].rayLength && !isTarget(slot, id);
    bool isTransmissive = lightPassesGlass && isSphereTransmissive(i);
    path[slot].isLightDimmed = isBetween && isTransmissive ? 1u : path[slot].isLightDimmed;
    path[slot].hitPrimitive = isBetween && !isTransmissive ? id : path[slot].hitPrimitive;
}

// Stage: test the spheres, and enter the tree at its root.
void beginClosest(uint slot) {
    traceEvent(slot, traceRayOrigin, 0u, path[slot].rayOrigin);
    traceEvent(slot, traceRayDirection, 0u, path[slot].rayDirection);
    path[slot].rayLength = unbounded;
    path[slot].hitPrimitive = noPrimitive;
    [[unroll]] for (uint i = 0u; i < sphereCount; ++i)
        meetSphere(slot, sphereIds[i], sphereShapes[i]);
    path[slot].hitRecord = path[slot].hitPrimitive;
    if (hasTriangles)
        enterTree(slot);
    else
        stopTraversal(slot);
    path[slot].stage = stageClosest;
}

// The surface that the path is on. Members that the scene makes constant are not read from the path, so they need no
// registers.
Surface surfaceAt(uint slot) {
    Surface surface;
    surface.position = path[slot].surfacePosition;
    surface.normal = path[slot].surfaceNormal;
    surface.error = hasTriangles ? path[slot].surfaceError : vec3(0.0);
    bool hasTwoNormals = hasTriangles || (texturing & texturesNormal) != 0u;
    surface.geometricNormal = hasTwoNormals ? path[slot].surfaceGeometricNormal : surface.normal;
    return surface;
}

// Stage: trace a shadow ray from the surface of the path to a light, `distance` away in `direction`.
void beginShadow(uint slot, vec3 direction, float distance) {
    rayCounts[slot].y += 1u;
    path[slot].rayOrigin = offsetRayOrigin(surfaceAt(slot), direction);
    path[slot].rayDirection = direction;
    path[slot].rayLength = distance;
    path[slot].rayExcluded = path[slot].surfacePrimitive;
    path[slot].hitPrimitive = noPrimitive;
    path[slot].isLightDimmed = 0u;
    [[unroll]] for (uint i = 0u; i < sphereCount; ++i)
        meetSphereInShadow(slot, i, sphereShapes[i]);
    if (hasTriangles && path[slot].hitPrimitive == noPrimitive)
        enterTree(slot);
    else
        stopTraversal(slot);
    path[slot].stage = stageShadow;
}

// The nearest hit of the path's ray.
Hit hitOf(uint slot) {
    return Hit(path[slot].rayLength, path[slot].hitPrimitive, path[slot].hitRecord, path[slot].hitU, path[slot].hitV,
               path[slot].hitInstance);
}

// The surface there.
Surface surfaceHit(uint slot, out uint materialIndex) {
    return hitSurface(hitOf(slot), path[slot].rayOrigin, path[slot].rayDirection, materialIndex);
}

// Moves the path to the surface at the hit, to light it.
void setSurface(uint slot, Surface surface) {
    path[slot].surfacePosition = surface.position;
    path[slot].surfaceError = surface.error;
    path[slot].surfaceNormal = surface.normal;
    path[slot].surfaceGeometricNormal = surface.geometricNormal;
    path[slot].surfacePrimitive = path[slot].hitPrimitive;
    path[slot].stage = stageNextLight;
}

void traceNearestHit(uint slot) {
    bool hasWeights = path[slot].hitPrimitive != noPrimitive && isTriangle(path[slot].hitPrimitive);
    traceEvent(slot, traceHit, path[slot].hitPrimitive,
               vec3(path[slot].rayLength, hasWeights ? vec2(path[slot].hitU, path[slot].hitV) : vec2(0.0)));
}

bool isUnfinished() {
    bool any = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        any = any || path[slot].stage != stageDone;
    return any;
}

bool isAtStageUpTo(uint stage) {
    bool any = false;
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        any = any || path[slot].stage <= stage;
    return any;
}
