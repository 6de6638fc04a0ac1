// The start-up check: what no driver says of itself, but a small kernel shows.
#pragma once

#include "shaders/layout/check_records.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace hyalite::core::gpu {

class Device;

/// Operations on hard inputs (hard_inputs.h) whose result differs in any bit from this machine's.
struct WrongResults {
    std::size_t divisions = 0; ///< and square roots
    std::size_t others = 0;    ///< sums, differences, products, conversions and comparisons
};

struct StartupCheck {
    std::size_t divisionCount = 0; ///< of / and sqrt that were compared
    std::size_t otherCount = 0;
    WrongResults wrong;
    /// So many invocations, a power of two, side by side in a workgroup are lanes side by side in a subgroup, from a
    /// multiple of this on.
    std::uint32_t consecutiveLanes = 1;
};

/// Results of `inputs`, in the order of the invocations.
[[nodiscard]] WrongResults countWrongResults(std::span<const layout::HardInput> inputs,
                                             std::span<const layout::CheckResult> results);

/// `results` are those of whole workgroups of `workgroupSize` invocations, a power of two.
[[nodiscard]] std::uint32_t countConsecutiveLanes(std::span<const layout::CheckResult> results,
                                                  std::uint32_t workgroupSize);

/// Runs the check.
[[nodiscard]] StartupCheck checkDevice(Device &device);

} // namespace hyalite::core::gpu
