// A scene in device memory.
#pragma once

#include "host/gpu/memory_plan.h"
#include "host/gpu/vk/buffer.h"
#include "host/packing/packed_scene.h"
#include "host/packing/skip_list.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hyalite::core::gpu {

struct SceneBuffers {
    /// Uploads the scene as `kernel` reads it; `plan` was made for it. Throws as Buffer does.
    SceneBuffers(Device &device, const PackedScene &scene, const ScenePlan &plan, const KernelRow &kernel);

    /// Uploads the frame of a render. Every render begins with it.
    void setFrame(const layout::FrameRecord &frame);

    std::vector<Buffer> buffers; ///< by binding

  private:
    SkipList lists_; ///< if the kernel's tree is one; without their nodes and instances, which are uploaded
    std::optional<Buffer> boxes_;    ///< to which the tree of ray queries refers
    std::uint32_t ownTriangles_ = 0; ///< of the scene's own tree, for ray queries
};

} // namespace hyalite::core::gpu
