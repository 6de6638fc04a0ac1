#include "host/gpu/vk/device.h"

#include "host/base/error.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/physical_device.h"
#include "host/gpu/vk/ray_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace hyalite::core::gpu {

Device::Device(const DeviceInfo &info, Transfers transfers)
    : info_(info), isStagingPreferred_(transfers == Transfers::Staged || info.type == DeviceType::Discrete) {
    const std::vector<VkPhysicalDevice> devices = instance_.physicalDevices();
    if (info.index < 0 || static_cast<std::size_t>(info.index) >= devices.size())
        throw Error(ErrorKind::NoDevice, fmt::format("device {} is gone", info.name));
    physical_ = devices[static_cast<std::size_t>(info.index)];
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    const std::uint32_t family = findComputeQueueFamily(physical_);
    createDevice(family);
    createCommands(family);
    timestamps_ = Timestamps(instance_.get(), physical_, device_.get(), family, info.hasCalibratedTimestamps);
    debugUtils_ = DebugUtils(instance_, device_.get());
    debugUtils_.name(VK_OBJECT_TYPE_DEVICE, device_.get(), "the device");
    debugUtils_.name(VK_OBJECT_TYPE_QUEUE, queue_, "the queue");
    debugUtils_.name(VK_OBJECT_TYPE_COMMAND_POOL, commandPool_.get(), "the command pool");
    debugUtils_.name(VK_OBJECT_TYPE_COMMAND_BUFFER, commandBuffer_, "the command buffer");
    debugUtils_.name(VK_OBJECT_TYPE_FENCE, fence_.get(), "the fence");
}

void Device::createDevice(std::uint32_t queueFamily) {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    std::vector<const char *> extensions;
    if (info_.canRoundToNearestEven || info_.canPreserveSignedZeroInfNan)
        extensions.push_back(VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME);
    if (info_.hasCalibratedTimestamps)
        extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    if (info_.isPortabilitySubset)
        extensions.push_back(portabilitySubset);
    RayQueryFeatures rayQueries(VK_TRUE);
    if (info_.maxQueryBoxes > 0) {
        create.pNext = &rayQueries.queries;
        for (const char *name : rayQueryExtensions)
            if (std::ranges::find(extensions, std::string_view(name)) == extensions.end())
                extensions.push_back(name);
    }
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(physical_, &create, nullptr, &device),
          fmt::format("vkCreateDevice for {}", info_.name));
    device_ = DeviceHandle(NoParent{}, device);
    vkGetDeviceQueue(device, queueFamily, 0, &queue_);
}

void Device::createCommands(std::uint32_t queueFamily) {
    const VkDevice device = device_.get();
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = queueFamily;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device, &pool, nullptr, &commandPool),
          fmt::format("vkCreateCommandPool for {}", info_.name));
    commandPool_ = CommandPoolHandle(device, commandPool);

    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = commandPool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &allocate, &commandBuffer_),
          fmt::format("vkAllocateCommandBuffers for {}", info_.name));

    VkFenceCreateInfo fenceInfo{};
    fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device, &fenceInfo, nullptr, &fence),
          fmt::format("vkCreateFence for {}", info_.name));
    fence_ = FenceHandle(device, fence);
}

std::uint32_t Device::findMemoryType(std::uint32_t typeBits, VkMemoryPropertyFlags flags) const {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
        if ((typeBits >> i & 1u) != 0 && (memory_.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    return VK_MAX_MEMORY_TYPES;
}

bool Device::isMappable(std::uint32_t memoryType) const {
    // Memory that is not coherent would need flushes.
    constexpr VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    return (memory_.memoryTypes[memoryType].propertyFlags & wanted) == wanted;
}

void Device::waitForFence(const std::string &action) {
    // Counted slices instead of a clock: a suspended program uses up only one of them. No dispatch should take a
    // second; a busy machine gets a hundred times that. Software drivers compile a kernel in its first dispatch, which
    // can take minutes.
    constexpr std::uint64_t sliceNanos = 1'000'000'000;
    const int maxSlices = info_.isSoftware() ? 1200 : 120;
    const VkFence fence = fence_.get();
    VkResult result = VK_TIMEOUT;
    for (int slice = 0; slice < maxSlices && result == VK_TIMEOUT; ++slice)
        result = vkWaitForFences(device_.get(), 1, &fence, VK_TRUE, sliceNanos);
    if (result == VK_SUCCESS)
        return;
    // A lost device has stopped. Otherwise the submission may still run, and use objects that would be destroyed next.
    const bool isIdle = result == VK_ERROR_DEVICE_LOST ||
                        (result != VK_TIMEOUT && vkDeviceWaitIdle(device_.get()) == VK_SUCCESS);
    if (!isIdle) {
        gpu::abandon(device_.get());
        instance_.abandon();
    }
    check(result, fmt::format("vkWaitForFences for {}{}", action,
                              result == VK_TIMEOUT ? fmt::format(", {} s", maxSlices) : ""));
}

void Device::submit(const std::string &action, const std::function<void(VkCommandBuffer)> &record) {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commandBuffer_, &begin), "vkBeginCommandBuffer for " + action);
    debugUtils_.beginLabel(commandBuffer_, action);
    record(commandBuffer_);
    debugUtils_.endLabel(commandBuffer_);
    check(vkEndCommandBuffer(commandBuffer_), "vkEndCommandBuffer for " + action);

    const VkFence fence = fence_.get();
    check(vkResetFences(device_.get(), 1, &fence), "vkResetFences for " + action);
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commandBuffer_;
    check(vkQueueSubmit(queue_, 1, &submit, fence), "vkQueueSubmit for " + action);
    waitForFence(action);
    instance_.throwOnValidationMessage();
}

} // namespace hyalite::core::gpu
