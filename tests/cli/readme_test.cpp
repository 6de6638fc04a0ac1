// The README's commands work as they stand there.
//
// In blocks that open with ```sh every line that begins with `hyalite ` is run, in order and in one folder: what one
// writes is there for the next. Blocks that open with ```sh no-test are left out.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::testing {
namespace {

struct Readme : CommandLine {
    enum class Blocks { Tested, All };

    /// Lines of shell blocks, those that end in \ joined with the next, without indentation.
    static std::vector<std::string> shellLines(Blocks wanted) {
        std::ifstream stream(HYALITE_SOURCE_DIR "/README.md");
        EXPECT_TRUE(stream.good()) << "there is no README.md";
        std::vector<std::string> lines;
        std::string pending;
        bool isInBlock = false;
        bool isWanted = false;
        for (std::string line; std::getline(stream, line);) {
            line.erase(0, line.find_first_not_of(" \t"));
            line.erase(line.find_last_not_of(" \t\r") + 1);
            if (line.starts_with("```")) {
                isWanted =
                    !isInBlock && (line == "```sh" || (wanted == Blocks::All && line.starts_with("```sh ")));
                isInBlock = !isInBlock;
                EXPECT_EQ(pending, "") << "a line of a block ends in \\, and none follows";
            } else if (isWanted && line.ends_with('\\')) {
                pending += line.substr(0, line.size() - 1);
            } else if (isWanted) {
                lines.push_back(pending + line);
                pending.clear();
            }
        }
        EXPECT_FALSE(isInBlock) << "a block has no end";
        return lines;
    }
};

TEST_F(Readme, EveryCommandWorks) {
    const std::string_view program = "hyalite ";
    int commandCount = 0;
    for (const std::string &line : shellLines(Blocks::Tested)) {
        if (!line.starts_with(program))
            continue;
        ++commandCount;
        const Outcome outcome = run(line.substr(program.size()));
        EXPECT_EQ(outcome.exitCode, 0) << line << '\n' << outcome;
    }
    EXPECT_GE(commandCount, 5);
}

TEST_F(Readme, WhatIsGivenToTheScriptIsAWordOfItsOwnOrACommand) {
    // The script's own words; every other word goes to the program.
    const std::set<std::string> ownWords{"showcase", "test", "build", "bench"};
    const std::string help = run("--help").output;
    int callCount = 0;
    for (const std::string &line : shellLines(Blocks::All)) {
        if (!line.starts_with("cmake/run.sh "))
            continue;
        ++callCount;
        const std::string word = splitWords(line).at(1);
        EXPECT_TRUE(ownWords.contains(word) || contains(help, "\n  " + word + " ")) << line;
    }
    EXPECT_GE(callCount, 2) << "the two commands that a newcomer needs";
}

} // namespace
} // namespace hyalite::testing
