#include "host/gpu/kernel_needs.h"

#include "host/gpu/memory_plan.h"
#include "shaders/layout/buffers.h"

#include <fmt/format.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <bit>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t workgroupInvocationsNeeded = 64;
constexpr std::uint32_t bulkBuffers = layout::bindingCount - layout::uniformBufferCount;
/// Storage texel buffers: nodes, the arrays of the scene, and waiting rays.
constexpr std::uint32_t texelBuffers = 1 + layout::sceneArrayCount + 1;

std::string lackOf(const char *what, std::uint64_t allowed, std::uint64_t needed) {
    return allowed >= needed ? std::string()
                             : fmt::format("allows {} {}, {} are needed", allowed, what, needed);
}

} // namespace

std::string lackFor(const KernelRow &kernel, const DeviceInfo &device) {
    const bool hasTexels = kernel.memory == KernelMemory::Texels;
    for (const std::string &lack :
         {lackOf("invocations in a workgroup", device.maxWorkgroupInvocations, workgroupInvocationsNeeded),
          lackOf("storage buffers in a kernel", device.maxStorageBuffersPerStage,
                 hasTexels ? bulkBuffers - texelBuffers : bulkBuffers),
          lackOf("storage texel buffers and images in a kernel", device.maxStorageImagesPerStage,
                 hasTexels ? texelBuffers : 0)})
        if (!lack.empty())
            return lack;
    if (kernel.lanes == KernelLanes::Exchanging && !device.canShuffle)
        return "offers no subgroup shuffles and sums in compute kernels";
    if (kernel.tree == KernelTree::PrimitiveBoxes && device.maxQueryBoxes == 0)
        return "offers no ray queries (VK_KHR_ray_query)";
    if (kernel.tree == KernelTree::SkipLists && device.driverId == VK_DRIVER_ID_GOOGLE_SWIFTSHADER)
        return "computes the loops of skip lists wrongly (shaders/README.md#drivers)";
    return {};
}

bool areTexelsAllowed(const PackedScene &scene, const KernelRow &kernel, const DeviceInfo &device) {
    const ScenePlan plan = planScene(scene, kernel);
    return std::ranges::all_of(plan.buffers, [&](const BufferPlan &buffer) {
        return buffer.use != BufferUse::Texels || buffer.sizeBytes <= maxBufferBytes(buffer.use, device);
    });
}

} // namespace hyalite::core::gpu
