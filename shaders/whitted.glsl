// The report's integrator: direct light with shadows on diffuse surfaces, both branches at glass, all of it
// deterministic. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.
// Twin: host/reference/whitted.h, where the same happens ray by ray.
//
// A path slot works through the samples of one pixel and, for each, through the tree of rays that glass makes of it.
// Stages follow each other so that all slots of a subgroup that are about the same work do it together; each stage
// does nothing for slots that are elsewhere.

const float inversePi = 0.31830988618379067;

void startRay(uint slot, vec3 origin, vec3 direction, uint excluded, uint depth, uint medium) {
    path[slot].rayOrigin = origin;
    path[slot].rayDirection = direction;
    path[slot].rayExcluded = excluded;
    path[slot].rayDepth = depth;
    path[slot].rayMedium = medium;
    path[slot].stage = stageNewRay;
}

// Stage: the primary ray of the next sample.
void beginSample(uint slot) {
    path[slot].sampleRadiance = vec3(0.0);
    path[slot].throughput = vec3(1.0);
    path[slot].stage = stageSampleDone;
    if (path[slot].sampleIndex < dispatch.sampleEnd) {
        uvec2 pixel = imagePixel[slot];
        vec3 direction = primaryDirection(pixel, samplePixel(pixel, path[slot].sampleIndex, frame.seed));
        startRay(slot, frame.eye, direction, noPrimitive, 1u, noMaterial);
        rayCounts[slot].x += 1u;
    }
}

// A path has come to its end: another one of the sample may wait.
void endPath(uint slot) {
    path[slot].stage = hasDielectric && path[slot].pendingCount > 0u ? stageNextRay : stageSampleDone;
}

// Stage: take the ray that waits.
void takePendingRay(uint slot) {
    PendingRay ray = popPendingRay(slot);
    path[slot].throughput = ray.throughput;
    startRay(slot, ray.origin, ray.direction, ray.excluded, ray.depth, ray.medium);
}

void meetSphere(uint slot, uint i, vec4 shape) {
    float distance = intersectSphere(path[slot].rayOrigin, path[slot].rayDirection, shape.xyz, shape.w, path[slot].rayExcluded == i);
    bool isNearer = distance > 0.0 && distance < path[slot].rayLength;
    path[slot].rayLength = isNearer ? distance : path[slot].rayLength;
    path[slot].hitPrimitive = isNearer ? i : path[slot].hitPrimitive;
}

void meetSphereInShadow(uint slot, uint i, vec4 shape) {
    float meeting = intersectSphere(path[slot].rayOrigin, path[slot].rayDirection, shape.xyz, shape.w, path[slot].rayExcluded == i);
    bool isBetween = meeting > 0.0 && meeting < path[slot].rayLength;
    bool isTransmissive = hasDielectric && isSphereTransmissive(i);
    path[slot].isLightDimmed = isBetween && isTransmissive ? 1u : path[slot].isLightDimmed;
    path[slot].hitPrimitive = isBetween && !isTransmissive ? i : path[slot].hitPrimitive;
}

// Stage: meet the spheres and stand at the root of the tree.
void beginClosest(uint slot) {
    traceEvent(slot, traceRayOrigin, 0u, path[slot].rayOrigin);
    traceEvent(slot, traceRayDirection, 0u, path[slot].rayDirection);
    path[slot].rayLength = unbounded;
    path[slot].hitPrimitive = noPrimitive;
    if (sphereCount <= unrolledSphereCount)
        [[unroll]] for (uint i = 0u; i < sphereCount; ++i)
            meetSphere(slot, i, sphereShapes[i]);
    else
        for (uint i = 0u; i < sphereCount; ++i)
            meetSphere(slot, i, sphereShape(i));
    path[slot].hitRecord = path[slot].hitPrimitive;
    if (hasTriangles)
        enterTree(slot);
    else
        stopTraversal(slot);
    path[slot].stage = stageClosest;
}

void reflectRay(uint slot, Surface surface, uint medium) {
    vec3 direction = mirrorDirection(path[slot].rayDirection, surface.normal);
    vec3 origin = spawnPoint(surface.position, surface.error, surface.geometricNormal, direction);
    startRay(slot, origin, direction, path[slot].hitPrimitive, path[slot].rayDepth + 1u, medium);
    rayCounts[slot].z += 1u;
}

