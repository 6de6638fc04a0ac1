#include "host/gpu/pipeline_cache.h"

#include <algorithm>

namespace hyalite::core::gpu {

namespace {

/// A picture with all layers needs a kernel for each, a helper for some, and the passes of the denoiser; a pipeline takes
/// megabytes.
constexpr std::size_t maxKept = 18;

} // namespace

std::shared_ptr<Pipeline> PipelineCache::get(Device &device, const std::string &name,
                                             std::span<const std::uint32_t> spirv,
                                             const SpecializationConstants &constants,
                                             std::span<const BufferUse> bindings) {
    const auto same = std::ranges::find_if(kept_, [&](const Kept &kept) {
        return kept.spirv == spirv.data() && kept.constants == constants &&
               std::ranges::equal(kept.bindings, bindings);
    });
    if (same != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, same);
        return kept_.front().pipeline;
    }
    auto made = std::make_shared<Pipeline>(device, name, spirv, constants, bindings);
    kept_.push_front({spirv.data(), constants, {bindings.begin(), bindings.end()}, std::move(made)});
    if (kept_.size() > maxKept)
        kept_.pop_back();
    return kept_.front().pipeline;
}

} // namespace hyalite::core::gpu
