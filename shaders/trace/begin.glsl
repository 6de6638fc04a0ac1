// The begin of a ray: the spheres that are outside the tree, and the tree's root. An integrator defines
// `lightPassesGlass`: glass dims rays of visibility and does not block them; and `raysHaveTargets`: they end on
// primitives, which do not block them.

void meetSphere(uint i, uint id, SphereShape shape) {
    bool areAllPrimary = !hasSpecular && !hasBounces; // so none starts on a surface
    float distance = intersectSphere(traversal[i].ray.origin, traversal[i].ray.direction, shape,
                                     !areAllPrimary && traversal[i].ray.excluded == id);
    bool isNearer = distance > 0.0 && distance < traversal[i].hit.distance;
    traversal[i].hit.distance = isNearer ? distance : traversal[i].hit.distance;
    traversal[i].hit.primitive = isNearer ? id : traversal[i].hit.primitive;
}

void meetSphereInShadow(uint i, uint sphere, SphereShape shape) {
    uint id = sphereIds[sphere];
    float hitDistance = intersectSphere(traversal[i].ray.origin, traversal[i].ray.direction, shape,
                                        traversal[i].ray.excluded == id);
    bool isTarget = raysHaveTargets && traversal[i].ray.target == id;
    bool isBetween = hitDistance > 0.0 && hitDistance < traversal[i].hit.distance && !isTarget;
    bool isTransmissive = lightPassesGlass && isSphereTransmissive(sphere);
    traversal[i].isDimmed = isBetween && isTransmissive ? true : traversal[i].isDimmed;
    traversal[i].hit.primitive = isBetween && !isTransmissive ? id : traversal[i].hit.primitive;
}

// A ray whose nearest hit is wanted.
void beginNearest(uint i) {
    traversal[i].hit.distance = traversal[i].ray.maxDistance;
    traversal[i].hit.primitive = noPrimitive;
    [[unroll]] for (uint sphere = 0u; sphere < sphereCount; ++sphere)
        meetSphere(i, sphereIds[sphere], sphereShapes[sphere]);
    traversal[i].hit.record = traversal[i].hit.primitive;
    if (hasTriangles)
        enterTree(i);
    else
        stopTraversal(i);
}

// A ray that anything opaque blocks.
void beginVisibility(uint i) {
    traversal[i].hit.distance = traversal[i].ray.maxDistance;
    traversal[i].hit.primitive = noPrimitive;
    traversal[i].isDimmed = false;
    [[unroll]] for (uint sphere = 0u; sphere < sphereCount; ++sphere)
        meetSphereInShadow(i, sphere, sphereShapes[sphere]);
    if (hasTriangles && traversal[i].hit.primitive == noPrimitive)
        enterTree(i);
    else
        stopTraversal(i);
}
