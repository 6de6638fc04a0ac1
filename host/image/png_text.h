// Text chunks of PNG files (ISO/IEC 15948, 11.3.4).
#pragma once

#include "host/image/attribute.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hyalite {

/// Puts iTXt chunks, one for each attribute, between the header and the pixels of a PNG file that begins with its
/// header, as all do. The other chunks stay as they are. Control characters in texts become U+FFFD, too, but for line
/// feeds; "software" gets the keyword that the standard has for it, "Software".
void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes);

} // namespace hyalite
