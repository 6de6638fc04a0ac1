// False colours of ids and normals, for views.

// A random colour for each id, with channels in [0.2, 1).
vec3 idColour(uint id) {
    uvec3 bits = hashKeys(uvec3(id, 1u, 2u));
    return 0.2 + 0.8 * vec3(unitFloat(bits.x), unitFloat(bits.y), unitFloat(bits.z));
}

// From [-1, 1] to [0, 1], as normal maps do.
vec3 normalColour(vec3 normal) { return 0.5 + 0.5 * normal; }
