// Content guess: what a file looks like that is not what its name says.
#pragma once

#include "host/base/input_file.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite {

/// The size of a byte order mark of UTF-8 at the beginning: 3, or 0 without one.
[[nodiscard]] std::size_t byteOrderMarkBytes(std::span<const char> head);

/// What the first bytes of a file look like, with a remedy: "gzip data: unpack it first (gunzip)". Empty for plain
/// text, which has hardly any control characters.
[[nodiscard]] std::string guessContent(std::span<const char> head);

/// The same by the first bytes of known formats alone; empty for all else.
[[nodiscard]] std::string guessBySignature(std::span<const char> head);

/// What to say of a file that is of no format that is read: that it is empty, or `message` and what it looks like.
[[nodiscard]] std::string foreignContent(const InputFile &file, const std::string &message);

/// How much of a file guessContent() wants to see.
inline constexpr std::size_t guessedBytes = 512;

} // namespace hyalite
