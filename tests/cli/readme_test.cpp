// Documents: their commands work as they stand there, their links lead somewhere, and they keep to their size.
//
// In blocks that open with ```sh every line that begins with `hyalite ` is run, in order and in one folder a document:
// what one command writes is there for the next. Blocks that open with ```sh no-test are left out. A block that opens
// with ```json NAME is a file of that folder, for the commands below it.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::testing {
namespace {

const std::filesystem::path source = HYALITE_SOURCE_DIR;

/// A document's lines, told apart.
struct Document {
    struct Line {
        std::string text;
        bool isInBlock = false; ///< fences too
    };
    struct Block {
        std::string opening; ///< what follows the fence: "sh", "json first.json"
        std::vector<std::string> lines;
    };
    std::vector<Line> lines;
    std::vector<Block> blocks;
};

Document readDocument(const std::filesystem::path &file) {
    std::ifstream stream(file);
    EXPECT_TRUE(stream.good()) << "there is no " << file;
    Document document;
    bool isInBlock = false;
    for (std::string line; std::getline(stream, line);) {
        const bool isFence = line.starts_with("```");
        if (isFence && !isInBlock)
            document.blocks.push_back({line.substr(3), {}});
        else if (isInBlock && !isFence)
            document.blocks.back().lines.push_back(line);
        document.lines.push_back({line, isInBlock || isFence});
        isInBlock = isInBlock != isFence;
    }
    EXPECT_FALSE(isInBlock) << file << ": a block has no end";
    return document;
}

/// Without indentation; lines that end in \ joined with the next.
std::vector<std::string> shellLines(const Document::Block &block) {
    std::vector<std::string> lines;
    std::string pending;
    for (std::string line : block.lines) {
        line.erase(0, line.find_first_not_of(" \t"));
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (line.ends_with('\\')) {
            pending += line.substr(0, line.size() - 1);
        } else {
            lines.push_back(pending + line);
            pending.clear();
        }
    }
    EXPECT_EQ(pending, "") << "a line of a block ends in \\, and none follows";
    return lines;
}

/// The anchors of a document's headings, made as GitHub makes them.
std::set<std::string> anchorsOf(const Document &document) {
    std::set<std::string> anchors;
    std::map<std::string, int> uses;
    for (const Document::Line &line : document.lines) {
        const std::size_t level = line.text.find_first_not_of('#');
        if (line.isInBlock || level == 0 || level == std::string::npos || line.text[level] != ' ')
            continue;
        std::string anchor;
        for (const char letter : line.text.substr(level + 1)) {
            const auto byte = static_cast<unsigned char>(letter);
            if (letter == ' ')
                anchor += '-';
            else if (std::isalnum(byte) != 0 || byte >= 0x80 || letter == '-' || letter == '_')
                anchor += static_cast<char>(std::tolower(byte));
        }
        const int use = uses[anchor]++;
        anchors.insert(use == 0 ? anchor : anchor + "-" + std::to_string(use));
    }
    return anchors;
}

/// Groups of `pattern` in what is not code: `(1)` of each match.
std::vector<std::string> matchesIn(const Document &document, const std::string &pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> matches;
    for (const Document::Line &line : document.lines)
        if (!line.isInBlock)
            for (std::sregex_iterator match(line.text.begin(), line.text.end(), regex), end; match != end;
                 ++match)
                matches.push_back((*match)[1]);
    return matches;
}

/// All Markdown files of the source tree, relative to it; hidden folders and builds are left out.
std::vector<std::string> documents() {
    std::vector<std::string> files;
    for (std::filesystem::recursive_directory_iterator entry(source), end; entry != end; ++entry) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory() && (name.starts_with('.') || name == "build"))
            entry.disable_recursion_pending();
        else if (name.ends_with(".md"))
            files.push_back(std::filesystem::relative(entry->path(), source).string());
    }
    std::ranges::sort(files);
    return files;
}

struct EveryDocument : CommandLine, ::testing::WithParamInterface<std::string> {
    const Document document = readDocument(source / GetParam());
};

/// A picture whose command does not say its size is a small one here: that the command works is tested, not how long it
/// takes.
std::string withSize(const std::string &arguments) {
    const std::regex makesPictures("(render|compare|profile) .*");
    const bool isSized = contains(arguments, "--width") || contains(arguments, "--crop");
    return std::regex_match(arguments, makesPictures) && !isSized ? arguments + " --width 96 --height 64"
                                                                  : arguments;
}

TEST_P(EveryDocument, HasCommandsThatWork) {
    const std::string_view program = "hyalite ";
    const std::string_view file = "json ";
    for (const Document::Block &block : document.blocks) {
        if (block.opening.starts_with(file)) {
            std::string text;
            for (const std::string &line : block.lines)
                text += line + '\n';
            store(block.opening.substr(file.size()), text);
        } else if (block.opening == "sh") {
            for (const std::string &line : shellLines(block)) {
                if (!line.starts_with(program))
                    continue;
                const Outcome outcome = run(withSize(line.substr(program.size())));
                EXPECT_EQ(outcome.exitCode, 0) << line << '\n' << outcome;
            }
        }
    }
}

