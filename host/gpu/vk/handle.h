// A move-only owner of one Vulkan object.
#pragma once

#include <vulkan/vulkan.h>

#include <type_traits>
#include <utility>

namespace hyalite::core::gpu {

struct NoParent {};

/// Abandons a device: neither it nor its objects are destroyed any more, because a kernel that does not end still uses
/// them. Thread-safe.
void abandon(VkDevice device);
[[nodiscard]] bool isAbandoned(VkDevice device) noexcept;

void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks *callbacks);

/// Destroys `object` with `destroy(parent, object, nullptr)`, or `destroy(object, nullptr)` for objects that have no
/// parent (instances and devices), unless the device is abandoned. The parent must outlive the handle.
template <class Object, auto destroy, class Parent = VkDevice> class Handle {
  public:
    Handle() = default;
    Handle(Parent parent, Object object) : parent_(parent), object_(object) {}
    Handle(Handle &&other) noexcept
        : parent_(other.parent_), object_(std::exchange(other.object_, Object(VK_NULL_HANDLE))) {}
    Handle &operator=(Handle &&other) noexcept {
        std::swap(parent_, other.parent_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_ == VK_NULL_HANDLE)
            return;
        if constexpr (std::is_same_v<Object, VkDevice>) {
            if (!isAbandoned(object_))
                destroy(object_, nullptr);
        } else if constexpr (std::is_same_v<Parent, NoParent>) {
            destroy(object_, nullptr);
        } else if (!isAbandoned(parent_)) {
            destroy(parent_, object_, nullptr);
        }
    }

    [[nodiscard]] Object get() const { return object_; }
    /// Releases ownership without destroying the object.
    void release() { object_ = VK_NULL_HANDLE; }

  private:
    Parent parent_{};
    Object object_ = VK_NULL_HANDLE;
};

using InstanceHandle = Handle<VkInstance, vkDestroyInstance, NoParent>;
using DeviceHandle = Handle<VkDevice, vkDestroyDevice, NoParent>;
using BufferHandle = Handle<VkBuffer, vkDestroyBuffer>;
using BufferViewHandle = Handle<VkBufferView, vkDestroyBufferView>;
using AccelerationStructureHandle = Handle<VkAccelerationStructureKHR, destroyAccelerationStructure>;
using MemoryHandle = Handle<VkDeviceMemory, vkFreeMemory>;
using ShaderModuleHandle = Handle<VkShaderModule, vkDestroyShaderModule>;
using SetLayoutHandle = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using PipelineHandle = Handle<VkPipeline, vkDestroyPipeline>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using CommandPoolHandle = Handle<VkCommandPool, vkDestroyCommandPool>;
using FenceHandle = Handle<VkFence, vkDestroyFence>;
using QueryPoolHandle = Handle<VkQueryPool, vkDestroyQueryPool>;

} // namespace hyalite::core::gpu
