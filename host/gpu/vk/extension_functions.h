// Functions of device extensions, which the loader does not export.
#pragma once

#include <vulkan/vulkan.h>

/// The function of an enabled extension of the device.
#define HYALITE_EXTENSION_FUNCTION(device, name)                                                             \
    reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name))
