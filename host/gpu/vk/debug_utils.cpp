#include "host/gpu/vk/debug_utils.h"

#include "host/gpu/vk/check.h"

namespace hyalite::core::gpu {

DebugUtils::DebugUtils(const Instance &instance, VkDevice device) : device_(device) {
    if (!instance.hasDebugUtils())
        return;
    setObjectName_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetInstanceProcAddr(instance.get(), "vkSetDebugUtilsObjectNameEXT"));
    beginLabel_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(instance.get(), "vkCmdBeginDebugUtilsLabelEXT"));
    endLabel_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(instance.get(), "vkCmdEndDebugUtilsLabelEXT"));
}

void DebugUtils::nameHandle(VkObjectType type, std::uint64_t handle, const std::string &text) const {
    if (setObjectName_ == nullptr)
        return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = text.c_str();
    check(setObjectName_(device_, &info), "vkSetDebugUtilsObjectNameEXT for " + text);
}

void DebugUtils::beginLabel(VkCommandBuffer commands, const std::string &text) const {
    if (beginLabel_ == nullptr || endLabel_ == nullptr)
        return;
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = text.c_str();
    beginLabel_(commands, &label);
}

void DebugUtils::endLabel(VkCommandBuffer commands) const {
    if (beginLabel_ != nullptr && endLabel_ != nullptr)
        endLabel_(commands);
}

} // namespace hyalite::core::gpu
