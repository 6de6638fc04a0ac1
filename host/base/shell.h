// Command lines as text for a POSIX shell.
#pragma once

#include <span>
#include <string>

namespace hyalite {

/// The words with blanks between them, quoted where a shell would read anything into them: pasted back, they are the
/// same words, byte for byte.
[[nodiscard]] std::string shellLine(std::span<const char *const> words);

} // namespace hyalite
