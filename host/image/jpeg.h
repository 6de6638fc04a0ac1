// JPEG files (ISO/IEC 10918), through libjpeg-turbo.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <cstddef>
#include <span>

namespace hyalite {

/// Whether the first bytes of a file are those of a JPEG.
[[nodiscard]] bool isJpeg(std::span<const std::byte> head);

/// Reads baseline and progressive files of 8 bits, grey or in colour, to their 8-bit levels, alpha being 255. Colour
/// profiles, and how a camera was held, are passed over. Throws Error{BadInput}: also for CMYK, for files that are cut
/// short or damaged, and for more than 64 scans; Error{LimitExceeded} for files that would take more memory than
/// readingBytesMax.
[[nodiscard]] Texture readJpeg(const InputFile &file);

} // namespace hyalite
