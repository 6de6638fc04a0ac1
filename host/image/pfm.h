// PFM, the float sibling of PPM: a text header, then rows of float32 from the bottom row to the top row.
//
//     PF            colour (three floats a pixel); Pf: grey (one)
//     640 480       width and height
//     -1.0          negative: little endian, positive: big endian
//     <floats>
//
// Defined by Debevec's HDR Shop; described by P. Bourke, "PBM / PGM / PNM / PPM / PFM formats".
#pragma once

#include "host/base/atomic_file.h"
#include "host/base/input_file.h"
#include "host/image/image.h"

#include <cstddef>
#include <span>

namespace hyalite::core {

/// Whether the first bytes of a file are those of a PFM.
[[nodiscard]] bool isPfm(std::span<const std::byte> head);

/// Writes colour, little endian, with a scale of -1.0: the floats of the image, bit by bit.
void writePfm(AtomicFile &file, const Image &image);

/// Reads colour and grey of either byte order. The magnitude of the scale is ignored and the floats are taken as
/// they are stored: programs disagree on whether to multiply or divide by it, and nearly all write 1.
/// Throws Error{BadInput}.
[[nodiscard]] Image readPfm(const InputFile &file);

} // namespace hyalite::core
