// Choice of division and square root: the device's own operators, or those of shaders/math/arithmetic.glsl.
//
// Vulkan promises correctly rounded + - * only, and to nearest only where RoundingModeRTE is offered. The operators of
// shaders/math/arithmetic.glsl need no more than that, but take longer. No number of samples can prove that a driver's
// own operators round correctly. They run only for drivers on a list, each with its reason, if a check on hard inputs
// passes too.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hyalite::gpu {

class Device;
struct HardInput;

enum class Arithmetic {
    Automatic, ///< the device's own where the list and the check allow it
    Own,       ///< shaders/math/arithmetic.glsl
    Native,    ///< the device's own, unchecked
};

/// The choice with its reason.
struct ArithmeticChoice {
    bool isNative = false;
    std::string reason;
};

/// Whether the driver with this VkDriverId is on the list of those whose / and sqrt are correctly rounded.
[[nodiscard]] bool isExactDivisionListed(std::uint32_t driverId);

/// The float control that equal bits need and the device lacks, or empty.
[[nodiscard]] std::string explainUnpromisedBits(const DeviceInfo &device);

/// Runs the check on the device if the choice depends on it.
[[nodiscard]] ArithmeticChoice chooseArithmetic(Device &device, Arithmetic wanted);

/// The number of device results (quotient and root of each input in turn) that differ in any bit from this machine's.
[[nodiscard]] std::size_t countWrongResults(std::span<const HardInput> inputs,
                                            std::span<const float> results);

/// Runs the device's / and sqrt on hard inputs. Returns the number of wrong results.
[[nodiscard]] std::size_t checkNativeArithmetic(Device &device);

} // namespace hyalite::gpu
