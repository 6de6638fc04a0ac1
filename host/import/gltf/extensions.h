// Extensions of glTF that are read.
#pragma once

#include "host/import/gltf/document.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::gltf {

/// Their names.
[[nodiscard]] std::span<const std::string_view> knownExtensions();

/// Throws Error{BadInput} for another one in "extensionsRequired", and adds one warning for those in "extensionsUsed".
void checkExtensions(const Document &document, std::vector<std::string> &warnings);

} // namespace hyalite::core::gltf
