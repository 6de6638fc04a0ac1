// The Vulkan instance, with the validation layer on request.
#pragma once

#include "host/gpu/vk/handle.h"

#include <memory>
#include <string>
#include <vector>

namespace hyalite::core::gpu {

/// Gets every message of the validation layer, from any thread. A program sets it before it opens an instance.
inline void (*onValidationMessage)(const char *message) = nullptr;

/// Set HYALITE_VALIDATION=1 to run under VK_LAYER_KHRONOS_validation, with synchronisation checks. Any warning or
/// error of the layer then fails the program.
class Instance {
  public:
    /// Throws Error{NoDevice} if there is no driver, or if the layer is requested and missing.
    Instance();
    ~Instance();
    Instance(const Instance &) = delete;
    Instance &operator=(const Instance &) = delete;

    [[nodiscard]] VkInstance get() const { return handle_.get(); }
    [[nodiscard]] std::vector<VkPhysicalDevice> physicalDevices() const;
    /// Whether VK_EXT_debug_utils is enabled.
    [[nodiscard]] bool hasDebugUtils() const { return hasDebugUtils_; }

    /// Leaves the instance undestroyed, because a device of it is abandoned.
    void abandon();

    /// Throws Error{DeviceLost} with the first message of the validation layer, if there is one.
    void throwOnValidationMessage() const;

  private:
    void create();

    InstanceHandle handle_;
    bool hasDebugUtils_ = false;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<std::string> firstMessage_; ///< filled by the layer's callback
};

} // namespace hyalite::core::gpu
