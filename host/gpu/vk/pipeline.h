// A compute pipeline: specialised embedded SPIR-V and the types of its bindings.
#pragma once

#include "host/gpu/vk/buffer.h"

#include <cstdint>
#include <span>
#include <string>

namespace hyalite::core::gpu {

/// The descriptor type of a buffer of this use.
[[nodiscard]] VkDescriptorType descriptorTypeOf(BufferUse use);

class Pipeline {
  public:
    /// `constants` are the specialization constants 0, 1, ..., and `bindings` the uses of the buffers at bindings 0,
    /// 1, ... of set 0. The float controls that the device offers are added to `spirv`. Throws as `check` does. The
    /// device may be in use by other threads.
    Pipeline(Device &device, std::string name, std::span<const std::uint32_t> spirv,
             std::span<const std::uint32_t> constants, std::span<const BufferUse> bindings);

    [[nodiscard]] const std::string &name() const { return name_; }
    [[nodiscard]] VkPipeline get() const { return pipeline_.get(); }
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout setLayout() const { return setLayout_.get(); }

    /// Whether a dispatch of it has ended: some drivers compile it only then.
    [[nodiscard]] bool hasRun() const { return hasRun_; }
    void setRun() { hasRun_ = true; }

  private:
    void makeLayouts(Device &device, std::span<const BufferUse> uses);
    void makePipeline(Device &device, std::span<const std::uint32_t> spirv,
                      std::span<const std::uint32_t> constants);

    std::string name_;
    SetLayoutHandle setLayout_;
    PipelineLayoutHandle layout_;
    PipelineHandle pipeline_;
    bool hasRun_ = false;
};

} // namespace hyalite::core::gpu
