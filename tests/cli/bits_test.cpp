// The pictures of tests/bits/cases.txt, bit for bit. Devices are compared with the CPU twin elsewhere; this holds the
// twin to what it was.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

struct Case {
    std::string md5;
    std::string arguments;
};

void PrintTo(const Case &one, std::ostream *stream) { *stream << one.arguments; }

const std::filesystem::path bitsFolder = std::filesystem::path(HYALITE_SOURCE_DIR) / "tests/bits";

std::vector<Case> readCases() {
    std::ifstream file(bitsFolder / "cases.txt");
    std::vector<Case> cases;
    for (std::string line; std::getline(file, line);)
        if (!line.empty() && line[0] != '#')
            cases.push_back({line.substr(0, 32), line.substr(33)});
    return cases;
}

/// By the program md5sum; its message where it fails.
std::string md5Of(const std::filesystem::path &file) {
    FILE *const pipe = popen(("md5sum '" + file.string() + "' 2>&1").c_str(), "r");
    if (pipe == nullptr)
        return "popen failed";
    char text[256] = {};
    std::fgets(text, sizeof(text), pipe);
    pclose(pipe);
    return std::string(text).substr(0, 32);
}

class Bits : public CommandLine, public ::testing::WithParamInterface<Case> {};

TEST_P(Bits, AreAsTheyWere) {
    const std::filesystem::path picture = folder / "picture.pfm";
    Surroundings surroundings;
    surroundings.folder = bitsFolder;
    std::vector<std::string> words =
        splitWords("render " + GetParam().arguments + " --device cpu --quiet -o");
    words.push_back(picture.string());
    const Outcome outcome = runProgram(words, surroundings);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(md5Of(picture), GetParam().md5)
        << "md5 of: hyalite render " << GetParam().arguments << " -o FILE.pfm";
}

INSTANTIATE_TEST_SUITE_P(OnTheCpu, Bits, ::testing::ValuesIn(readCases()));

TEST(BitsCases, AreThere) { EXPECT_GE(readCases().size(), 97u); }

} // namespace
} // namespace hyalite::core::testing