void splitAtGlass(uint slot, Surface surface, MaterialRecord material, uint materialIndex, bool isEntering) {
    vec3 direction = path[slot].rayDirection;
    vec3 facing = isEntering ? surface.normal : -surface.normal;
    Refraction refraction = refractRay(direction, facing, material.refractiveIndex, isEntering);
    traceEvent(slot, traceReflectance, refraction.isTotal ? 1u : 0u, vec3(refraction.reflectance));
    uint mediumOfReflection = isEntering ? path[slot].rayMedium : materialIndex;
    if (refraction.isTotal) {
        reflectRay(slot, surface, mediumOfReflection);
        return;
    }
    // The reflected ray waits, the refracted one goes on.
    PendingRay reflected;
    reflected.direction = mirrorDirection(direction, surface.normal);
    reflected.origin = spawnPoint(surface.position, surface.error, surface.geometricNormal, reflected.direction);
    reflected.excluded = path[slot].hitPrimitive;
    reflected.depth = path[slot].rayDepth + 1u;
    reflected.medium = mediumOfReflection;
    reflected.throughput = path[slot].throughput * refraction.reflectance;
    pushPendingRay(slot, reflected);
    rayCounts[slot].z += 1u;

    path[slot].throughput = path[slot].throughput * refraction.transmittance;
    vec3 origin = spawnPoint(surface.position, surface.error, surface.geometricNormal, refraction.direction);
    startRay(slot, origin, refraction.direction, path[slot].hitPrimitive, path[slot].rayDepth + 1u,
             isEntering ? materialIndex : noMaterial);
    rayCounts[slot].w += 1u;
}

void leaveScene(uint slot) {
    vec3 throughput = path[slot].throughput;
    if (hasDielectric && path[slot].rayMedium != noMaterial)
        throughput *= fetchMaterial(path[slot].rayMedium).segmentTint;
    path[slot].sampleRadiance = addProduct(path[slot].sampleRadiance, throughput, frame.background);
    traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    endPath(slot);
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    bool isTriangle = hasTriangles && path[slot].hitPrimitive >= firstTriangleId;
    traceEvent(slot, traceHit, path[slot].hitPrimitive,
               vec3(path[slot].rayLength, isTriangle ? vec2(path[slot].hitU, path[slot].hitV) : vec2(0.0)));
    if (path[slot].hitPrimitive == noPrimitive) {
        leaveScene(slot);
        return;
    }
    Surface surface;
    uint materialIndex;
    if (isTriangle) {
        TriangleRecord triangle = fetchTriangle(path[slot].hitRecord);
        surface = triangleSurface(triangle, fetchNormals(path[slot].hitRecord), path[slot].hitU, path[slot].hitV);
        materialIndex = triangle.materialIndex;
    } else {
        SphereRecord sphere = fetchSphere(path[slot].hitRecord);
        surface = sphereSurface(path[slot].rayOrigin, path[slot].rayDirection, path[slot].rayLength, sphere);
        materialIndex = sphere.materialIndex;
    }
    MaterialRecord material = fetchMaterial(materialIndex);
    vec3 direction = path[slot].rayDirection;
    bool isEntering = dotProduct(direction, surface.normal) < 0.0;
    bool isGlass = hasDielectric && material.kind == materialDielectric;
    if (hasDielectric) {
        uint medium = isGlass && !isEntering ? materialIndex : path[slot].rayMedium;
        if (medium != noMaterial)
            path[slot].throughput *= fetchMaterial(medium).segmentTint;
    }
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    traceEvent(slot, traceThroughput, 0u, path[slot].throughput);
    endPath(slot);
    if (!hasSpecular || material.kind == materialDiffuse) {
        if (material.isTwoSided != 0u && dotProduct(direction, surface.geometricNormal) > 0.0) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        path[slot].surfacePosition = surface.position;
        path[slot].surfaceError = surface.error;
        path[slot].surfaceNormal = surface.normal;
        path[slot].surfaceGeometricNormal = surface.geometricNormal;
        path[slot].surfacePrimitive = path[slot].hitPrimitive;
        path[slot].surfaceWeight = path[slot].throughput * (material.albedo * inversePi);
        path[slot].lightIndex = 0u;
        path[slot].stage = stageNextLight;
    } else if (path[slot].rayDepth < frame.maxDepth) {
        if (isGlass)
            splitAtGlass(slot, surface, material, materialIndex, isEntering);
        else
            reflectRay(slot, surface, path[slot].rayMedium);
    }
}

