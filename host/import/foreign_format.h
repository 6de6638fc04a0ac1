// Foreign formats: scenes that are not read, and commands that make a .glb of them.
#pragma once

#include <filesystem>

namespace hyalite::core {

/// Throws Error{BadInput} for a file of such a format, with the command. It is recognised by its extension, in any
/// letter case, and by its first bytes, whatever its name. Files that cannot be opened are left to their readers.
void refuseForeignFormat(const std::filesystem::path &file);

} // namespace hyalite::core
