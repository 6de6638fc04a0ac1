#include "host/gpu/vk/handle.h"

#include "host/gpu/vk/extension_functions.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace hyalite::core::gpu {

namespace {

std::mutex mutex;
std::vector<VkDevice> abandoned; ///< they are never destroyed, so no other device gets the same handle

} // namespace

void abandon(VkDevice device) {
    const std::lock_guard lock(mutex);
    abandoned.push_back(device);
}

bool isAbandoned(VkDevice device) noexcept {
    const std::lock_guard lock(mutex);
    return std::find(abandoned.begin(), abandoned.end(), device) != abandoned.end();
}

void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks *callbacks) {
    HYALITE_EXTENSION_FUNCTION(device, vkDestroyAccelerationStructureKHR)(device, structure, callbacks);
}

} // namespace hyalite::core::gpu
