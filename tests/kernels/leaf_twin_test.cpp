// Each leaf function on the device against its twin in C++: the same bits for the same input.
#include "tests/fixtures/subnormals.h"
#include "tests/fixtures/test_extent.h"
#include "tests/kernels/leaf_inputs.h"
#include "tests/kernels/probe_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

/// Words of results that are the same for all inputs, by their nature; of others, inputs must say more.
const std::map<std::string, std::vector<std::size_t>> constantResults{
    {"sphereSurface", {3, 4, 5}}, // no error
    {"alongView", {3, 4, 5}},     // one direction
    {"allAround", {0, 1, 2}},     // the eye
    {"makeGlass", {12}},          // the kind
    {"makeSheen", {12}},
    {"makeClearcoat", {25, 26, 27, 46}}, // the coat's reflectance, and the probability of a facet
    {"makeCoatOf", {25, 26, 27, 46}},
    {"evalSheen", {3}},         // uniform
    {"sphereTangent", {1}},     // alongU is level
    {"hitNormals", {3, 7, 11}}, // padding
    {"environmentRow", {1, 2}}, // likewise
    {"samplePoint", {7, 8}},    // no pdf, no target
    {"sampleSpot", {7, 8}},
    {"sampleDirectional", {3, 7, 8}}, // and no distance
    {"sampleEnvironmentLight", {3, 8}},
    // Of materials with textures of the scene: tints, absorption and metals, which those do not have, and padding.
    {"texturedMaterial", {4, 5, 6, 12, 13, 14, 16, 17, 18, 20, 21, 22, 24, 25, 26, 45, 46, 47}},
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

std::string nameOf(std::size_t index) {
    const LeafProbe &probe = leafProbes()[index];
    const auto overloads =
        std::count_if(leafProbes().begin(), leafProbes().begin() + static_cast<std::ptrdiff_t>(index),
                      [&](const LeafProbe &other) { return other.name == probe.name; });
    return std::filesystem::path(probe.file).stem().string() + "_" + probe.name +
           (overloads > 0 ? fmt::format("_{}", overloads + 1) : "");
}

class LeafTwins : public ::testing::TestWithParam<std::size_t> {};

TEST_P(LeafTwins, HaveTheSameBits) {
    const LeafProbe &probe = leafProbes()[GetParam()];
    const std::size_t count = isTestingAll() ? probeInputCount : 4096;
    std::size_t sceneCount = 0;
    std::vector<std::set<std::uint32_t>> values; // of each word of the results, two at most
    for (const LeafScene &scene : leafScenes()) {
        const bool isNew = std::all_of(leafScenes().data(), &scene, [&](const LeafScene &other) {
            return differs(probe.sceneWords, other, scene);
        });
        if (!isNew)
            continue;
        ++sceneCount;
        const Expected expected = expectedOf(probe, scene, count);
        const auto comparedCount = static_cast<std::size_t>(std::ranges::count(expected.isCompared, true));
        EXPECT_GE(comparedCount * 10, count * 8) << "subnormal numbers decide the others";
        if (const auto row = shares.find(probe.name); row != shares.end() && sceneCount == 1) {
            const double share = shareOfPositive(expected, row->second.word);
            EXPECT_TRUE(share >= row->second.least && share <= row->second.most)
                << "word " << row->second.word << " is positive for " << share << " of the inputs";
        }
        values.resize(expected.outputWords);
        for (std::size_t i = 0; i < expected.results.size(); ++i)
            if (expected.isCompared[i / expected.outputWords] && values[i % expected.outputWords].size() < 2)
                values[i % expected.outputWords].insert(expected.results[i].bits);
        for (const gpu::Arithmetic arithmetic : {gpu::Arithmetic::Own, gpu::Arithmetic::Native}) {
            // The arithmetic of renders, and where the device has a choice, of leaves without a scene both.
            const bool isWanted = (arithmetic == gpu::Arithmetic::Native) == isDivisionNative();
            const bool isChosenToo =
                isDivisionNative() && probe.divides && (probe.sceneWords.empty() || isTestingAll());
            if (!isWanted && !isChosenToo)
                continue;
            Probe kernel(static_cast<std::uint32_t>(GetParam()), expected.inputWords, expected.outputWords,
                         arithmetic, &scene.view, count);
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
            EXPECT_EQ(wrong.size(), 0u)
                << "scene '" << scene.name << "', "
                << (arithmetic == gpu::Arithmetic::Native ? "native" : "own") << " / and sqrt\n"
                << first;
        }
    }
    std::vector<std::size_t> constant;
    for (std::size_t word = 0; word < values.size(); ++word)
        if (values[word].size() < 2)
            constant.push_back(word);
    const auto row = constantResults.find(probe.name);
    EXPECT_EQ(constant, row != constantResults.end() ? row->second : std::vector<std::size_t>{})
        << "words of the results that are the same for all inputs";
}

INSTANTIATE_TEST_SUITE_P(All, LeafTwins, ::testing::Range(std::size_t{0}, leafProbes().size()),
                         [](const auto &instance) { return nameOf(instance.param); });

TEST(LeafInputs, AreDrawnByRowsThatParametersBear) {
    EXPECT_EQ(unusedInputRows(), std::vector<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
