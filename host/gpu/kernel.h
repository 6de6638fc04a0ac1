// A compute kernel: a pipeline with its buffers.
#pragma once

#include "host/gpu/vk/buffer.h"
#include "host/gpu/vk/pipeline.h"
#include "shaders/layout/layout.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace hyalite::core::gpu {

/// Values of all specialization constants of a renderer's kernel, by their ids in layout.h; bools are 0 or 1.
using SpecializationConstants = std::array<std::uint32_t, layout::constantCount>;

class Kernel {
  public:
    /// `buffers` are bindings 0, 1, ..., of the uses that the pipeline was made for. Throws as `check` does.
    Kernel(Device &device, std::shared_ptr<Pipeline> pipeline, std::span<const Buffer *const> buffers);

    /// With a pipeline of its own. Throws as Pipeline does, too.
    Kernel(Device &device, std::string name, std::span<const std::uint32_t> spirv,
           std::span<const std::uint32_t> constants, std::span<const Buffer *const> buffers);

    [[nodiscard]] const std::string &name() const { return pipeline_->name(); }
    /// Whether its pipeline has run, here or elsewhere.
    [[nodiscard]] bool isWarm() const { return pipeline_->hasRun(); }

    /// Runs the kernel with these push constants, waits, and makes its results visible to the host.
    RunTimes run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount);
    /// Runs `next` after it in the same submission, on what it wrote.
    RunTimes run(const layout::DispatchConstants &constants, std::uint32_t workgroupCount, const Kernel &next,
                 std::uint32_t nextWorkgroupCount);

  private:
    void makeDescriptors(std::span<const Buffer *const> buffers);
    void record(VkCommandBuffer commands, const layout::DispatchConstants &constants,
                std::uint32_t workgroupCount) const;
    RunTimes submit(const layout::DispatchConstants &constants,
                    const std::function<void(VkCommandBuffer)> &record);

    Device &device_;
    std::shared_ptr<Pipeline> pipeline_;
    DescriptorPoolHandle descriptorPool_;
    VkDescriptorSet descriptorSet_ = VK_NULL_HANDLE; ///< freed with its pool
};

} // namespace hyalite::core::gpu
