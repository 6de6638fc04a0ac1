#include "host/gpu/kernel_needs.h"

#include "host/gpu/memory_plan.h"
#include "shaders/layout/buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t workgroupInvocationsNeeded = 64;
constexpr std::uint32_t bulkBuffers = layout::bindingCount - layout::uniformBufferCount;
/// Storage texel buffers of a skip list: nodes, the arrays of the scene, and waiting rays.
constexpr std::uint32_t texelBuffers = 1 + layout::sceneArrayCount + 1;

std::string lackOf(const char *what, std::uint64_t allowed, std::uint64_t needed) {
    return allowed >= needed ? std::string()
                             : fmt::format("allows {} {}, {} are needed", allowed, what, needed);
}

} // namespace

std::string lackFor(Traversal traversal, const DeviceInfo &device) {
    const bool isSkipList = traversal == Traversal::SkipList;
    for (const std::string &lack :
         {lackOf("invocations in a workgroup", device.maxWorkgroupInvocations, workgroupInvocationsNeeded),
          lackOf("storage buffers in a kernel", device.maxStorageBuffersPerStage,
                 isSkipList ? bulkBuffers - texelBuffers : bulkBuffers),
          lackOf("storage texel buffers and images in a kernel", device.maxStorageImagesPerStage,
                 isSkipList ? texelBuffers : 0)})
        if (!lack.empty())
            return lack;
    if (isSkipList && !device.canShuffle)
        return "offers no subgroup shuffles and sums in compute kernels";
    return {};
}

bool areTexelsAllowed(const PackedScene &scene, const DeviceInfo &device) {
    const ScenePlan plan = planScene(scene, true);
    return std::ranges::all_of(plan.buffers, [&](const BufferPlan &buffer) {
        return buffer.sizeBytes <= maxBufferBytes(buffer.use, device);
    });
}

} // namespace hyalite::core::gpu
