// Facts about a device that are kept between runs: its fastest kernels and exchange of values, and whether its bits
// were verified.
#pragma once

#include "host/engine/observer.h"
#include "host/gpu/render_config.h"
#include "host/gpu/vk/device_list.h"

#include <filesystem>
#include <optional>
#include <string>

namespace hyalite::core {

struct Tuning {
    gpu::KernelChoices kernels{}; ///< by Workload
    std::string date;             ///< YYYY-MM-DD, in UTC; empty: not measured
    std::string verifiedDate;     ///< likewise, when all shipped films had the shipped bits; empty: not yet

    std::optional<bool> hasSlowShuffles{}; ///< of vectors of 512 bits, as DeviceInfo has it

    [[nodiscard]] bool isMeasured() const { return !date.empty(); }
};

/// $HYALITE_CACHE/tuning.json, or hyalite/tuning.json in $XDG_CACHE_HOME, or in ~/.cache. Throws
/// Error{OutputNotWritten} if none of these variables is set.
[[nodiscard]] std::filesystem::path tuningFile();

/// The entry for this device, this version of its driver and these kernels. An unreadable file is noted and passed
/// over, because tuning changes no bit of any image.
[[nodiscard]] Tuning readTuning(const gpu::DeviceInfo &device, Observer &observer = nobody());

/// Stores an entry, and keeps those of other devices, unless the file is unreadable, which is noted. Throws
/// Error{OutputNotWritten}.
void storeTuning(const gpu::DeviceInfo &device, const Tuning &tuning, Observer &observer = nobody());

/// YYYY-MM-DD, in UTC.
[[nodiscard]] std::string today();

/// How sure it is that a device's images have the bits of the CPU twin's, by what the start-up check found and what was
/// verified: without a promise, bits count as measured only where all shipped films had them, because drivers can
/// transform large kernels otherwise than the check's.
[[nodiscard]] gpu::BitGuarantee guaranteeOf(const gpu::BitGuarantee &byStartupCheck, const Tuning &tuning);

} // namespace hyalite::core
