#include "host/gpu/vk/check.h"

#include "host/base/host_memory.h"
#include "host/base/quantities.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

namespace hyalite::core::gpu {

std::string resultName(VkResult result) {
    switch (result) {
    case VK_SUCCESS:
        return "VK_SUCCESS";
    case VK_NOT_READY:
        return "VK_NOT_READY";
    case VK_TIMEOUT:
        return "VK_TIMEOUT";
    case VK_INCOMPLETE:
        return "VK_INCOMPLETE";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
        return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_INVALID_SHADER_NV:
        return "VK_ERROR_INVALID_SHADER_NV";
    default:
        return fmt::format("VkResult {}", static_cast<int>(result));
    }
}

/// Drivers report a lack of address space as any error.
constexpr std::uint64_t scarceBytes = std::uint64_t{1} << 30;

void check(VkResult result, const std::string &action) {
    switch (result) {
    case VK_SUCCESS:
        return;
    case VK_TIMEOUT:
    case VK_ERROR_DEVICE_LOST:
        throw DeviceFault(ErrorKind::DeviceLost, fmt::format("{}: {}", action, resultName(result)));
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_MEMORY_MAP_FAILED:
        throw DeviceFault(ErrorKind::LimitExceeded, fmt::format("{}: {}", action, resultName(result)));
    default:
        if (const std::optional<std::uint64_t> left = addressSpaceLeft(); left && *left < scarceBytes)
            throw DeviceFault(
                ErrorKind::LimitExceeded,
                fmt::format("{}: {}, where the limit on address space (ulimit -v) leaves {}; raise it",
                            action, resultName(result), sizeText(*left)));
        throw DeviceFault(ErrorKind::NoDevice, fmt::format("{}: {}", action, resultName(result)));
    }
}

} // namespace hyalite::core::gpu
