// Each leaf function on the device against its twin in C++: the same bits for the same input.
#include "tests/fixtures/subnormals.h"
#include "tests/fixtures/test_extent.h"
#include "tests/kernels/leaf_inputs.h"
#include "tests/kernels/probe_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

/// Words of results that are the same for all inputs, by their nature; of others, inputs must say more.
const std::map<std::string, std::vector<std::size_t>> constantResults{
    {"noIridescence", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
    {"filmOnOpaque", {10}},       // not seen from within
    {"filmOnGlass", {3}},         // no metal
    {"sphereSurface", {3, 4, 5}}, // no error
    {"alongView", {3, 4, 5}},     // one direction
    {"allAround", {0, 1, 2}},     // the eye
    {"makeGlass", {12}},          // the kind
    {"makeSheen", {12}},
    {"makeClearcoat", {25, 26, 27, 50}}, // the coat's reflectance, and the probability of a facet
    {"makeCoatOf", {25, 26, 27, 50}},
    {"evalSheen", {3}},         // uniform
    {"sphereTangent", {1}},     // alongU is level
    {"hitNormals", {3, 7, 11}}, // padding
    {"environmentRow", {1, 2}}, // likewise
    {"samplePoint", {7, 8}},    // no pdf, no target
    {"sampleSpot", {7, 8}},
    {"sampleProfiled", {7, 8}},
    {"sampleDirectional", {3, 7, 8}}, // and no distance
    {"sampleEnvironmentLight", {3, 8}},
    // Of materials with textures of the scene: tints, absorption and metals, which those do not have, and padding.
    {"texturedMaterial", {4, 5, 6, 12, 13, 14, 16, 17, 18, 20, 21, 22, 24, 25, 26, 45, 46}},
};

/// Leaves whose zeros may have either sign: lavapipe takes 0 + x for x where the 0 is written in the shader, also if x is
/// -0. Nothing asks for the sign of these.
const std::set<std::string> withZerosOfEitherSign{"sphereTangent", "hitTangent", "hitNormal"};

/// Of how many inputs a word of the results is positive: hits, and total reflection.
struct ShareRow {
    std::size_t word;
    double least;
    double most;
};
const std::map<std::string, ShareRow> shares{
    {"intersectTriangle", {0, 0.125, 0.875}}, {"intersectPair", {0, 0.125, 0.875}},
    {"intersectSphere", {0, 0.125, 0.875}},   {"intersectBoxedSphere", {0, 0.125, 0.875}},
    {"refractRay", {5, 0.0625, 0.875}},       {"isPassed", {0, 0.125, 0.875}},
};

/// Inputs of a leaf in a scene, and what the twin makes of them.
struct Expected {
    std::size_t inputWords = 0;
    std::size_t outputWords = 0;
    std::vector<std::uint32_t> inputs;
    std::vector<Words::Word> results;
    std::vector<bool> isCompared; ///< of each input: subnormal numbers do not matter
};

std::vector<Words::Word> resultsOf(const LeafProbe &probe, const LeafScene &scene, std::size_t count,
                                   const Expected &of) {
    Words results;
    for (std::size_t i = 0; i < count; ++i) {
        WordReader in(of.inputs.data() + i * of.inputWords);
        probe.call(scene.view, in, results);
    }
    return results.get();
}

Expected expectedOf(const LeafProbe &probe, const LeafScene &scene, std::size_t count) {
    Expected made;
    Words inputs;
    LeafInputs draws(probe, scene);
    for (std::size_t i = 0; i < count; ++i)
        draws.draw(inputs);
    for (const Words::Word &word : inputs.get())
        made.inputs.push_back(word.bits);
    made.inputWords = made.inputs.size() / count;
    made.results = resultsOf(probe, scene, count, made);
    made.outputWords = made.results.size() / count;
    const std::vector<Words::Word> flushed =
        withSubnormalsFlushed([&] { return resultsOf(probe, scene, count, made); });
    made.isCompared.assign(count, true);
    for (std::size_t i = 0; i < flushed.size(); ++i)
        if (!isSame(made.results[i], flushed[i].bits))
            made.isCompared[i / made.outputWords] = false;
    return made;
}

bool isEqual(const LeafProbe &probe, const Words::Word &expected, std::uint32_t bits) {
    const bool areZeros = expected.isFloat && ((expected.bits | bits) & 0x7FFFFFFFu) == 0;
    return isSame(expected, bits) || (areZeros && withZerosOfEitherSign.contains(probe.name));
}

double shareOfPositive(const Expected &expected, std::size_t word) {
    std::size_t count = 0;
    std::size_t inputCount = 0;
    for (std::size_t i = word; i < expected.results.size(); i += expected.outputWords, ++inputCount)
        count += std::bit_cast<float>(expected.results[i].bits) > 0.0f ? 1u : 0u;
    return static_cast<double>(count) / static_cast<double>(inputCount);
}

/// How the device's results differ from those of the twin; empty if they do not.
std::string difference(std::size_t index, const LeafScene &scene, const Expected &expected,
                       gpu::Arithmetic arithmetic) {
    const LeafProbe &probe = leafProbes()[index];
    Probe kernel(static_cast<std::uint32_t>(index), expected.inputWords, expected.outputWords, arithmetic,
                 &scene.view, expected.isCompared.size());
    const std::vector<std::uint32_t> results = kernel.run(expected.inputs);
    std::set<std::size_t> wrong; // inputs
    std::string first;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const std::size_t input = i / expected.outputWords;
        if (!expected.isCompared[input] || isEqual(probe, expected.results[i], results[i]))
            continue;
        if (wrong.empty())
            first = fmt::format(
                "input {} of seed {}:{}\nword {}: the host has{}, the device{}", input, Draw::seed,
                describeWords(&expected.inputs[input * expected.inputWords], expected.inputWords),
                i % expected.outputWords, describeWords(&expected.results[i].bits, 1),
                describeWords(&results[i], 1));
        wrong.insert(input);
    }
    return wrong.empty()
               ? ""
               : fmt::format("{} of {} inputs, {}", wrong.size(), expected.isCompared.size(), first);
}

