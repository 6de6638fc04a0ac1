// The scene's arrays, and how their records are fetched.
//
// On a GPU a storage buffer is the natural thing. lavapipe loads each component of a storage buffer in a loop over the
// lanes, with a bounds check each, but inlines the load of a whole texel: there the arrays are storage texel buffers,
// which makes traversal several times faster (MEMORY_TEXELS=1).

layout(set = 0, binding = bindingSpheres, std140) uniform SphereBuffer { SphereRecord spheres[maxSphereCount]; };
layout(set = 0, binding = bindingLights, std140) uniform LightBuffer { LightRecord lights[maxLightCount]; };

#if MEMORY_TEXELS

layout(set = 0, binding = bindingMaterials, rgba32ui) uniform restrict readonly uimageBuffer materialTexels;
layout(set = 0, binding = bindingNodes, rgba32ui) uniform restrict readonly uimageBuffer nodeTexels;
layout(set = 0, binding = bindingTriangles, rgba32ui) uniform restrict readonly uimageBuffer triangleTexels;
layout(set = 0, binding = bindingNormals, rgba32ui) uniform restrict readonly uimageBuffer normalTexels;
layout(set = 0, binding = bindingEmitters, rgba32ui) uniform restrict readonly uimageBuffer emitterTexels;

layout(set = 0, binding = bindingLookups, rgba32ui) uniform restrict readonly uimageBuffer lookupTable;

layout(set = 0, binding = bindingTextures, rgba32ui) uniform restrict readonly uimageBuffer textureTexels;

layout(set = 0, binding = bindingSphereArray, rgba32ui) uniform restrict readonly uimageBuffer sphereTexels;

SphereRecord fetchSphere(uint index) {
    uvec4 a = imageLoad(sphereTexels, int(index) * 2);
    uvec4 b = imageLoad(sphereTexels, int(index) * 2 + 1);
    return SphereRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.x), b.y, b.z, b.w);
}

MaterialRecord fetchMaterial(uint index) {
    int row = int(index) * 8;
    uvec4 a = imageLoad(materialTexels, row);
    uvec4 b = imageLoad(materialTexels, row + 1);
    uvec4 c = imageLoad(materialTexels, row + 2);
    uvec4 d = imageLoad(materialTexels, row + 3);
    uvec4 e = imageLoad(materialTexels, row + 4);
    uvec4 f = imageLoad(materialTexels, row + 5);
    uvec4 g = imageLoad(materialTexels, row + 6);
    uvec4 h = imageLoad(materialTexels, row + 7);
    return MaterialRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
                          uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.xyz), d.w,
                          uintBitsToFloat(e.xyz), uintBitsToFloat(e.w), uintBitsToFloat(f.xyz), uintBitsToFloat(f.w),
                          uintBitsToFloat(g.xyz), uintBitsToFloat(g.w), uintBitsToFloat(h.x), uintBitsToFloat(h.y),
                          uintBitsToFloat(h.z), h.w);
}

LookupRow fetchLookupRow(uint index) {
    uvec4 words = imageLoad(lookupTable, int(index));
    return LookupRow(uintBitsToFloat(words.xyz), words.w);
}

uvec4 fetchTextureRow(uint index) { return imageLoad(textureTexels, int(index)); }

#if TRAVERSAL_SKIP_LIST
SkipNode fetchSkipNode(uint index) {
    uvec4 words = imageLoad(nodeTexels, int(index));
    return SkipNode(words.x, words.y, words.z, words.w);
}
#else
NodePair fetchNode(uint index) {
    int row = int(index) * 4;
    uvec4 a = imageLoad(nodeTexels, row);
    uvec4 b = imageLoad(nodeTexels, row + 1);
    uvec4 c = imageLoad(nodeTexels, row + 2);
    uvec4 d = imageLoad(nodeTexels, row + 3);
    return NodePair(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w,
                    uintBitsToFloat(d.xyz), d.w);
}
#endif

TriangleRecord fetchTriangle(uint index) {
    int row = int(index) * 3;
    uvec4 a = imageLoad(triangleTexels, row);
    uvec4 b = imageLoad(triangleTexels, row + 1);
    uvec4 c = imageLoad(triangleTexels, row + 2);
    return TriangleRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}

EmitterRecord fetchEmitter(uint index) {
    int row = int(index) * 4;
    uvec4 a = imageLoad(emitterTexels, row);
    uvec4 b = imageLoad(emitterTexels, row + 1);
    uvec4 c = imageLoad(emitterTexels, row + 2);
    uvec4 d = imageLoad(emitterTexels, row + 3);
    return EmitterRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), c.x, c.y,
                         uintBitsToFloat(c.z), c.w, uintBitsToFloat(d.xyz), uintBitsToFloat(d.w));
}

NormalRecord fetchNormals(uint index) {
    int row = int(index) * 3;
    vec3 a = uintBitsToFloat(imageLoad(normalTexels, row).xyz);
    vec3 b = uintBitsToFloat(imageLoad(normalTexels, row + 1).xyz);
    vec3 c = uintBitsToFloat(imageLoad(normalTexels, row + 2).xyz);
    return NormalRecord(a, 0.0, b, 0.0, c, 0.0);
}

#else

layout(set = 0, binding = bindingMaterials, std430) readonly buffer MaterialBuffer { MaterialRecord materials[]; };
#if TRAVERSAL_SKIP_LIST
layout(set = 0, binding = bindingNodes, std430) readonly buffer NodeBuffer { SkipNode nodes[]; };
#else
layout(set = 0, binding = bindingNodes, std430) readonly buffer NodeBuffer { NodePair nodes[]; };
#endif
layout(set = 0, binding = bindingTriangles, std430) readonly buffer TriangleBuffer { TriangleRecord triangles[]; };
layout(set = 0, binding = bindingNormals, std430) readonly buffer NormalBuffer { NormalRecord normals[]; };
layout(set = 0, binding = bindingEmitters, std430) readonly buffer EmitterBuffer { EmitterRecord emitters[]; };
layout(set = 0, binding = bindingLookups, std430) readonly buffer TexelBuffer { LookupRow texels[]; };
layout(set = 0, binding = bindingTextures, std430) readonly buffer TextureBuffer { uvec4 textureRows[]; };

SphereRecord fetchSphere(uint index) { return spheres[index]; }

EmitterRecord fetchEmitter(uint index) { return emitters[index]; }

MaterialRecord fetchMaterial(uint index) { return materials[index]; }

LookupRow fetchLookupRow(uint index) { return texels[index]; }

uvec4 fetchTextureRow(uint index) { return textureRows[index]; }

#if TRAVERSAL_SKIP_LIST
SkipNode fetchSkipNode(uint index) { return nodes[index]; }
#else
NodePair fetchNode(uint index) { return nodes[index]; }
#endif

TriangleRecord fetchTriangle(uint index) { return triangles[index]; }

NormalRecord fetchNormals(uint index) { return normals[index]; }

#endif
