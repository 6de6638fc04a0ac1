// A scene in device memory.
#pragma once

#include "host/bvh/packed_scene.h"
#include "host/gpu/buffer.h"

namespace hyalite::gpu {

struct SceneBuffers {
    /// Uploads everything. `arrays` is how kernels read materials, nodes, triangles and normals: Storage or Texels.
    /// Throws as Buffer does.
    SceneBuffers(Device &device, const PackedScene &scene, BufferUse arrays);

    Buffer frame;
    Buffer spheres; ///< room for layout::maxSphereCount
    Buffer lights;  ///< room for layout::maxLightCount
    Buffer materials;
    Buffer nodes;
    Buffer triangles;
    Buffer normals;
};

} // namespace hyalite::gpu
