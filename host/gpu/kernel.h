// A compute kernel: embedded SPIR-V, specialised, with its bindings.
#pragma once

#include "host/gpu/buffer.h"
#include "shaders/layout.h"

#include <array>
#include <cstdint>
#include <span>

namespace hyalite::gpu {

/// Values of all specialization constants of a renderer's kernel, by their ids in layout.h; bools are 0 or 1.
using SpecializationConstants = std::array<std::uint32_t, layout::constantCount>;

class Kernel {
  public:
    /// `constants` are the specialization constants 0, 1, ..., and `buffers` the bindings 0, 1, ... of set 0. The float
    /// controls that the device offers are added to `spirv`. Throws as `check` does.
    Kernel(Device &device, std::string name, std::span<const std::uint32_t> spirv,
           std::span<const std::uint32_t> constants, std::span<const Buffer *const> buffers);

    [[nodiscard]] const std::string &name() const { return name_; }

    /// Runs the kernel with these push constants, waits, and makes what it wrote visible to the host.
    RunTimes run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount);

  private:
    void makeLayouts(std::span<const Buffer *const> buffers);
    void makePipeline(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants);
    void makeDescriptors(std::span<const Buffer *const> buffers);

    Device &device_;
    std::string name_;
    SetLayoutHandle setLayout_;
    PipelineLayoutHandle pipelineLayout_;
    PipelineHandle pipeline_;
    DescriptorPoolHandle descriptorPool_;
    VkDescriptorSet descriptorSet_ = VK_NULL_HANDLE; ///< freed with its pool
};

} // namespace hyalite::gpu
