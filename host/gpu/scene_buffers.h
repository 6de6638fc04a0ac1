// A scene in device memory.
#pragma once

#include "host/gpu/memory_plan.h"
#include "host/gpu/vk/buffer.h"
#include "host/packing/packed_scene.h"
#include "host/packing/skip_list.h"

#include <vector>

namespace hyalite::core::gpu {

struct SceneBuffers {
    /// Uploads the scene, with the tree as node pairs in storage buffers or as skip lists in texel buffers; `plan` was
    /// made for the same choice. Throws as Buffer does.
    SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, bool isSkipList);

    /// Uploads the frame of a render. Every render begins with it.
    void setFrame(const layout::FrameRecord &frame);

    std::vector<Buffer> buffers; ///< by binding

  private:
    SkipList lists_; ///< without their nodes and instances, which are uploaded
};

} // namespace hyalite::core::gpu
