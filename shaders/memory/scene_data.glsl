// The scene's buffers, and how their records are fetched.
//
// GPUs read storage buffers. lavapipe loads each component of a storage buffer in a loop over the lanes, with a bounds
// check each, but inlines the load of a whole texel. There the arrays are storage texel buffers, which makes traversal
// several times faster (MEMORY_TEXELS=1).

layout(set = 0, binding = bindingSphereConstants, std140) uniform SphereBuffer {
    SphereRecord sphereConstants[maxUnrolledSpheres];
};
layout(set = 0, binding = bindingLightConstants, std140) uniform LightBuffer {
    LightRecord lightConstants[maxUniformLights];
};
layout(set = 0, binding = bindingPairConstants, std140) uniform PairBuffer {
    TrianglePair pairConstants[maxListedTriangles];
};

#if MEMORY_TEXELS
#define SCENE_ARRAY(number, value, name, Record, fetch) \
    layout(set = 0, binding = number, rgba32ui) uniform restrict readonly uimageBuffer name##Texels; \
    Record fetch(uint index) { LOAD_##Record(name##Texels, index) }
#else
#define SCENE_ARRAY(number, value, name, Record, fetch) \
    layout(set = 0, binding = number, std430) readonly buffer name##Buffer { Record name[]; }; \
    Record fetch(uint index) { return name[index]; }
#endif

HYALITE_SCENE_ARRAYS(SCENE_ARRAY)

// One word of the textures. Where arrays are storage buffers, lavapipe compiles a load for each component of a row.
#if MEMORY_TEXELS
uint fetchTextureWord(uint index) {
    TextureRow row = fetchTextureRow(index >> 2u);
    uint low = (index & 1u) != 0u ? row.y : row.x;
    uint high = (index & 1u) != 0u ? row.w : row.z;
    return (index & 2u) != 0u ? high : low;
}
#else
layout(set = 0, binding = bindingTextures, std430) readonly buffer TextureWordBuffer { uint textureWordArray[]; };
uint fetchTextureWord(uint index) { return textureWordArray[index]; }
#endif

// A corner of a triangle with a word, as they stand in TriangleRecord: row 3 i is that of the first corner of record i.
#if MEMORY_TEXELS
uvec4 fetchTriangleRow(uint row) { return imageLoad(trianglesTexels, int(row)); }
#else
uvec4 fetchTriangleRow(uint row) {
    TriangleRecord record = triangles[row / 3u];
    uvec4 first = uvec4(floatBitsToUint(record.v0), record.primitiveId);
    uvec4 second = uvec4(floatBitsToUint(record.v1), record.materialIndex);
    uvec4 third = uvec4(floatBitsToUint(record.v2), record.flags);
    return row % 3u == 0u ? first : (row % 3u == 1u ? second : third);
}
#endif

#if TRAVERSAL_SKIP_LIST
SCENE_ARRAY(bindingNodes, 4u, skipNodes, SkipNode, fetchSkipNode)
#elif TREE_WIDE
SCENE_ARRAY(bindingNodes, 4u, wideNodes, WideNode, fetchWideNode)
#elif !TRAVERSAL_RAY_QUERY
SCENE_ARRAY(bindingNodes, 4u, nodes, NodePair, fetchNode)
#endif
