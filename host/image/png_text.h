// Writing of text chunks to PNG files (ISO/IEC 15948, 11.3.4), which stb_image_write has not.
#pragma once

#include "host/image/attribute.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Appends a chunk with its length and its checksum. `type` has four letters.
void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data);

/// Inserts iTXt chunks, one per attribute, between the header and the pixels of a PNG file. Other chunks stay as they
/// are. Control characters in texts, except line feeds, also become U+FFFD. "software" gets its standard keyword,
/// "Software".
void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes);

} // namespace hyalite::core
