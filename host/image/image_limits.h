// How large images may be, and how much memory reading them may take.
#pragma once

#include "host/base/input_file.h"

#include <cstdint>

namespace hyalite {

/// Images larger than this are refused before memory is asked for.
inline constexpr int imageSideMax = 32768;
inline constexpr std::uint64_t imagePixelCountMax = std::uint64_t{1} << 28;

/// Most memory that reading a file of so many bytes may take: enough for 4096 x 4096 pixels of whatever content, as flat
/// ones are packed a thousandfold, and in proportion to the file beyond that, so that no small file asks for gigabytes.
[[nodiscard]] constexpr std::uint64_t readingBytesMax(std::uint64_t fileBytes) {
    return (std::uint64_t{256} << 20) + 64 * fileBytes;
}

/// Throws Error{BadInput} where an image of that size, which `file` says it has, is empty or larger than allowed.
void requireImageSize(const InputFile &file, std::int64_t width, std::int64_t height);

/// Throws Error{LimitExceeded} where reading `file`, an image of that size, needs more memory than readingBytesMax.
void requireReadingMemory(const InputFile &file, std::uint64_t width, std::uint64_t height,
                          std::uint64_t neededBytes);

} // namespace hyalite
