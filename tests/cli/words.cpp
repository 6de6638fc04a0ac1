#include "tests/cli/words.h"

#include <stdexcept>
#include <utility>

namespace hyalite::core::testing {

std::vector<std::string> splitWords(std::string_view line) {
    std::vector<std::string> words;
    const auto refuse = [&](const std::string &why) {
        throw std::runtime_error(why + " in the command line: " + std::string(line));
    };
    std::string word;
    bool isInWord = false;
    char quote = '\0';
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quote != '\0') {
            if (c == quote)
                quote = '\0';
            else if (quote == '"' && (c == '$' || c == '`'))
                refuse("a substitution");
            else
                word += c;
        } else if (c == '\'' || c == '"') {
            quote = c;
            isInWord = true;
        } else if (c == ' ' || c == '\t') {
            if (isInWord)
                words.push_back(std::exchange(word, {}));
            isInWord = false;
        } else if (c == '#' && !isInWord) {
            break;
        } else if (std::string_view("|&;<>()$`*?[").find(c) != std::string_view::npos ||
                   (c == '~' && !isInWord)) {
            refuse(std::string("the shell's ") + c);
        } else {
            const bool isEscape = c == '\\' && i + 1 < line.size();
            word += isEscape ? line[++i] : c;
            isInWord = true;
        }
    }
    if (quote != '\0')
        refuse("a quote without an end");
    if (isInWord)
        words.push_back(word);
    return words;
}

} // namespace hyalite::core::testing
