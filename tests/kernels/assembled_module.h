// Small SPIR-V modules written by hand, and what is in them after a pass.
#pragma once

#include "host/gpu/spirv/instructions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core::testing {

using ModuleWords = std::vector<std::uint32_t>;

/// The errors that the validator for Vulkan 1.1 finds in a module: empty if it is valid.
[[nodiscard]] std::string errorsIn(const ModuleWords &words);

[[nodiscard]] std::size_t countOf(const ModuleWords &words, spv::Op opcode);

/// A module whose function `main` has this body, between its first label and the end. There are the constants %yes and
/// %no by SpecId 0 and 1 (true and false by default), %seven by SpecId 2, %unknown from a buffer, and %c0 to %c9.
[[nodiscard]] ModuleWords moduleWith(const std::string &body, const std::string &declarations = "");

/// The values that are stored, in the order of the code: constants as numbers, others as "?". A phi with one operand is
/// that operand.
[[nodiscard]] std::string storesOf(const ModuleWords &words);

} // namespace hyalite::core::testing
