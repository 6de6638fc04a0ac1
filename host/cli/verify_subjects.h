// What `hyalite verify` verifies: devices and the CPU twin, by the words of --device.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// A renderer to verify.
struct Subject {
    std::string name;                      ///< for openBackend()
    std::optional<gpu::DeviceInfo> device; ///< empty: the CPU twin
};

/// Each once. Throws Error{NoDevice}, and Error{Usage} for the renderer in double precision.
[[nodiscard]] std::vector<Subject> subjectsOf(const std::vector<std::string> &names);

} // namespace hyalite::core
