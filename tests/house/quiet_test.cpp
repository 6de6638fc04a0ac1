// What programs do is not done by what they call: printing, options, signals, environment, allocator, processes.
#include "host/engine/scene_options.h"
#include "tests/house/source_text.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

const fs::path host = fs::path(HYALITE_SOURCE_DIR) / "host";

/// "FILE: FOUND" of each match outside of the folders and files that may have it.
std::set<std::string> offences(const std::string &pattern, const std::set<std::string> &allowed) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (const auto &entry : fs::recursive_directory_iterator(host)) {
        const fs::path relative = fs::relative(entry.path(), host);
        const std::string extension = relative.extension().string();
        if ((extension != ".h" && extension != ".cpp") || allowed.contains(relative.begin()->string()) ||
            allowed.contains(relative.string()))
            continue;
        const std::string text = textOf(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
            found.insert(relative.string() + ": " + match->str());
    }
    return found;
}

const std::set<std::string> none;

TEST(BelowCommands, NothingPrints) {
    EXPECT_EQ(offences(R"(\b(print(Message|Warning|Result)|fprintf|printf|fputs|puts|fwrite|fmt::print)\()",
                       {"cli", "main.cpp", "base/message.h"}),
              none);
    EXPECT_EQ(offences(R"(std::(cout|cerr|clog)|\bstd(out|err)\b)", {"cli", "main.cpp", "base/message.h"}),
              none);
}

/// "look-at|width|...": the options that commands have.
std::string optionNames() {
    const std::regex literal("\"(?:-[a-z],)?--([a-z][a-z-]+)\"");
    std::set<std::string> names;
    for (const auto &entry : fs::directory_iterator(host / "cli")) {
        const std::string text = textOf(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), literal), end; match != end; ++match)
            names.insert((*match)[1]);
    }
    for (const std::string_view name : sceneOptionNames())
        names.insert(std::string(name));
    return fmt::format("{}", fmt::join(names, "|"));
}

TEST(BelowCommands, NothingKnowsTheNameOfAnOption) {
    const std::string names = optionNames();
    EXPECT_TRUE(names.find("|look-at|") != std::string::npos && names.find("|spp") != std::string::npos)
        << names;
    EXPECT_EQ(offences("--(" + names + ")\\b", {"cli", "main.cpp"}), none);
}

TEST(BelowCommands, NothingCatchesSignalsOrForks) {
    EXPECT_EQ(offences(R"(\b(signal|sigaction|fork|waitpid|atexit)\()", {"process", "cli", "main.cpp"}),
              none);
}

TEST(BelowCommands, NothingChangesEnvironmentOrAllocator) {
    EXPECT_EQ(offences(R"(\b(setenv|unsetenv|putenv|mallopt|sbrk)\()", {"process", "cli", "main.cpp"}), none);
}

} // namespace
} // namespace hyalite::core::testing
