// Small parts of the scene that every ray needs, loaded once: lavapipe reads uniform buffers fast only outside loops
// and branches.

const uint unrolledSphereCount = 16u;

SphereShape sphereShapes[unrolledSphereCount];
uint transmissiveSpheres = 0u; // one bit each
LightRecord firstLight;

SphereShape sphereShape(uint index) { return makeSphereShape(sphereConstants[index].centre, sphereConstants[index].radius); }

void preload() {
    [[unroll]] for (uint i = 0u; i < min(sphereCount, unrolledSphereCount); ++i) {
        sphereShapes[i] = sphereShape(i);
        transmissiveSpheres |= sphereConstants[i].isTransmissive << i;
    }
    firstLight = lights[0];
}

bool isSphereTransmissive(uint index) {
    return sphereCount <= unrolledSphereCount ? (transmissiveSpheres >> index & 1u) != 0u
                                              : sphereConstants[index].isTransmissive != 0u;
}

LightRecord lightAt(uint index) {
    if (lightCount == 1u)
        return firstLight;
    return lights[index];
}
