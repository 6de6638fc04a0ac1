// The Vulkan instance, with the validation layer where it is asked for.
#pragma once

#include "host/gpu/vk/handle.h"

#include <memory>
#include <string>
#include <vector>

namespace hyalite::gpu {

/// Set HYALITE_VALIDATION=1 to run under VK_LAYER_KHRONOS_validation, with synchronisation checks. Any warning or
/// error of the layer is then an error of ours.
class Instance {
  public:
    /// Throws Error{NoDevice} where there is no driver, or where the layer is asked for and missing.
    Instance();
    ~Instance();
    Instance(const Instance &) = delete;
    Instance &operator=(const Instance &) = delete;

    [[nodiscard]] VkInstance get() const { return handle_.get(); }
    [[nodiscard]] std::vector<VkPhysicalDevice> physicalDevices() const;
    /// Whether VK_EXT_debug_utils is enabled.
    [[nodiscard]] bool hasDebugUtils() const { return hasDebugUtils_; }

    /// Does not destroy it: it has a device that is abandoned.
    void abandon();

    /// Throws Error{DeviceLost} with the first message, if the validation layer has had anything to say.
    void throwOnValidationMessage() const;

  private:
    InstanceHandle handle_;
    bool hasDebugUtils_ = false;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<std::string> firstMessage_; ///< filled by the layer's callback
};

} // namespace hyalite::gpu
