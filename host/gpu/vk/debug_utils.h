// Names of Vulkan objects and labels of commands, for RenderDoc, Nsight and the messages of the validation layer.
#pragma once

#include "host/gpu/vk/instance.h"

#include <cstdint>
#include <string>

namespace hyalite::core::gpu {

/// Does nothing without VK_EXT_debug_utils.
class DebugUtils {
  public:
    DebugUtils() = default;
    DebugUtils(const Instance &instance, VkDevice device);

    template <class Object> void name(VkObjectType type, Object object, const std::string &text) const {
        nameHandle(type, reinterpret_cast<std::uint64_t>(object), text);
    }
    void beginLabel(VkCommandBuffer commands, const std::string &text) const;
    void endLabel(VkCommandBuffer commands) const;

  private:
    void nameHandle(VkObjectType type, std::uint64_t handle, const std::string &text) const;

    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
};

} // namespace hyalite::core::gpu
