// Cryptomattes of tallies.
#include "host/jobs/cryptomatte.h"

#include "host/base/hash.h"
#include "host/film/tally.h"
#include "host/jobs/layers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <map>

namespace hyalite::core {
namespace {

float idOf(std::string_view name) { return std::bit_cast<float>(matteIdOf(name)); }

/// Of one pixel, which shows these numbers.
ViewFilm matteOf(const std::vector<std::uint32_t> &samples, std::vector<std::string> names) {
    ViewFilm film{Integrator::ObjectMatte, Film({0, 1, 0, 1}), std::move(names)};
    for (const std::uint32_t number : samples)
        tallySample(film.film.pixels[0], number);
    return film;
}

/// The values of all layers.
std::vector<float> ranksOf(const ViewFilm &film) {
    std::vector<float> values;
    for (const Layer &layer : matteLayers(film)) {
        EXPECT_EQ(layer.channels, "rgba");
        std::vector<float> row(4);
        layer.fillRow(0, row);
        values.insert(values.end(), row.begin(), row.end());
    }
    return values;
}

// As other programs have them: the first three are of the tests of Psyop's own programs.
TEST(MatteIds, AreThoseOfOtherPrograms) {
    EXPECT_FLOAT_EQ(idOf("cube"), -4.08461912519e+15f);
    EXPECT_FLOAT_EQ(idOf("sphere"), 2.79018604383e+15f);
    EXPECT_FLOAT_EQ(idOf("plane"), 3.66557617593e-11f);
}

TEST(MatteIds, AreNormalFloats) {
    int flipped = 0;
    for (int i = 0; i < 5000; ++i) {
        const std::string name = "name " + std::to_string(i);
        EXPECT_TRUE(std::isnormal(idOf(name))) << name;
        flipped += matteIdOf(name) != murmurHash3(name);
    }
    EXPECT_GT(flipped, 10) << "no name tested the rule";
}

TEST(Mattes, AreRankedByCoverage) {
    const std::vector<std::string> names{"cube", "sphere", "plane"};
    const std::vector<float> ranks = ranksOf(matteOf({3, 1, 2, 2, 0, 1, 2, 0}, names));
    EXPECT_EQ(ranks, (std::vector<float>{idOf("sphere"), 0.375f, idOf("cube"), 0.25f, idOf("plane"), 0.125f,
                                         0, 0, 0, 0, 0, 0}));
}

TEST(Mattes, OfEqualCoverageAreRankedById) {
    const std::vector<std::string> names{"cube", "sphere", "plane"};
    EXPECT_EQ(ranksOf(matteOf({1, 2, 3}, names)), ranksOf(matteOf({3, 2, 1}, names)));
}

TEST(Mattes, OfOneIdAreOne) {
    const std::vector<float> ranks = ranksOf(matteOf({1, 3, 2, 2}, {"cube", "sphere", "cube"}));
    EXPECT_EQ(ranks[1], 0.5f);
    EXPECT_EQ(ranks[3], 0.5f);
    EXPECT_EQ(ranks[5], 0.0f);
}

TEST(Mattes, OfNothingAreZero) {
    EXPECT_EQ(ranksOf(matteOf({}, {})), std::vector<float>(12));
    EXPECT_EQ(ranksOf(matteOf({0, 0}, {"cube"})), std::vector<float>(12));
}

TEST(Mattes, KeepTheSixLargestOfAPixel) {
    std::vector<std::uint32_t> samples;
    for (std::uint32_t number = 1; number <= 7; ++number)
        samples.insert(samples.end(), number == 1 ? 1 : 2, number);
    const std::vector<float> ranks = ranksOf(matteOf(samples, {"a", "b", "c", "d", "e", "f", "g"}));
    for (std::size_t rank = 0; rank < matteRankCount; ++rank) {
        EXPECT_EQ(ranks[2 * rank + 1], static_cast<float>(2.0 / 13.0));
        EXPECT_NE(ranks[2 * rank], idOf("a")) << "the smallest is dropped";
    }
}

TEST(Mattes, SayTheirNames) {
    const std::vector<std::string> names{"cube", "a \"quoted\"\n\\ name", "Käse"};
    std::map<std::string, std::string> attributes;
    for (const auto &[name, text] : matteAttributes(matteOf({}, names)))
        attributes[name] = text;
    // The key is that of other programs: the first seven digits of the id of the layer's name.
    const std::string key = "cryptomatte/" + fmt::format("{:08x}", matteIdOf("CryptoObject")).substr(0, 7);
    EXPECT_EQ(attributes[key + "/name"], "CryptoObject");
    EXPECT_EQ(attributes[key + "/hash"], "MurmurHash3_32");
    EXPECT_EQ(attributes[key + "/conversion"], "uint32_to_float32");
    const nlohmann::json manifest = nlohmann::json::parse(attributes[key + "/manifest"]);
    EXPECT_EQ(manifest.size(), 3u);
    for (const std::string &name : names)
        EXPECT_EQ(manifest.at(name), fmt::format("{:08x}", matteIdOf(name)));
    EXPECT_EQ(attributes.size(), 4u);
}

TEST(Layers, OfNumbersSayTheirNames) {
    std::vector<ViewFilm> films;
    films.push_back({Integrator::ObjectNumber, Film({0, 1, 0, 1}), {"cube", "plane"}});
    const std::vector<Attribute> attributes = viewAttributes(films);
    ASSERT_EQ(attributes.size(), 1u);
    EXPECT_EQ(attributes[0], (Attribute{"object-id.names", R"({"1":"cube","2":"plane"})"}));
}

} // namespace
} // namespace hyalite::core
