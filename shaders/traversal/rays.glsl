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
        startRay(slot, ray.origin, ray.direction, noPrimitive, 1u, noMaterial);
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
    float meeting =
        intersectSphere(path[slot].rayOrigin, path[slot].rayDirection, shape, path[slot].rayExcluded == id);
    bool isBetween = meeting > 0.0 && meeting < path[slot].rayLength && !isTarget(slot, id);
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

// Whether the primitive that was hit is a triangle.
bool isTriangle(uint primitive) {
    if (!hasTriangles || treeSpheres == treeHasSpheresOnly)
        return false;
    if (treeSpheres == treeHasSpheresToo)
        return primitive >= frame.firstTriangleId;
    return sphereCount == 0u || primitive >= minFirstTriangleId;
}

// Texture coordinates of the hit at `position`.
vec2 hitUv(uint slot, vec3 position) {
    uint record = path[slot].hitRecord;
    if (isTriangle(path[slot].hitPrimitive))
        return triangleUv(fetchCoordinates(record), path[slot].hitU, path[slot].hitV);
    return sphereUv(position - fetchSphere(record).centre);
}

// Material of the hit at `position`, with its textures applied.
MaterialRecord hitMaterial(uint slot, uint materialIndex, vec3 position) {
    MaterialRecord material = fetchMaterial(materialIndex);
    if ((texturing & texturesMaterials) != 0u)
        material = texturedMaterial(material, hitUv(slot, position));
    return material;
}

// Applies the normal map of the material, if it has one.
void mapNormal(uint slot, inout Surface surface, uint materialIndex, Tangent tangent) {
    uint textures = fetchMaterial(materialIndex).textures;
    if (textures == 0u || !hasTexture(textures, slotNormal))
        return;
    vec3 mapped = mappedNormal(surface.normal, tangent, textureRow(textures, slotNormal), hitUv(slot, surface.position));
    surface.normal = visibleNormal(path[slot].rayDirection, mapped, surface.geometricNormal);
}

// The triangle at the hit, in world space.
TriangleRecord hitTriangle(uint slot) {
    TriangleRecord triangle = fetchTriangle(path[slot].hitRecord);
    if (hasInstances && path[slot].hitInstance != noInstance)
        return placedTriangle(fetchInstance(path[slot].hitInstance), triangle);
    return triangle;
}

NormalRecord hitNormals(uint slot) {
    NormalRecord normals = fetchNormals(path[slot].hitRecord);
    if (hasInstances && path[slot].hitInstance != noInstance)
        return placedNormals(fetchInstance(path[slot].hitInstance), normals);
    return normals;
}

// The surface at the hit.
Surface hitSurface(uint slot, out uint materialIndex) {
    if (isTriangle(path[slot].hitPrimitive)) {
        TriangleRecord triangle = hitTriangle(slot);
        materialIndex = triangle.materialIndex;
        Surface surface = triangleSurface(triangle, hitNormals(slot), path[slot].hitU, path[slot].hitV);
        if ((texturing & texturesNormal) != 0u)
            mapNormal(slot, surface, materialIndex, triangleTangent(triangle, fetchCoordinates(path[slot].hitRecord)));
        return surface;
    }
    SphereRecord sphere = fetchSphere(path[slot].hitRecord);
    materialIndex = materialIndexOf(sphere);
    Surface surface = sphereSurface(path[slot].rayOrigin, path[slot].rayDirection, path[slot].rayLength, sphere);
    if ((texturing & texturesNormal) != 0u)
        mapNormal(slot, surface, materialIndex, sphereTangent(surface.normal * normalSignOf(sphere)));
    return surface;
}

// Moves the path to the surface at the hit, to light it.
void standOn(uint slot, Surface surface) {
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
