// Report on a device: what is known of it.
#pragma once

#include "host/engine/tuning.h"
#include "host/gpu/vk/device_list.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

/// The kernel that `auto` chooses for each workload, by their names.
[[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>>
chosenKernels(const gpu::DeviceInfo &device, const Tuning &tuning);

/// How sure it is that the device's images have the bits of the CPU twin's, in words. Opens a device that promises
/// nothing.
[[nodiscard]] std::string equalBitsOf(const gpu::DeviceInfo &device, Observer &observer);

[[nodiscard]] nlohmann::ordered_json deviceToJson(const gpu::DeviceInfo &device, Observer &observer);

/// The same of the CPU twin, which has no index: it is chosen by name.
[[nodiscard]] nlohmann::ordered_json referenceToJson();

} // namespace hyalite::core
