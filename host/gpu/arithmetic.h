// Which division and square root the kernels run: the device's own operators, or those of shaders/math/arithmetic.glsl.
//
// Vulkan promises correctly rounded + - * only, and to nearest only where RoundingModeRTE is offered. The operators of
// shaders/math/arithmetic.glsl need no more, and cost some time. Whether a driver's own are correctly rounded as well,
// samples cannot prove: they run only for drivers on a list, each with its reason, and hard inputs can still veto.
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

/// What runs, and why.
struct ArithmeticChoice {
    bool isNative = false;
    std::string reason;
};

/// Whether the driver with this VkDriverId is on the list of those whose / and sqrt are correctly rounded.
[[nodiscard]] bool isExactDivisionListed(std::uint32_t driverId);

/// Which float control a device lacks that the equality of images to the bit needs, or empty.
[[nodiscard]] std::string explainUnpromisedBits(const DeviceInfo &device);

/// Runs the check on the device if it is the check that decides.
[[nodiscard]] ArithmeticChoice chooseArithmetic(Device &device, Arithmetic wanted);

/// How many of a device's results (quotient and root of each input in turn) differ in any bit from this machine's.
[[nodiscard]] std::size_t countWrongResults(std::span<const HardInput> inputs,
                                            std::span<const float> results);

/// Runs the device's / and sqrt on hard inputs. Returns how many results are wrong.
[[nodiscard]] std::size_t checkNativeArithmetic(Device &device);

} // namespace hyalite::gpu