/// Leaves that read more words of the scene are made of others, which are tested in all scenes, and take a driver long.
constexpr std::size_t maxWordsInAllScenes = 2;

/// The scenes that a leaf can tell apart.
std::vector<const LeafScene *> scenesOf(const LeafProbe &probe) {
    std::vector<const LeafScene *> scenes;
    for (const LeafScene &scene : leafScenes())
        if (std::ranges::all_of(scenes, [&](auto other) { return differs(probe.sceneWords, *other, scene); }))
            scenes.push_back(&scene);
    if (probe.sceneWords.size() > maxWordsInAllScenes && !isTestingAll())
        scenes.resize(1);
    return scenes;
}

/// The arithmetic of renders; of leaves that read no scene, the other one as well where a device has both.
std::vector<gpu::Arithmetic> arithmeticsOf(const LeafProbe &probe) {
    if (!isDivisionNative())
        return {gpu::Arithmetic::Own};
    if (probe.divides && (probe.sceneWords.empty() || isTestingAll()))
        return {gpu::Arithmetic::Native, gpu::Arithmetic::Own};
    return {gpu::Arithmetic::Native};
}

void expectTwin(std::size_t index) {
    const LeafProbe &probe = leafProbes()[index];
    const std::size_t count = isTestingAll() ? probeInputCount : 4096;
    std::vector<std::set<std::uint32_t>> values; // of each word of the results, two at most
    for (const LeafScene *scene : scenesOf(probe)) {
        const Expected expected = expectedOf(probe, *scene, count);
        EXPECT_GE(std::ranges::count(expected.isCompared, true), static_cast<std::ptrdiff_t>(count * 4 / 5))
            << "subnormal numbers decide the others";
        values.resize(expected.outputWords);
        for (std::size_t i = 0; i < expected.results.size(); ++i)
            if (expected.isCompared[i / expected.outputWords] && values[i % expected.outputWords].size() < 2)
                values[i % expected.outputWords].insert(expected.results[i].bits);
        if (const auto row = shares.find(probe.name); row != shares.end() && scene == &leafScenes().front()) {
            const double share = shareOfPositive(expected, row->second.word);
            EXPECT_TRUE(share >= row->second.least && share <= row->second.most)
                << "word " << row->second.word << " is positive for " << share << " of the inputs";
        }
        for (const gpu::Arithmetic arithmetic : arithmeticsOf(probe))
            EXPECT_EQ(difference(index, *scene, expected, arithmetic), "")
                << "scene '" << scene->name << "', "
                << (arithmetic == gpu::Arithmetic::Native ? "native" : "own") << " / and sqrt";
    }
    std::vector<std::size_t> constant;
    for (std::size_t word = 0; word < values.size(); ++word)
        if (values[word].size() < 2)
            constant.push_back(word);
    const auto row = constantResults.find(probe.name);
    EXPECT_EQ(constant, row != constantResults.end() ? row->second : std::vector<std::size_t>{})
        << "words of the results that are the same for all inputs";
}