// Stage: send a shadow ray from the surface to the next light, if it lies on the lit side.
void aimAtLight(uint slot) {
    if (path[slot].lightIndex == lightCount) {
        endPath(slot);
        return;
    }
    vec3 toLight = subtract(lightPosition(path[slot].lightIndex), path[slot].surfacePosition);
    float distance = vectorLength(toLight);
    vec3 direction = toLight * divide(1.0, distance);
    bool isLit = dotProduct(path[slot].surfaceNormal, direction) > 0.0 &&
                 dotProduct(path[slot].surfaceGeometricNormal, direction) > 0.0;
    if (!isLit) {
        traceEvent(slot, traceVisibility, visibilityUnlit, vec3(path[slot].lightIndex));
        path[slot].lightIndex += 1u;
        if (path[slot].lightIndex == lightCount)
            endPath(slot);
        return;
    }
    rayCounts[slot].y += 1u;
    path[slot].rayOrigin = spawnPoint(path[slot].surfacePosition, path[slot].surfaceError,
                                      path[slot].surfaceGeometricNormal, direction);
    path[slot].rayDirection = direction;
    path[slot].rayLength = distance;
    path[slot].rayExcluded = path[slot].surfacePrimitive;
    path[slot].hitPrimitive = noPrimitive;
    path[slot].isLightDimmed = 0u;
    if (sphereCount <= unrolledSphereCount)
        [[unroll]] for (uint i = 0u; i < sphereCount; ++i)
            meetSphereInShadow(slot, i, sphereShapes[i]);
    else
        for (uint i = 0u; i < sphereCount; ++i)
            meetSphereInShadow(slot, i, sphereShape(i));
    if (hasTriangles && path[slot].hitPrimitive == noPrimitive)
        enterTree(slot);
    else
        stopTraversal(slot);
    path[slot].stage = stageShadow;
}

// Stage: the shadow ray has arrived, or was stopped.
void addLight(uint slot) {
    bool isVisible = path[slot].hitPrimitive == noPrimitive;
    bool isDimmed = hasDielectric && path[slot].isLightDimmed != 0u;
    traceEvent(slot, traceVisibility, isVisible ? (isDimmed ? visibilityDimmed : visibilityClear) : visibilityBlocked,
               vec3(path[slot].lightIndex));
    if (isVisible) {
        float squaredDistance = path[slot].rayLength * path[slot].rayLength;
        float cosine = dotProduct(path[slot].surfaceNormal, path[slot].rayDirection);
        vec3 irradiance = lightIntensity(path[slot].lightIndex) * divide(cosine, squaredDistance);
        vec3 light = path[slot].surfaceWeight * irradiance;
        if (isDimmed)
            light *= frame.shadowThroughGlass;
        path[slot].sampleRadiance = add(path[slot].sampleRadiance, light);
        traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    }
    path[slot].lightIndex += 1u;
    path[slot].stage = stageNextLight;
    if (path[slot].lightIndex == lightCount)
        endPath(slot);
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

// Of loops over the spheres in one pass, which count as steps.
const uint sphereIterations = sphereCount <= unrolledSphereCount ? 0u : RAYS * sphereCount;

// Follows rays until they meet a diffuse surface or nothing.
void followPaths() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (hasDielectric && path[slot].stage == stageNextRay)
            takePendingRay(slot);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNewRay)
            beginClosest(slot);
    if (hasTriangles)
        traverse(stageClosest, false);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageClosest && !isTraversing(slot))
            shadeHit(slot);
    stepsTaken += 1u + sphereIterations;
}

// Lights the surface where a path stands.
void lightPaths() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageNextLight)
            aimAtLight(slot);
    if (hasTriangles)
        traverse(stageShadow, true);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (path[slot].stage == stageShadow && !isTraversing(slot))
            addLight(slot);
    stepsTaken += 1u + sphereIterations;
}

// Runs the samples that the slots have begun to their end, or until the step budget is spent.
void advancePaths() {
    do {
        do
            followPaths();
        while (hasSpecular && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
        lightPaths();
        stepsTaken += 1u;
    } while (isAtStageUpTo(stageShadow) && stepsTaken < dispatch.stepBudget);
}
