// Command lines quoted for a POSIX shell.
#pragma once

#include <span>
#include <string>

namespace hyalite::core {

/// The words separated by blanks, quoted where a shell would interpret them: pasted into a shell, they are the same
/// words, byte for byte.
[[nodiscard]] std::string shellLine(std::span<const char *const> words);

} // namespace hyalite::core
