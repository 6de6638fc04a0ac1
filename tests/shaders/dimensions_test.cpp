// The table of random dimensions, shaders/math/dimensions.glsl.
#include "tests/fixtures/leaves.h"
#include "tests/house/source_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::textOf;

void expectDistinct(const std::vector<uint> &pairs) {
    EXPECT_EQ(std::set<uint>(pairs.begin(), pairs.end()).size(), pairs.size());
    const auto words = [](const uvec3 &keys) { return std::array{keys.x, keys.y, keys.z}; };
    std::set<std::array<uint, 3>> keys;
    for (const uint pair : pairs)
        keys.insert(words(pairKeys({17, 4}, 99, pair)));
    EXPECT_EQ(keys.size(), pairs.size());
}

TEST(Dimensions, OfAPathDoNotOverlap) {
    std::vector<uint> pairs{pixelPair, wavelengthPair, lensPair, alphaTestPair};
    for (uint depth = 1; depth <= maxPathDepth; ++depth) {
        for (const uint pair : {pairChoice, pairLight, pairScatter})
            pairs.push_back(vertexPair(depth, pair));
        pairs.push_back(lobePair(depth));
    }
    EXPECT_EQ(pairs.size(), 4 + (pairsPerVertex + 1) * maxPathDepth);
    expectDistinct(pairs);
}

TEST(Dimensions, OfAViewDoNotOverlap) { expectDistinct({pixelPair, lensPair, alphaTestPair, occlusionPair}); }

TEST(Dimensions, AreInTheirTable) {
    const std::string table =
        textOf(std::filesystem::path(HYALITE_SOURCE_DIR) / "shaders/math/dimensions.glsl");
    const auto hasRow = [&](const std::string &pairs, const std::string &name) {
        return std::regex_search(table, std::regex("// \\| " + pairs + " *\\| " + name + "\\b"));
    };
    const auto span = [](uint first, uint last) { return fmt::format("{} to {}", first, last); };
    EXPECT_TRUE(hasRow(std::to_string(pixelPair), "pixelPair"));
    EXPECT_TRUE(hasRow(std::to_string(occlusionPair), "occlusionPair"));
    EXPECT_TRUE(hasRow(span(vertexPair(1, pairChoice), vertexPair(maxPathDepth, pairScatter)), "vertexPair"));
    EXPECT_TRUE(hasRow(span(lobePair(1), lobePair(maxPathDepth)), "lobePair"));
    EXPECT_TRUE(hasRow(std::to_string(wavelengthPair), "wavelengthPair"));
    EXPECT_TRUE(hasRow(std::to_string(lensPair), "lensPair"));
    EXPECT_TRUE(hasRow(std::to_string(alphaTestPair), "alphaTestPair"));
}

TEST(Dimensions, AreNumberedNowhereElse) {
    // The last argument of pairKeys(PIXEL, SEED, PAIR) is a name.
    const std::regex numbered(R"(pairKeys\([^;{]*, *(0x)?[0-9]+u?\))");
    int callCount = 0;
    for (const char *folder : {"shaders", "host"})
        for (const auto &entry : std::filesystem::recursive_directory_iterator(
                 std::filesystem::path(HYALITE_SOURCE_DIR) / folder)) {
            if (!entry.is_regular_file())
                continue;
            const std::string text = textOf(entry.path());
            callCount += text.find("pairKeys(") != std::string::npos ? 1 : 0;
            EXPECT_FALSE(std::regex_search(text, numbered)) << entry.path();
        }
    EXPECT_GE(callCount, 6);
}

} // namespace
} // namespace hyalite::core::reference