TEST_P(EveryDocument, HasLinksThatLeadSomewhere) {
    for (const std::string &link : matchesIn(document, R"(\]\(([^)\s]+)\))")) {
        if (link.find("://") != std::string::npos)
            continue;
        const std::size_t hash = std::min(link.find('#'), link.size());
        const std::filesystem::path file =
            hash == 0 ? source / GetParam() : (source / GetParam()).parent_path() / link.substr(0, hash);
        ASSERT_TRUE(std::filesystem::exists(file)) << GetParam() << " links to " << link;
        if (hash != link.size()) {
            EXPECT_TRUE(anchorsOf(readDocument(file)).contains(link.substr(hash + 1)))
                << GetParam() << " links to " << link << ": no heading has this anchor";
        }
    }
}

TEST_P(EveryDocument, NamesFilesThatExist) {
    // Paths in code spans that begin with a folder of the house. Patterns such as host/*.cpp are none, and NAME and
    // FOLDER stand for what a reader chooses.
    for (const std::string &path :
         matchesIn(document, R"(`((?:host|shaders|tests|assets|cmake)/[A-Za-z0-9_./-]*)[` #:])"))
        if (!contains(path, "NAME") && !contains(path, "FOLDER")) {
            EXPECT_TRUE(std::filesystem::exists(source / path)) << GetParam() << " names " << path;
        }
}

TEST_P(EveryDocument, HasLinesThatFitAnEditor) {
    for (const Document::Line &line : document.lines) {
        if (line.isInBlock || line.text.starts_with('|'))
            continue;
        const auto columns = std::ranges::count_if(
            line.text, [](char letter) { return (static_cast<unsigned char>(letter) & 0xC0) != 0x80; });
        EXPECT_LE(columns, 125) << GetParam() << ": " << line.text;
    }
}

INSTANTIATE_TEST_SUITE_P(Documents, EveryDocument, ::testing::ValuesIn(documents()), [](const auto &tested) {
    std::string name = tested.param;
    std::ranges::replace_if(
        name, [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
    return name;
});

/// The keys of all objects that a JSON schema describes.
void collectKeys(const nlohmann::json &schema, std::set<std::string> &keys) {
    if (schema.is_object() && schema.contains("properties"))
        for (const auto &[key, value] : schema.at("properties").items())
            keys.insert(key);
    for (const nlohmann::json &part : schema)
        if (part.is_structured())
            collectKeys(part, keys);
}

TEST(SceneFormat, IsDocumentedKeyByKey) {
    std::ifstream file(source / "assets/hyalite-scene.schema.json");
    std::set<std::string> keys;
    collectKeys(nlohmann::json::parse(file), keys);
    EXPECT_GE(keys.size(), 60u);
    for (const Document::Line &line : readDocument(source / "assets/README.md").lines)
        if (line.text.starts_with("| `"))
            std::erase_if(keys, [cell = line.text.substr(0, line.text.find('|', 1))](const std::string &key) {
                return contains(cell, "`" + key + "`");
            });
    for (const std::string &key : keys)
        ADD_FAILURE() << "assets/README.md has no row for " << key;
}

struct Readme : CommandLine {
    const Document document = readDocument(source / "README.md");
};

TEST_F(Readme, IsShort) { EXPECT_LE(document.lines.size(), 160u); }

TEST_F(Readme, HasCommandsForItsThreeJobs) {
    std::set<std::string> commands;
    for (const Document::Block &block : document.blocks)
        if (block.opening == "sh")
            for (const std::string &line : shellLines(block))
                if (line.starts_with("hyalite "))
                    commands.insert(splitWords(line).at(1));
    for (const char *job : {"render", "compare", "profile"})
        EXPECT_TRUE(commands.contains(job)) << job;
}

TEST_F(Readme, GivesTheScriptAWordOfItsOwnOrACommand) {
    // The script's own words; every other word goes to the program.
    const std::set<std::string> ownWords{"showcase",  "test",  "test-all", "test-drivers",
                                         "test-view", "build", "bench",    "sanitize",
                                         "check",     "fuzz",  "archive",  "test-archive"};
    const std::string help = run("--help").output;
    int callCount = 0;
    for (const std::string &file : documents())
        for (const Document::Block &block : readDocument(source / file).blocks) {
            if (!block.opening.starts_with("sh"))
                continue;
            for (const std::string &line : shellLines(block)) {
                if (!line.starts_with("cmake/run.sh "))
                    continue;
                ++callCount;
                const std::string word = splitWords(line).at(1);
                EXPECT_TRUE(ownWords.contains(word) || contains(help, "\n  " + word + " "))
                    << file << ": " << line;
            }
        }
    EXPECT_GE(callCount, 2) << "the two commands that a newcomer needs";
}

} // namespace
} // namespace hyalite::core::testing
