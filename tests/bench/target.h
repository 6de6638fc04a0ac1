// Targets of `hyalite render`: the reference renderer, and devices, by the system's drivers or by another one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core::bench {

struct Target {
    std::string name;                       ///< of the column
    std::string device;                     ///< as --device takes it
    std::vector<std::string> environment{}; ///< "NAME=value": what chooses another driver than the system's

    [[nodiscard]] bool isOfSystem() const { return environment.empty(); }
};

inline const Target cpuReference{"CPU reference", "cpu"};

/// The best device of one driver, which is not installed: `manifest` is a JSON file as VK_DRIVER_FILES takes it. The
/// name is the driver's own, "llvmpipe Mesa 25.0.7 (LLVM 15.0.6)", found by rendering an image of one pixel. Throws
/// Error{BadInput}, and std::runtime_error where the driver does not work.
[[nodiscard]] Target targetOf(const std::filesystem::path &manifest);

} // namespace hyalite::core::bench
