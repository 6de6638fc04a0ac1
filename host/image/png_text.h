// Text chunks of PNG files (ISO/IEC 15948, 11.3.4), which stb_image_write has not.
#pragma once

#include "host/base/input_file.h"
#include "host/image/attribute.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Where the header of a PNG ends: its signature, and the frame and the data of IHDR.
inline constexpr std::size_t pngHeaderEnd = 8 + 12 + 13;

/// Appends the low 32 bits of `value`.
void appendBigEndian32(std::vector<std::byte> &bytes, std::uint64_t value);

/// Appends a chunk with its length and its checksum. `type` has four letters.
void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data);

/// iTXt chunks, one per attribute. Control characters in texts, except line feeds, also become U+FFFD. "software" gets
/// its standard keyword, "Software".
[[nodiscard]] std::vector<std::byte> textChunks(std::span<const Attribute> attributes);

/// Inserts them between the header and the pixels of a PNG file. Other chunks stay as they are.
void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes);

/// The texts before the pixels: those of insertTexts(), and tEXt. Compressed ones, and those that are damaged or have more
/// than a MiB, are passed over. Throws Error{BadInput} where the file cannot be read.
[[nodiscard]] std::vector<Attribute> readPngTexts(const InputFile &file);

} // namespace hyalite::core
