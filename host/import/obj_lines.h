// Logical lines of a text file, in bounded memory: any line ends, continuations joined, without a byte order mark.
#pragma once

#include "host/base/input_file.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Throws Error{BadInput} "file:line: message".
[[noreturn]] void failAtLine(const std::string &file, std::size_t line, std::string_view message);

/// Maximum length of input in messages.
inline constexpr std::size_t maxExcerptBytes = 40;

/// An excerpt of the input, in quotes.
[[nodiscard]] std::string quoteInput(std::string_view text);

class ObjLines {
  public:
    static constexpr std::size_t maxFileBytes = 0xFFFF'FFFF; ///< so that 32 bits count anything in the file
    static constexpr std::size_t maxLineBytes = std::size_t{1} << 24;

    /// Throws Error{BadInput} as InputFile does.
    explicit ObjLines(const std::filesystem::path &path);

    /// The next logical line without its line end, which is LF, CR or CRLF. A line that ends in a backslash is joined
    /// with the next one, except in comments. The caller may write to the characters and to the one after them; they
    /// are valid until the next call. Empty at the end of the file. Throws Error{BadInput} if a line or the file is too
    /// long, or on a read error.
    [[nodiscard]] std::optional<std::span<char>> next();

    /// The beginning of the file, before the first line is taken.
    [[nodiscard]] std::span<const char> head() const {
        return std::span(buffer_).first(std::min(filled_, std::size_t{512}));
    }

    /// The text from the next logical line on, without consuming it. A zero follows the last character in memory,
    /// wherever that is.
    [[nodiscard]] const char *peek() const { return buffer_.data() + scan_; }
    [[nodiscard]] std::size_t peekedLineNumber() const { return nextLine_; }

    /// Consumes one line of peek(), with its line end; the next one begins at `nextBegin`.
    void take(const char *nextBegin) {
        scan_ = static_cast<std::size_t>(nextBegin - buffer_.data());
        ++nextLine_;
    }

    /// Number of the line that next() returned last, from 1.
    [[nodiscard]] std::size_t lineNumber() const { return line_; }

    [[nodiscard]] const std::string &fileName() const { return name_; }

    [[nodiscard]] std::size_t bytesRead() const { return fileBytes_; }

    /// In [0, 1].
    [[nodiscard]] double shareRead() const;

    /// Throws an Error about the line that next() returned last.
    [[noreturn]] void fail(std::string_view message) const { failAtLine(name_, line_, message); }

  private:
    bool refill();
    void skipLineFeed();

    InputFile file_;
    std::string name_;
    std::vector<char> buffer_;
    std::size_t lineBegin_ = 0; ///< in the buffer
    std::size_t scan_ = 0;      ///< first character of the line that has not been looked at
    std::size_t filled_ = 0;    ///< characters in the buffer, which has room for one more
    std::size_t fileBytes_ = 0; ///< read so far
    std::size_t line_ = 0;
    std::size_t nextLine_ = 1;
};

} // namespace hyalite::core
