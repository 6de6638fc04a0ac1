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

// Whether the primitive that was hit is a triangle.
bool isTriangle(uint primitive) {
    if (!hasTriangles || treeSpheres == treeHasSpheresOnly)
        return false;
    if (treeSpheres == treeHasSpheresToo)
        return primitive >= frame.firstTriangleId;
    return sphereCount == 0u || primitive >= minFirstTriangleId;
}

// Texture coordinates of the hit at `position`.
SurfaceUv hitUvs(uint slot, vec3 position) {
    uint record = path[slot].hitRecord;
    if (isTriangle(path[slot].hitPrimitive))
        return triangleUvs(record, path[slot].hitU, path[slot].hitV);
    vec2 uv = sphereUv(position - fetchSphere(record).centre);
    return SurfaceUv(uv, uv);
}

// The material of the hit at `position`, with its textures of `textureSlots` applied, and if the base colour is among them
// the colour of the vertices, too.
MaterialRecord hitMaterial(uint slot, MaterialRecord material, uint textureSlots, vec3 position) {
    stepsTaken += uint(bitCount(textureSlots & texturing & texturesOfLobes)); // at most so many lookups in a loop
    if ((textureSlots & texturing & texturesMaterials) != 0u)
        material = texturedMaterial(material, textureSlots, hitUvs(slot, position));
    if ((textureSlots & texturesBaseColour) != 0u && (texturing & texturesColours) != 0u &&
        isTriangle(path[slot].hitPrimitive))
        material = colouredMaterial(material, path[slot].hitRecord, path[slot].hitU, path[slot].hitV);
    return material;
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

// The surface at the hit, without its normal map.
Surface smoothSurface(uint slot, out uint materialIndex) {
    if (isTriangle(path[slot].hitPrimitive)) {
        TriangleRecord triangle = hitTriangle(slot);
        materialIndex = triangle.materialIndex;
        if (!hasNormals)
            return flatSurface(triangle, path[slot].hitU, path[slot].hitV);
        return triangleSurface(triangle, hitNormals(slot), path[slot].hitU, path[slot].hitV);
    }
    SphereRecord sphere = fetchSphere(path[slot].hitRecord);
    materialIndex = materialIndexOf(sphere);
    return sphereSurface(path[slot].rayOrigin, path[slot].rayDirection, path[slot].rayLength, sphere);
}

// Tangents of a triangle's vertices, in world space.
Tangent hitVertexTangent(uint slot, vec3 normal) {
    uint row = tangentRow(path[slot].hitRecord);
    vec4 t0 = fetchTangent(row);
    vec4 t1 = fetchTangent(row + 1u);
    vec4 t2 = fetchTangent(row + 2u);
    if (hasInstances && path[slot].hitInstance != noInstance) {
        InstanceRecord instance = fetchInstance(path[slot].hitInstance);
        t0 = placedTangent(instance, t0);
        t1 = placedTangent(instance, t1);
        t2 = placedTangent(instance, t2);
    }
    return vertexTangent(t0, t1, t2, normal, path[slot].hitU, path[slot].hitV);
}

// Tangents at the hit, for textures with the coordinates `usesSecondUv`. `normal` is that of the smooth surface.
Tangent hitTangent(uint slot, vec3 normal, bool usesSecondUv) {
    if (isTriangle(path[slot].hitPrimitive)) {
        if ((texturing & texturesTangents) != 0u) {
            Tangent tangent = hitVertexTangent(slot, normal);
            if (isKnown(tangent))
                return tangent;
        }
        if ((texturing & texturesSecondUv) != 0u && usesSecondUv)
            return triangleTangent(hitTriangle(slot), fetchSecondCoordinates(path[slot].hitRecord));
        return triangleTangent(hitTriangle(slot), fetchCoordinates(path[slot].hitRecord));
    }
    return sphereTangent(normal * normalSignOf(fetchSphere(path[slot].hitRecord)));
}

// The normal that the map in `mapSlot` makes of that of a smooth surface.
vec3 hitNormal(uint slot, Surface surface, uint textures, uint mapSlot) {
    if (textures == 0u || !hasTexture(textures, mapSlot))
        return surface.normal;
    uint row = textureRow(textures, mapSlot);
    Tangent tangent = hitTangent(slot, surface.normal, usesSecondUv(row));
    vec3 mapped = mappedNormal(surface.normal, tangent, row, hitUvs(slot, surface.position));
    return visibleNormal(path[slot].rayDirection, mapped, surface.geometricNormal);
}

// The surface at the hit.
Surface hitSurface(uint slot, out uint materialIndex) {
    Surface surface = smoothSurface(slot, materialIndex);
    if ((texturing & texturesNormal) != 0u)
        surface.normal = hitNormal(slot, surface, fetchMaterial(materialIndex).textures, slotNormal);
    return surface;
}

// What the material needs at the hit beyond a normal, which is `normal` on the side of the viewer.
SurfaceAxes hitAxes(uint slot, MaterialRecord material, vec3 normal, bool isBehind) {
    SurfaceAxes axes = SurfaceAxes(vec3(0.0), normal);
    if ((scattering & (scattersAtAnisotropic | scattersAtCoatNormals)) == 0u)
        return axes;
    uint materialIndex;
    Surface surface = smoothSurface(slot, materialIndex);
    if ((scattering & scattersAtAnisotropic) != 0u)
        axes.tangent = hitTangent(slot, surface.normal, false).alongU;
    if ((scattering & scattersAtCoatNormals) != 0u) {
        vec3 coat = surface.normal;
        if ((texturing & texturesClearcoatNormal) != 0u)
            coat = hitNormal(slot, surface, material.textures, slotClearcoatNormal);
        axes.coatNormal = isBehind ? -coat : coat;
    }
    return axes;
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
