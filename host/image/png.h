// PNG files: read by libpng, written by stb_image_write.
#pragma once

#include "host/base/atomic_file.h"
#include "host/base/input_file.h"
#include "host/image/alpha.h"
#include "host/image/attribute.h"
#include "host/image/texture.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace hyalite::core {

/// Whether the first bytes of a file are those of a PNG.
[[nodiscard]] bool isPng(std::span<const std::byte> head);

/// Throws Error{LimitExceeded} where a PNG of that size has more than imagePixelCountMax pixels. `name` is for the
/// message.
void requirePngSize(const std::filesystem::path &name, int width, int height);

/// Writes 8-bit RGB or RGBA, of straight colours: three or four bytes a pixel, row by row from the top left; and
/// `attributes` as text. Throws Error{LimitExceeded} where the image has more than imagePixelCountMax pixels, or memory is
/// short, and Error{OutputNotWritten}.
void writePng(AtomicFile &file, int width, int height, std::span<const std::uint8_t> levels,
              std::span<const Attribute> attributes = {});

/// The bytes of such a file. Throws Error{LimitExceeded} likewise.
[[nodiscard]] std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> levels,
                                               std::span<const Attribute> attributes = {});

/// Reads every kind of PNG (1 to 16 bits, grey, RGB, palette, interlaced) as display-encoded values in [0, 1]: level /
/// 255, or / 65535 for 16 bits. Colours are straight, as they are stored, beside alpha, or the transparency of a palette
/// or of one colour, if the file has it; colour profiles, gamma chunks and texts are passed over, damaged or not. Throws Error{BadInput} for damaged files, which includes a wrong checksum of
/// a chunk that is used and an end that is missing, and Error{LimitExceeded} where the pixels are compressed so densely
/// that they would take more memory than readingBytesMax. Bytes after the end are padding.
[[nodiscard]] AlphaImage readPng(const InputFile &file);

/// Reads every kind of PNG as 8-bit levels (the upper 8 of 16 bits), with its alpha channel, or the transparency of its
/// palette or of one colour, if it has one. Throws as readPng().
[[nodiscard]] Texture readPngTexture(const InputFile &file);

} // namespace hyalite::core
