// JSON documents: parsed from regular files of bounded size and depth, without duplicate keys.
#pragma once

#include "host/base/error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Parses a regular file of at most 512 MiB, nested at most 32 deep. Throws Error{BadInput}: a syntax error
/// says "FILE:LINE:COLUMN: ...", a key given twice says "FILE: /path/to/the/key: ...".
[[nodiscard]] nlohmann::json readJsonFile(const std::filesystem::path &file);

/// The same for a text that came from such a file, or from a part of it.
[[nodiscard]] nlohmann::json parseJson(const std::string &text, const std::string &fileName);

/// A fault at a place of a document: "FILE: /path/to/the/key: message".
struct JsonFault {
    nlohmann::json::json_pointer path;
    std::string text;
};

/// Error{BadInput} of one fault, or of several, each on its line.
class JsonError : public Error {
  public:
    JsonError(std::vector<JsonFault> theFaults, Remedy mayHelp);

    const std::vector<JsonFault> faults;
};

/// The line, from 1, on which a valid document has the key or element of this path or, if it is missing, the nearest
/// one around it.
[[nodiscard]] std::size_t lineOf(const std::string &text, const nlohmann::json::json_pointer &path);

/// Reads the file again, to add to each fault its line, "... (line 7)", unless all is on one.
[[nodiscard]] JsonError withLines(const JsonError &error, const std::filesystem::path &file);

/// Throws JsonError "FILE: /path/to/the/key: message".
[[noreturn]] void failAt(const std::string &fileName, const nlohmann::json::json_pointer &path,
                         std::string_view message, Remedy remedy = Remedy::None);

} // namespace hyalite::core
