// Radiance's picture files (.hdr, .pic): a text header, then a byte each for red, green, blue and a common exponent.
//
//     #?RADIANCE
//     FORMAT=32-bit_rle_rgbe
//                                 an empty line ends the header
//     -Y 480 +X 640               rows from top to bottom, pixels from left to right
//     <rows, run-length encoded>
//
// Defined by G. Ward, "Real Pixels", Graphics Gems II (1991), and the file formats' reference of Radiance. The largest
// channel has eight bits, so a value is off by up to 1/256 of it.
//
// The code is our own, because stb_image accepts truncated files, and stb_image_write always rounds down, which darkens
// pictures.
#pragma once

#include "host/base/atomic_file.h"
#include "host/base/input_file.h"
#include "host/image/image.h"

#include <cstddef>
#include <span>

namespace hyalite::core {

/// Values are rounded to the nearest ones of the format. Negative values and NaN become 0; values beyond the format,
/// 2^127 and infinity, become its largest. Throws Error{OutputNotWritten}.
void writeHdr(AtomicFile &file, const Image &image);

/// Whether the first bytes of a file are those of a Radiance picture.
[[nodiscard]] bool isHdr(std::span<const std::byte> head);

/// Reads rows from top to bottom, run-length encoded in the new manner, the old one, or not at all. Values are m * 2^(e
/// - 136), as nearly all programs have it; Radiance's own adds a half to m. EXPOSURE and other lines of the header are
/// ignored. Throws Error{BadInput}: also for other orders of pixels and for the colour space XYZ; Error{LimitExceeded}
/// for files that would take more memory than readingBytesMax.
[[nodiscard]] Image readHdr(const InputFile &file);

} // namespace hyalite::core
