// Text chunks of PNG files (ISO/IEC 15948, 11.3.4).
#pragma once

#include "host/image/attribute.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hyalite {

/// Inserts iTXt chunks, one per attribute, between the header and the pixels of a PNG file. Other chunks stay as they
/// are. Control characters in texts, except line feeds, also become U+FFFD. "software" gets its standard keyword,
/// "Software".
void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes);

} // namespace hyalite
