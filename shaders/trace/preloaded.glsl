// Small parts of the scene that every ray needs, loaded once: lavapipe reads uniform buffers fast only outside loops
// and branches.

SphereShape sphereShapes[maxUnrolledSpheres];
uint sphereIds[maxUnrolledSpheres];
uint transmissiveSpheres = 0u; // one bit each
LightRecord firstLight;
TrianglePair listedPairs[maxListedTriangles];

void preload() {
    [[unroll]] for (uint i = 0u; i < sphereCount; ++i) {
        sphereShapes[i] = makeSphereShape(sphereConstants[i].centre, sphereConstants[i].radius);
        sphereIds[i] = treeSpheres == treeHasTriangles ? i : sphereConstants[i].primitiveId;
        transmissiveSpheres |= sphereConstants[i].isTransmissive << i;
    }
    firstLight = lightConstants[0];
    [[unroll]] for (uint i = 0u; i < trianglePairs; ++i)
        listedPairs[i] = pairConstants[i];
}

bool isSphereTransmissive(uint index) { return (transmissiveSpheres >> index & 1u) != 0u; }

LightRecord lightAt(uint index) {
    if (lightCount == 1u)
        return firstLight;
    if (lightCount <= maxUniformLights)
        return lightConstants[index];
    return fetchLight(index);
}
