// A command line that is pasted into a shell is the same words again.
#include "host/base/shell.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

/// The words that sh makes of a line, each with a line feed behind it.
std::string expandedBySh(const std::string &line) {
    FILE *shell = popen(("printf '%s\\n' " + line).c_str(), "r");
    if (shell == nullptr)
        return "no shell";
    std::string output;
    std::array<char, 256> bytes{};
    for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), shell)) > 0;)
        output.append(bytes.data(), count);
    pclose(shell);
    return output;
}

TEST(ShellLine, PlainWordsStayAsTheyAre) {
    const std::vector<const char *> words{"hyalite", "render", "spheres", "-o",
                                          "a.png",   "--up",   "0,1,0",   "--crop=1,2,3,4"};
    EXPECT_EQ(shellLine(words), "hyalite render spheres -o a.png --up 0,1,0 --crop=1,2,3,4");
}

TEST(ShellLine, IsTheSameWordsAgain) {
    const std::vector<const char *> words{"",     " ",     "a b",   "it's",  "'",      "''",  "\"",   "#a",
                                          "~",    "~root", "[a]*?", "!x",    "$HOME",  "`x`", "a\\b", "\\",
                                          "a\nb", "{a,b}", "a;b",   "a|b&c", "<a>(b)", "=ls", "\xff", "ü"};
    std::string expected;
    for (const char *word : words)
        expected += std::string(word) + "\n";
    EXPECT_EQ(expandedBySh(shellLine(words)), expected);
}

} // namespace
} // namespace hyalite::core
