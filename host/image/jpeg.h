// JPEG files (ISO/IEC 10918), through libjpeg-turbo.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <cstddef>
#include <span>

namespace hyalite::core {

/// Whether the first bytes of a file are those of a JPEG.
[[nodiscard]] bool isJpeg(std::span<const std::byte> head);

/// Reads baseline and progressive files of 8 bits, grey or colour, as 8-bit levels with an alpha of 255. Colour
/// profiles and the orientation tag are ignored. Throws Error{BadInput} for damaged or truncated files, for CMYK, and
/// for more than 64 scans; Error{LimitExceeded} for files that would take more memory than readingBytesMax.
[[nodiscard]] Texture readJpeg(const InputFile &file);

} // namespace hyalite::core
