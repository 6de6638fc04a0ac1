// Limits on the size of images, and on memory for reading them.
#pragma once

#include "host/base/input_file.h"

#include <cstdint>

namespace hyalite::core {

/// Larger images are refused before memory is allocated.
inline constexpr int imageSideMax = 32768;
inline constexpr std::uint64_t imagePixelCountMax = std::uint64_t{1} << 28;

/// Maximum memory for reading a file of `fileBytes`: enough for 8192 x 4096 pixels of any content without alpha, because
/// flat images compress a thousandfold; beyond that in proportion to the file, so that no small file allocates gigabytes.
[[nodiscard]] constexpr std::uint64_t readingBytesMax(std::uint64_t fileBytes) {
    return (std::uint64_t{512} << 20) + 64 * fileBytes;
}

/// Throws Error{BadInput} where an image of that size, which `file` says it has, is empty or larger than allowed.
void requireImageSize(const InputFile &file, std::int64_t width, std::int64_t height);

/// Throws Error{LimitExceeded} where reading `file`, an image of that size, needs more memory than readingBytesMax.
void requireReadingMemory(const InputFile &file, std::uint64_t width, std::uint64_t height,
                          std::uint64_t neededBytes);

} // namespace hyalite::core
