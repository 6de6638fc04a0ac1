// URIs of glTF files: names of files beside them, or data in base64 (RFC 3986, RFC 2397, RFC 4648).
#pragma once

#include "host/base/json_reader.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

/// The bytes of a data URI; nothing for a URI of another kind. Throws Error{BadInput} for data that is not base64.
[[nodiscard]] std::optional<std::vector<std::byte>> dataOf(const JsonNode &uri);

/// The name of a file that a relative URI stands for. Throws Error{BadInput} for a URI with a scheme, such as http:.
[[nodiscard]] std::string fileNameOf(const JsonNode &uri);

} // namespace hyalite::core::gltf
