#include "host/base/shell.h"

#include <string_view>

namespace hyalite::core {

namespace {

/// Quotes a word. In single quotes every character except the quote is literal; a quote is written by closing, escaping
/// and reopening.
std::string shellWord(std::string_view word) {
    constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                       "_@%+:,./-=";
    const bool isPlain = !word.empty() && word.front() != '=' && // zsh expands =word
                         word.find_first_not_of(plain) == std::string_view::npos;
    if (isPlain)
        return std::string(word);
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace

std::string shellLine(std::span<const char *const> words) {
    std::string line;
    for (const char *word : words)
        line += (line.empty() ? "" : " ") + shellWord(word);
    return line;
}

} // namespace hyalite::core