/// Indices of the leaves that read the scene, or of the others.
std::vector<std::size_t> leavesThatRead(bool readTheScene) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < leafProbes().size(); ++i)
        if (leafProbes()[i].sceneWords.empty() != readTheScene)
            indices.push_back(i);
    return indices;
}

std::string nameOf(const ::testing::TestParamInfo<std::size_t> &instance) {
    const std::vector<LeafProbe> &probes = leafProbes();
    const LeafProbe &probe = probes[instance.param];
    const auto isOverload = [&](const LeafProbe &other) { return other.name == probe.name; };
    const auto before = std::count_if(probes.data(), &probe, isOverload);
    return std::filesystem::path(probe.file).stem().string() + "_" + probe.name +
           (before > 0 ? fmt::format("_{}", before + 1) : "");
}

class LeafTwins : public ::testing::TestWithParam<std::size_t> {};

TEST_P(LeafTwins, HaveTheSameBits) { expectTwin(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, LeafTwins, ::testing::ValuesIn(leavesThatRead(false)), nameOf);

class SceneLeafTwins : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SceneLeafTwins, HaveTheSameBits) { expectTwin(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, SceneLeafTwins, ::testing::ValuesIn(leavesThatRead(true)), nameOf);

// ---- No leaf is left out

/// Names of the functions that a file and those that it includes define, by another reader than that of the build tools:
/// lines that begin with a type, a name and a bracket.
void addFunctions(const std::string &path, std::multiset<std::string> &names) {
    static const std::regex function("(?:HYALITE_INLINE )?\\w+ (\\w+)\\(.*");
    static const std::regex include("#include \"(shaders/.*)\"");
    std::ifstream file(HYALITE_SOURCE_DIR "/" + path);
    ASSERT_TRUE(file) << path;
    std::smatch match;
    for (std::string line; std::getline(file, line);)
        if (std::regex_match(line, match, function))
            names.insert(match[1]);
        else if (std::regex_match(line, match, include))
            addFunctions(match[1], names);
}

TEST(LeafProbes, AreThereForAllLeaves) {
    std::multiset<std::string> functions;
    addFunctions("shaders/layout/layout.h", functions);
    addFunctions("shaders/leaves.glsl", functions);
    std::multiset<std::string> probed;
    for (const LeafProbe &probe : leafProbes())
        probed.insert(probe.name);
    EXPECT_EQ(probed, functions);
    EXPECT_GT(functions.size(), 300u);
}

TEST(LeafInputs, AreDrawnByRowsThatParametersBear) {
    EXPECT_EQ(unusedInputRows(), std::vector<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
