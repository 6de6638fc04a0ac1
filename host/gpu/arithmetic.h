// Choice of division and square root: the device's own operators, or those of shaders/math/arithmetic.glsl.
//
// Vulkan promises correctly rounded + - * only, and to nearest only where RoundingModeRTE is offered. The operators of
// shaders/math/arithmetic.glsl need no more than that, but take longer. No number of samples can prove that a driver's
// own operators round correctly. They run only for drivers on a list, each with its reason, if a check on hard inputs
// passes too.
#pragma once

#include "host/gpu/startup_check.h"
#include "host/gpu/vk/device_list.h"

#include <cstdint>
#include <string>

namespace hyalite::core::gpu {

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

[[nodiscard]] ArithmeticChoice chooseArithmetic(const DeviceInfo &device, const StartupCheck &check,
                                                Arithmetic wanted);

/// How sure it is that images have the bits of the CPU twin's.
enum class BitDegree {
    Promised, ///< the driver offers the float controls that equal bits need
    Measured, ///< it does not, but nothing that was compared differs
    None
};

struct BitGuarantee {
    BitDegree degree = BitDegree::Promised;
    std::string reason; ///< why it is no promise; empty if it is one
};

[[nodiscard]] BitGuarantee guaranteeOf(const DeviceInfo &device, const StartupCheck &check);

/// "promised", or the degree and its reason.
[[nodiscard]] std::string describe(const BitGuarantee &bits);

/// The float control that equal bits need and the device lacks, or empty.
[[nodiscard]] std::string explainUnpromisedBits(const DeviceInfo &device);

} // namespace hyalite::core::gpu
