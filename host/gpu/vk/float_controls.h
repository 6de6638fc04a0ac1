// Float controls: rounding of float32, declared in the SPIR-V of a kernel as far as the device supports it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// The float controls that a device offers (VK_KHR_shader_float_controls), for 32 bits.
struct FloatControls {
    bool canRoundToNearestEven = false;
    bool canPreserveSignedZeroInfNan = false;
};

/// The module `spirv` with the execution modes RoundingModeRTE and SignedZeroInfNanPreserve, for 32 bits and all of its
/// entry points, as far as `controls` offers them. They are added here because GLSL cannot make them optional, and a
/// module that declares an unsupported mode is invalid. `spirv` is a valid module in the byte order of this machine.
[[nodiscard]] std::vector<std::uint32_t> addFloatControls(std::span<const std::uint32_t> spirv,
                                                          const FloatControls &controls);

} // namespace hyalite::core::gpu
