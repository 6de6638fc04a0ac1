// What an image file says about itself.
#pragma once

#include <string>
#include <utility>

namespace hyalite {

/// A name and a text. Names have 1 to 79 printable ASCII characters, no blanks around them nor two of them together; what
/// is not UTF-8 in a text becomes U+FFFD.
using Attribute = std::pair<std::string, std::string>;

} // namespace hyalite
