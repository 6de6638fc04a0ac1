// Stored tuning results: the fastest kernels measured on a device, kept between runs.
#pragma once

#include "host/gpu/render_config.h"
#include "host/gpu/vk/device_list.h"

#include <filesystem>
#include <string>

namespace hyalite {

struct Tuning {
    gpu::KernelChoices kernels{}; ///< by Workload
    std::string date;             ///< YYYY-MM-DD, in UTC; empty: not measured

    [[nodiscard]] bool isMeasured() const { return !date.empty(); }
};

/// $HYALITE_CACHE/tuning.json, or hyalite/tuning.json in $XDG_CACHE_HOME, or in ~/.cache. Throws
/// Error{OutputNotWritten} if none of these variables is set.
[[nodiscard]] std::filesystem::path tuningFile();

/// The entry for this device, this version of its driver and these kernels. An unreadable file is reported on standard
/// error and ignored, because tuning changes no bit of any image.
[[nodiscard]] Tuning readTuning(const gpu::DeviceInfo &device);

/// Stores an entry, and keeps those of other devices. Throws Error{OutputNotWritten}.
void storeTuning(const gpu::DeviceInfo &device, const Tuning &tuning);

} // namespace hyalite
