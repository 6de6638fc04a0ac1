// The README of each folder of host/ has a row for each of its files.
#include "tests/house/source_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

/// The names in the first column of the tables, as an expression: `obj*` stands for all names that begin so.
std::string namesOfTables(const fs::path &document) {
    std::istringstream lines(textOf(document));
    const std::regex name("`([a-z_0-9*]+)(\\.h)?`");
    std::string names = "none";
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| `"))
            continue;
        const std::string column = line.substr(0, line.find(" | "));
        for (std::sregex_iterator match(column.begin(), column.end(), name), end; match != end; ++match)
            names += "|" + std::regex_replace((*match)[1].str(), std::regex("\\*"), ".*");
    }
    return names;
}

TEST(FolderTables, NameEachFile) {
    std::set<std::string> unnamed;
    for (const auto &folder : fs::directory_iterator(fs::path(HYALITE_SOURCE_DIR) / "host")) {
        const fs::path document = folder.path() / "README.md";
        if (!fs::exists(document))
            continue;
        const std::regex named(namesOfTables(document));
        for (const auto &entry : fs::directory_iterator(folder)) {
            const std::string extension = entry.path().extension().string();
            if ((extension == ".h" || extension == ".cpp") &&
                !std::regex_match(entry.path().stem().string(), named))
                unnamed.insert((folder.path().filename() / entry.path().filename()).string());
        }
    }
    EXPECT_EQ(unnamed, std::set<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
