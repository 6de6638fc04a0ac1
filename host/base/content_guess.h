// Content guess: what a file looks like that is not what its name says.
#pragma once

#include "host/base/input_file.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core {

/// The size of a byte order mark of UTF-8 at the beginning: 3, or 0 without one.
[[nodiscard]] std::size_t byteOrderMarkBytes(std::span<const char> head);

/// A guess at a file by its first bytes, with a remedy: "gzip data: unpack it first (gunzip)". Empty for plain
/// text, which has hardly any control characters.
[[nodiscard]] std::string guessContent(std::span<const char> head);

/// The same by the first bytes of known formats alone; empty for all else.
[[nodiscard]] std::string guessBySignature(std::span<const char> head);

/// The error for a file of an unknown format: that it is empty, or `message` and a guess at its content.
[[nodiscard]] std::string foreignContent(const InputFile &file, const std::string &message);

/// Size of the head that guessContent() takes.
inline constexpr std::size_t guessedBytes = 512;

} // namespace hyalite::core
