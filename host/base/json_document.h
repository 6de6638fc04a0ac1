// JSON documents: parsed from regular files of bounded size and depth, without duplicate keys.
#pragma once

#include "host/base/error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hyalite {

/// Parses a regular file of at most 512 MiB, nested at most 32 deep. Throws Error{BadInput}: a syntax error
/// says "FILE:LINE:COLUMN: ...", a key given twice says "FILE: /path/to/the/key: ...".
[[nodiscard]] nlohmann::json readJsonFile(const std::filesystem::path &file);

/// The same for a text that came from such a file, or from a part of it.
[[nodiscard]] nlohmann::json parseJson(const std::string &text, const std::string &fileName);

/// Throws Error{BadInput} "FILE: /path/to/the/key: message".
[[noreturn]] void failAt(const std::string &fileName, const nlohmann::json::json_pointer &path,
                         std::string_view message, Remedy remedy = Remedy::None);

} // namespace hyalite
