// Standard streams in the place of files: "-" is standard input or output, and "exr:-" says of what format it is.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace hyalite::core {

/// The format that the name of a standard stream says: "exr" of "exr:-", and nothing of "-". Empty for the name of a
/// file: one of this name is "./-".
[[nodiscard]] std::optional<std::string> standardStreamFormat(const std::filesystem::path &path);

[[nodiscard]] inline bool isStandardStream(const std::filesystem::path &path) {
    return standardStreamFormat(path).has_value();
}

/// All of standard input, which is read once and kept. Throws Error{BadInput} where it is a terminal, is empty, has
/// more than 4 GiB or fails.
[[nodiscard]] std::span<const std::byte> standardInput();

} // namespace hyalite::core
