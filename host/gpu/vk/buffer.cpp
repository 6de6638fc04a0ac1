#include "host/gpu/vk/buffer.h"

#include "host/base/error.h"
#include "host/base/huge_pages.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/extension_functions.h"

#include <fmt/format.h>

#include <cassert>
#include <cstring>

namespace hyalite::core::gpu {

namespace {

constexpr VkMemoryPropertyFlags hostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

VkBufferUsageFlags usageFlags(BufferUse use) {
    constexpr VkBufferUsageFlags transfer =
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    switch (use) {
    case BufferUse::Uniform:
        return transfer | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    case BufferUse::Storage:
    case BufferUse::Counters:
        return transfer | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    case BufferUse::Texels:
        return transfer | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    case BufferUse::BuildInput:
        return transfer | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
               VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    case BufferUse::BottomLevel:
    case BufferUse::TopLevel:
        return VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
               VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    case BufferUse::Staging:
        break;
    }
    return transfer;
}

/// Memory properties for the use, the preferred ones first.
std::uint32_t chooseMemoryType(const Device &device, BufferUse use, std::uint32_t typeBits) {
    const bool isForHost = use == BufferUse::Counters || use == BufferUse::Staging;
    if (isForHost) {
        const std::uint32_t cached =
            device.findMemoryType(typeBits, hostMemory | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
        return cached != VK_MAX_MEMORY_TYPES ? cached : device.findMemoryType(typeBits, hostMemory);
    }
    // The host reads the memory of a discrete GPU slowly even if it can map it.
    if (!device.isStagingPreferred()) {
        const std::uint32_t shared =
            device.findMemoryType(typeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | hostMemory);
        if (shared != VK_MAX_MEMORY_TYPES)
            return shared;
    }
    const std::uint32_t local = device.findMemoryType(typeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    return local != VK_MAX_MEMORY_TYPES ? local : device.findMemoryType(typeBits, 0);
}

} // namespace

Buffer::Buffer(Device &device, std::string name, BufferUse use, std::size_t sizeBytes)
    : device_(&device), name_(std::move(name)), use_(use), sizeBytes_(sizeBytes > 0 ? sizeBytes : 16) {
    const std::string what = fmt::format("{}, {} bytes", name_, sizeBytes_);
    requireBuffer({name_, use, sizeBytes_}, device.info());
    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = sizeBytes_;
    create.usage = usageFlags(use);
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device.get(), &create, nullptr, &buffer), "vkCreateBuffer for " + what);
    buffer_ = BufferHandle(device.get(), buffer);

    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device.get(), buffer, &requirements);
    const std::uint32_t type = chooseMemoryType(device, use, requirements.memoryTypeBits);
    if (type == VK_MAX_MEMORY_TYPES)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{} has no memory for {}", device.info().name, what));
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = type;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    if ((create.usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0)
        allocate.pNext = &flags;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.get(), &allocate, nullptr, &memory), "vkAllocateMemory for " + what);
    memory_ = MemoryHandle(device.get(), memory);
    claim_ = MemoryClaim(device.allocatedBytes(), requirements.size);
    device.debugUtils().name(VK_OBJECT_TYPE_BUFFER, buffer, name_);
    device.debugUtils().name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, "memory of " + name_);
    check(vkBindBufferMemory(device.get(), buffer, memory, 0), "vkBindBufferMemory for " + what);
    if (use == BufferUse::Texels) {
        VkBufferViewCreateInfo viewInfo{};
        viewInfo.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
        viewInfo.buffer = buffer;
        viewInfo.format = VK_FORMAT_R32G32B32A32_UINT;
        viewInfo.range = VK_WHOLE_SIZE;
        VkBufferView view = VK_NULL_HANDLE;
        check(vkCreateBufferView(device.get(), &viewInfo, nullptr, &view), "vkCreateBufferView for " + what);
        view_ = BufferViewHandle(device.get(), view);
        device.debugUtils().name(VK_OBJECT_TYPE_BUFFER_VIEW, view, "texels of " + name_);
    }
    if (use == BufferUse::BottomLevel || use == BufferUse::TopLevel) {
        VkAccelerationStructureCreateInfoKHR structureInfo{};
        structureInfo.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
        structureInfo.buffer = buffer;
        structureInfo.size = sizeBytes_;
        structureInfo.type = use == BufferUse::TopLevel ? VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR
                                                        : VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
        VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
        check(HYALITE_EXTENSION_FUNCTION(device.get(), vkCreateAccelerationStructureKHR)(
                  device.get(), &structureInfo, nullptr, &structure),
              "vkCreateAccelerationStructureKHR for " + what);
        structure_ = AccelerationStructureHandle(device.get(), structure);
        device.debugUtils().name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, structure,
                                 "structure of " + name_);
    }
    if (device.isMappable(type) &&
        (!device.isStagingPreferred() || use == BufferUse::Counters || use == BufferUse::Staging)) {
        void *address = nullptr;
        check(vkMapMemory(device.get(), memory, 0, VK_WHOLE_SIZE, 0, &address), "vkMapMemory for " + what);
        mapped_ = static_cast<std::byte *>(address);
        if (device.info().isSoftware()) // whose memory is the machine's
            preferHugePages(mapped_, static_cast<std::size_t>(requirements.size));
    }
}

Buffer::Buffer(Device &device, const BufferPlan &plan)
    : Buffer(device, plan.name, plan.use, static_cast<std::size_t>(plan.sizeBytes)) {}

VkDeviceAddress Buffer::address() const {
    VkBufferDeviceAddressInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    info.buffer = get();
    return HYALITE_EXTENSION_FUNCTION(device_->get(), vkGetBufferDeviceAddressKHR)(device_->get(), &info);
}

void Buffer::upload(std::span<const std::byte> bytes, std::size_t offset) {
    assert(offset + bytes.size() <= sizeBytes_);
    if (bytes.empty())
        return;
    if (mapped_ != nullptr) {
        std::memcpy(mapped_ + offset, bytes.data(), bytes.size());
        return;
    }
    Buffer staging(*device_, "the upload of " + name_, BufferUse::Staging, bytes.size());
    staging.upload(bytes);
    device_->submit("the upload of " + name_, [&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, offset, bytes.size()};
        vkCmdCopyBuffer(commands, staging.get(), get(), 1, &region);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask =
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                             0, 1, &barrier, 0, nullptr, 0, nullptr);
    });
}

void Buffer::download(std::span<std::byte> bytes) const {
    assert(bytes.size() <= sizeBytes_);
    if (bytes.empty())
        return;
    if (mapped_ != nullptr) {
        std::memcpy(bytes.data(), mapped_, bytes.size());
        return;
    }
    Buffer staging(*device_, "the download of " + name_, BufferUse::Staging, bytes.size());
    device_->submit("the download of " + name_, [&](VkCommandBuffer commands) {
        VkMemoryBarrier before{};
        before.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        before.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        before.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                             0, 1, &before, 0, nullptr, 0, nullptr);
        const VkBufferCopy region{0, 0, bytes.size()};
        vkCmdCopyBuffer(commands, get(), staging.get(), 1, &region);
        VkMemoryBarrier after{};
        after.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        after.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        after.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &after, 0, nullptr, 0, nullptr);
    });
    staging.download(bytes);
}

void Buffer::clear() {
    if (mapped_ != nullptr) {
        std::memset(mapped_, 0, sizeBytes_);
        return;
    }
    device_->submit("clearing " + name_, [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, get(), 0, VK_WHOLE_SIZE, 0);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask =
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &barrier, 0, nullptr, 0, nullptr);
    });
}

} // namespace hyalite::core::gpu
