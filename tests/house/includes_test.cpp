// The folders of host/ stand on each other: each includes itself and those below it.
#include "tests/house/source_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

const std::filesystem::path source = HYALITE_SOURCE_DIR;

std::vector<std::string> matchesOf(const std::string &text, const std::string &pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.push_back((*match)[1]);
    return found;
}

/// The folders from the ground up, as host/CMakeLists.txt lists them.
std::vector<std::string> floors() {
    return matchesOf(textOf(source / "host/CMakeLists.txt"), R"(add_subdirectory\((\w+)\))");
}

std::vector<std::filesystem::path> codeIn(const std::string &folder) {
    std::vector<std::filesystem::path> files;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(source / folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
            files.push_back(entry.path());
    return files;
}

TEST(Includes, RunDownwards) {
    const std::vector<std::string> order = floors();
    ASSERT_GE(order.size(), 10u);
    const auto floorOf = [&](const std::string &folder) {
        return std::find(order.begin(), order.end(), folder) - order.begin();
    };
    std::size_t includeCount = 0;
    for (const std::string &folder : order)
        for (const std::filesystem::path &file : codeIn("host/" + folder))
            for (const std::string &included : matchesOf(textOf(file), R"re(#include "host/(\w+)/)re")) {
                ++includeCount;
                EXPECT_LE(floorOf(included), floorOf(folder))
                    << file << " includes host/" << included << ", a folder above its own";
            }
    EXPECT_GT(includeCount, 500u);
}

// Public headers are included as they are where they are installed.
TEST(Includes, OfTheLibraryAreThoseOfUsers) {
    for (const std::string &folder : floors())
        for (const std::filesystem::path &file : codeIn("host/" + folder)) {
            const bool isAbove = folder == "api" || folder == "python";
            if (!isAbove) {
                EXPECT_TRUE(matchesOf(textOf(file), R"re(#include [<"](hyalite/))re").empty()) << file;
            }
        }
    for (const auto &entry : std::filesystem::directory_iterator(source / "host/api"))
        if (const std::string name = entry.path().filename().string();
            name.ends_with(".h") && name != "contents.h") {
            EXPECT_TRUE(matchesOf(textOf(entry.path()), R"re(#include [<"]((?!hyalite/)[^">]*/))re").empty())
                << entry.path();
        }
}

TEST(Includes, NoFolderIsLeftOut) {
    const std::vector<std::string> order = floors();
    for (const auto &entry : std::filesystem::directory_iterator(source / "host"))
        if (entry.is_directory()) {
            EXPECT_EQ(std::count(order.begin(), order.end(), entry.path().filename().string()), 1)
                << entry.path() << " is not in host/CMakeLists.txt";
        }
}

TEST(Includes, TheProgramKnowsNothingOfTests) {
    for (const char *folder : {"host", "shaders"})
        for (const std::filesystem::path &file : codeIn(folder))
            EXPECT_TRUE(matchesOf(textOf(file), R"re(#include "(tests/[^"]*)")re").empty()) << file;
}

} // namespace
} // namespace hyalite::core::testing
