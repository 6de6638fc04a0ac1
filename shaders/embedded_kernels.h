// The kernels of the program as SPIR-V, and a hash of all that decides what colour a pixel has.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hyalite::core {

struct EmbeddedKernel {
    std::string_view name;
    std::string_view definitions; ///< of macros, as the build has them: "RAYS=1 MEMORY_TEXELS=0"
    std::span<const std::uint32_t> words;
    std::uint64_t hash; ///< hashBytes() of the words, found by the build: they are tens of megabytes
};

/// All kernels, in the order of shaders/CMakeLists.txt.
[[nodiscard]] std::span<const EmbeddedKernel> embeddedKernels();

/// The words of the kernel with this name. Throws std::logic_error where there is none.
[[nodiscard]] std::span<const std::uint32_t> embeddedKernel(std::string_view name);

/// A hash of the sources of kernels, CPU twin and packing, in hexadecimal digits.
[[nodiscard]] const char *pixelSources();

} // namespace hyalite::core
