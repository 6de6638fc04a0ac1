// Driver environment: what keeps the Vulkan loader from its drivers, as far as environment and limits tell.
#pragma once

#include <functional>

namespace hyalite::core::gpu {

/// Throws Error{LimitExceeded} if a limit (ulimit -v) leaves too little address space for any driver.
void requireAddressSpace();

/// Calls the loader. Where it fails and VK_DRIVER_FILES or VK_ICD_FILENAMES is set, the DeviceFault has its value, too,
/// and what is wrong with each of its files; it is DeviceFault{NoDevice} if there is any such fault.
void explainDriverFiles(const std::function<void()> &callLoader);

} // namespace hyalite::core::gpu
