// A scene in device memory.
#pragma once

#include "host/gpu/memory_plan.h"
#include "host/gpu/vk/buffer.h"
#include "host/packing/packed_scene.h"

namespace hyalite::gpu {

struct SceneBuffers {
    /// Uploads everything, with the tree as node pairs in storage buffers, or as skip lists in texel buffers, as was
    /// planned for that. Throws as Buffer does.
    SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList);

    Buffer frame;
    Buffer spheres;     ///< room for layout::maxSphereCount
    Buffer sphereArray; ///< again, as a kernel's array
    Buffer lights;      ///< room for layout::maxLightCount
    Buffer materials;
    Buffer nodes; ///< node pairs or skip lists
    Buffer triangles;
    Buffer normals;
    Buffer emitters;
    Buffer texels;
    Buffer textures;

  private:
    template <class Tree>
    SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, Tree tree);
};

} // namespace hyalite::gpu
