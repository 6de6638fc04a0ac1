// Attributes: the metadata of an image file.
#pragma once

#include <string>
#include <utility>

namespace hyalite::core {

/// A name and a text. Names have 1 to 79 printable ASCII characters, without leading, trailing or double blanks. Bytes
/// of a text that are not UTF-8 become U+FFFD.
using Attribute = std::pair<std::string, std::string>;

} // namespace hyalite::core
