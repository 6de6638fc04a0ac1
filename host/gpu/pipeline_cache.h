// Pipelines of a device, kept for its next renders: a driver takes as long to make one as for many samples.
#pragma once

#include "host/gpu/kernel.h"
#include "host/gpu/vk/pipeline.h"

#include <cstdint>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::gpu {

/// Holds the pipelines that were used last. Not for two threads at once.
class PipelineCache {
  public:
    /// The pipeline of a kernel, as Pipeline makes it, or the one that was made for the same three. The words of a
    /// kernel are known by their address: they must outlive the cache.
    [[nodiscard]] std::shared_ptr<Pipeline> get(Device &device, const std::string &name,
                                                std::span<const std::uint32_t> spirv,
                                                const SpecializationConstants &constants,
                                                std::span<const BufferUse> bindings);

    /// Before the device is closed.
    void clear() { kept_.clear(); }

  private:
    struct Kept {
        const std::uint32_t *spirv;
        SpecializationConstants constants;
        std::vector<BufferUse> bindings;
        std::shared_ptr<Pipeline> pipeline;
    };
    std::list<Kept> kept_; ///< the last used first
};

} // namespace hyalite::core::gpu
