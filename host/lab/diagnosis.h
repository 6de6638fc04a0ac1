// Diagnosis: why a device cannot be used, or is missing, and what to do about it.
#pragma once

#include "host/lab/machine.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// A Vulkan device as the loader lists it.
struct ListedDevice {
    int index = 0;
    std::string name;
    std::uint32_t vendorId = 0;
    std::uint32_t deviceId = 0;
    bool isSoftware = false;
    std::string rejection; ///< why it cannot be used, or empty
};

struct Finding {
    std::string code; ///< a word for scripts, such as "no-driver"
    bool isProblem = false;
    std::string what;
    std::string remedy; ///< empty: there is none
};

/// `loaderError` is why there is no list of devices, or empty. The gravest finding is the first.
[[nodiscard]] std::vector<Finding> diagnose(const Machine &machine, std::span<const ListedDevice> devices,
                                            const std::string &loaderError);

} // namespace hyalite::core
