// The kernels of the program as SPIR-V, and a hash of all that decides what colour a pixel has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace hyalite::core {

/// A kernel's words, packed as a frame of zstd: they are tens of megabytes, of which a render needs less than one. The
/// lowest bytes of all words come first, then those of the next place, as these are alike.
class KernelWords {
  public:
    template <std::size_t packedCount>
    constexpr KernelWords(const std::uint32_t (&packed)[packedCount], std::size_t count)
        : packed_(packed), count_(count) {}

    /// Unpacks them at the first call, and keeps them as long as the program runs. Thread-safe.
    [[nodiscard]] std::span<const std::uint32_t> get() const;
    operator std::span<const std::uint32_t>() const { return get(); }

  private:
    std::span<const std::uint32_t> packed_;
    std::size_t count_;
};

struct EmbeddedKernel {
    std::string_view name;
    std::string_view definitions; ///< of macros, as the build has them: "RAYS=1 MEMORY_TEXELS=0"
    KernelWords words;
    std::uint64_t hash; ///< hashBytes() of the words, found by the build
};

/// All kernels, in the order of shaders/CMakeLists.txt.
[[nodiscard]] std::span<const EmbeddedKernel> embeddedKernels();

/// The words of the kernel with this name. Throws std::logic_error where there is none.
[[nodiscard]] std::span<const std::uint32_t> embeddedKernel(std::string_view name);

/// A hash of the sources of kernels, CPU twin and packing, in hexadecimal digits.
[[nodiscard]] const char *pixelSources();

} // namespace hyalite::core
