// The buffers of the integrators' kernels, all in set 0: four uniform buffers, then storage buffers. Those of the
// scene come first. Compiled as C++ and as GLSL.
#ifndef HYALITE_BUFFERS_H
#define HYALITE_BUFFERS_H

#ifdef __cplusplus
#include "shaders/layout/layout.h"

namespace hyalite::core::layout {
#endif

const uint bindingFrame = 0u;
const uint bindingSphereConstants = 1u; // spheres outside the tree, maxUnrolledSpheres at most
const uint bindingLightConstants = 2u;  // the first lights again, maxUniformLights at most
const uint bindingPairConstants = 3u;   // all triangles if they are few, maxListedTriangles at most
const uint uniformBufferCount = 4u;
const uint bindingNodes = 4u; // node pairs, wide nodes, skip nodes, or an acceleration structure

// Scene arrays: a row each, in the order of their bindings. The row is the only place to edit: PackedScene gets a
// vector of the name, which is planned, counted, uploaded and bound, and both renderers read its records by the fetch
// function.
// clang-format off
#define HYALITE_SCENE_ARRAYS(ARRAY) \
    ARRAY(bindingSpheres,    5u,  spheres,    SphereRecord,   fetchSphere) \
    ARRAY(bindingTriangles,  6u,  triangles,  TriangleRecord, fetchTriangle) \
    ARRAY(bindingNormals,    7u,  normals,    NormalRecord,   fetchNormals) \
    ARRAY(bindingMaterials,  8u,  materials,  MaterialRecord, fetchMaterial) \
    ARRAY(bindingEmitters,   9u,  emitters,   EmitterRecord,  fetchEmitter) \
    ARRAY(bindingLookups,    10u, lookups,    LookupRow,      fetchLookupRow) \
    ARRAY(bindingTextures,   11u, textures,   TextureRow,     fetchTextureRow) \
    ARRAY(bindingInstances,  12u, instances,  InstanceRecord, fetchInstance) \
    ARRAY(bindingLights,     13u, lights,     LightRecord,    fetchLight) \
    ARRAY(bindingLightNodes, 14u, lightNodes, LightNode,      fetchLightNode) \
    ARRAY(bindingPlaces,     15u, places,     PlaceRecord,    fetchPlace)
// clang-format on

#define HYALITE_BINDING(number, value, name, Record, fetch) const uint number = value;
HYALITE_SCENE_ARRAYS(HYALITE_BINDING)
#undef HYALITE_BINDING
#define HYALITE_ONE_MORE(number, value, name, Record, fetch) +1u
const uint sceneArrayCount = 0u HYALITE_SCENE_ARRAYS(HYALITE_ONE_MORE);
#undef HYALITE_ONE_MORE
const uint sceneBufferCount = bindingNodes + 1u + sceneArrayCount;

// Buffers of a job.
const uint bindingFilm = sceneBufferCount;
const uint bindingProgress = sceneBufferCount + 1u;
const uint bindingPaths = sceneBufferCount + 2u;
const uint bindingPending = sceneBufferCount + 3u; // maxDepth rays a path
const uint bindingStacks = sceneBufferCount + 4u;  // stackSize references a path
const uint bindingSamples = bindingStacks; // skip lists, which have no stacks: the finished samples of slots
const uint bindingTrace = sceneBufferCount + 5u;
const uint bindingLight = sceneBufferCount + 6u; // the film's layers of light
const uint bindingCount = sceneBufferCount + 7u;

#ifdef __cplusplus
} // namespace hyalite::core::layout
#endif
#endif
