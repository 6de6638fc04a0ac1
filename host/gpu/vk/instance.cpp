#include "host/gpu/vk/instance.h"

#include "host/base/error.h"
#include "host/gpu/processor_use.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/driver_environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace hyalite::core::gpu {

namespace {

constexpr const char *validationLayer = "VK_LAYER_KHRONOS_validation";

bool isValidationWanted() {
    const char *value = std::getenv("HYALITE_VALIDATION");
    return value != nullptr && std::strcmp(value, "0") != 0 && std::strcmp(value, "") != 0;
}

bool isLayerPresent(const char *name) {
    const std::string action = fmt::format("vkEnumerateInstanceLayerProperties for {}", name);
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), action);
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), action);
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties &layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

/// The extensions of loader and drivers together.
bool isExtensionPresent(const char *name) {
    const std::string action = fmt::format("vkEnumerateInstanceExtensionProperties for {}", name);
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), action);
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()), action);
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties &extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// Of the loader; 1.0 does not tell.
std::uint32_t loaderVersion() {
    const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceVersion>(
        vkGetInstanceProcAddr(VK_NULL_HANDLE, "vkEnumerateInstanceVersion"));
    std::uint32_t version = VK_API_VERSION_1_0;
    if (enumerate != nullptr)
        check(enumerate(&version), "vkEnumerateInstanceVersion for the version of the loader");
    return version;
}

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT *data, void *user) {
    std::string &first = *static_cast<std::string *>(user);
    if (first.empty())
        first = data->pMessage != nullptr ? data->pMessage : "a message without text";
    if (onValidationMessage != nullptr)
        onValidationMessage(data->pMessage != nullptr ? data->pMessage : "");
    return VK_FALSE;
}

/// A messenger that keeps the first warning or error of the validation layer.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo(std::string &firstMessage) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = keepMessage;
    info.pUserData = &firstMessage;
    return info;
}

} // namespace

Instance::Instance() : firstMessage_(std::make_unique<std::string>()) {
    requireVectorWidth();
    // Later the driver has its share.
    [[maybe_unused]] static const bool isChecked = (requireAddressSpace(), true);
    explainDriverFiles([this] { create(); });
}

void Instance::create() {
    const bool isValidated = isValidationWanted();
    if (isValidated && !isLayerPresent(validationLayer))
        throw Error(ErrorKind::NoDevice,
                    fmt::format("HYALITE_VALIDATION is set, but {} is not installed: install "
                                "the package vulkan-validationlayers",
                                validationLayer));
    if (loaderVersion() < VK_API_VERSION_1_1)
        throw Error(ErrorKind::NoDevice,
                    "the Vulkan loader is of version 1.0, and 1.1 is needed: install a newer libvulkan1");
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "hyalite";
    application.apiVersion = VK_API_VERSION_1_1;

    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(*firstMessage_);
    const VkValidationFeatureEnableEXT synchronisation =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronisation;

    std::vector<const char *> extensions;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (isValidated) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validationLayer;
    }
    hasDebugUtils_ = isValidated || isExtensionPresent(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (hasDebugUtils_)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    // Devices that lack a part of Vulkan, such as MoltenVK's, are listed only on request.
    if (isExtensionPresent(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ErrorKind::NoDevice,
                    "no Vulkan driver can be used: install your GPU's driver, or the package "
                    "mesa-vulkan-drivers, whose lavapipe renders on any CPU");
    check(result, "vkCreateInstance for hyalite");
    handle_ = InstanceHandle(NoParent{}, instance);
    if (isValidated) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
        check(create(instance, &messenger, nullptr, &messenger_),
              "vkCreateDebugUtilsMessengerEXT for messages of the validation layer");
    }
}

Instance::~Instance() {
    if (messenger_ == VK_NULL_HANDLE)
        return;
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_.get(), "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle_.get(), messenger_, nullptr);
}

void Instance::abandon() {
    handle_.release();
    messenger_ = VK_NULL_HANDLE;
    // The layer may write to it until the program ends: it is never freed, but stays reachable.
    static std::vector<std::unique_ptr<std::string>> &left = *new std::vector<std::unique_ptr<std::string>>;
    static std::mutex leftMutex;
    const std::lock_guard lock(leftMutex);
    left.push_back(std::exchange(firstMessage_, std::make_unique<std::string>()));
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
    std::uint32_t count = 0;
    const char *const action = "vkEnumeratePhysicalDevices for the list of devices";
    // Loaders open their drivers here.
    explainDriverFiles([&] { check(vkEnumeratePhysicalDevices(handle_.get(), &count, nullptr), action); });
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(handle_.get(), &count, devices.data()), action);
    devices.resize(count);
    return devices;
}

void Instance::throwOnValidationMessage() const {
    if (!firstMessage_->empty())
        throw Error(ErrorKind::DeviceLost, "the validation layer objects: " + *firstMessage_);
}

} // namespace hyalite::core::gpu
