// Whole files in memory.
#pragma once

#include <filesystem>
#include <vector>

namespace hyalite::core {

/// The bytes of a regular file of at most 4 GiB. Throws Error{BadInput} as InputFile does, and for a longer one.
[[nodiscard]] std::vector<char> readWholeFile(const std::filesystem::path &file);

} // namespace hyalite::core
