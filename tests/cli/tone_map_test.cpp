// `tonemap`, and `render --tone`.
#include "host/base/input_file.h"
#include "host/image/exr.h"
#include "host/image/false_colour.h"
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

using ToneMapping = CommandLine;

const std::string smallMapped = " --width 24 --height 18 --spp 2 --device cpu --quiet";

TEST_F(ToneMapping, MakesThePixelsThatRenderMakes) {
    ASSERT_EQ(run("render spheres -o a.exr" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("render spheres -o a.pfm" + smallMapped).exitCode, 0);
    std::set<std::vector<float>> seen;
    for (const char *options : {"", " --tone gamma", " --tone srgb", " --tone aces", " --tone agx",
                                " --exposure 1.5", " --exposure -2 --tone agx"}) {
        ASSERT_EQ(run("render spheres -o rendered.png" + smallMapped + options).exitCode, 0) << options;
        const Image rendered = readImage(folder / "rendered.png").image;
        for (const char *input : {"a.exr", "a.pfm"}) {
            const Outcome outcome = run("tonemap " + std::string(input) + " mapped.png" + options);
            ASSERT_EQ(outcome.exitCode, 0) << outcome;
            EXPECT_EQ(outcome.output, "");
            EXPECT_EQ(readImage(folder / "mapped.png").image.pixels(), rendered.pixels()) << options;
        }
        const float *begin = &rendered.pixels().front().x;
        seen.insert(std::vector<float>(begin, begin + 3 * rendered.pixels().size()));
    }
    EXPECT_EQ(seen.size(), 6u); // the default is gamma
}

TEST_F(ToneMapping, ReadsHdr) {
    ASSERT_EQ(run("render spheres -o a.hdr" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("render spheres -o a.png" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("tonemap a.hdr b.png").exitCode, 0);
    const Image a = readImage(folder / "a.png").image;
    const Image b = readImage(folder / "b.png").image;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(a.pixels()[i][channel], b.pixels()[i][channel],
                        0.06f); // dark channels beside bright ones
}

TEST_F(ToneMapping, ALayerOfColoursIsMappedAndOneOfNumbersGetsFalseColours) {
    ASSERT_EQ(run("render spheres -o a.exr --layers albedo,depth,normal" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("render spheres -o albedo.pfm --integrator albedo" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("tonemap albedo.pfm albedo.png --exposure 1").exitCode, 0);
    ASSERT_EQ(run("tonemap a.exr b.png --layer albedo --exposure 1").exitCode, 0);
    EXPECT_EQ(readImage(folder / "b.png").image.pixels(), readImage(folder / "albedo.png").image.pixels());
    for (const std::string layer : {"depth", "Z", "samples"}) {
        const Outcome outcome = run("tonemap a.exr " + layer + ".png --layer " + layer);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        const InputFile file(folder / "a.exr");
        std::vector<float> numbers;
        const Image values = readExr(file, layer);
        for (const glm::vec3 &pixel : values.pixels())
            numbers.push_back(pixel.x);
        const Drawing wanted = falseColours(24, 18, numbers, layer);
        const Image drawn = readImage(folder / (layer + ".png")).image;
        ASSERT_EQ(drawn.width(), wanted.width);
        ASSERT_EQ(drawn.height(), wanted.height);
        for (std::size_t i = 0; i < wanted.rgb.size(); ++i)
            ASSERT_EQ(std::lround(drawn.pixels()[i / 3][static_cast<int>(i % 3)] * 255.0f), wanted.rgb[i]);
    }
    ASSERT_EQ(run("tonemap a.exr normal.png --layer normal").exitCode, 0);
    EXPECT_EQ(readImage(folder / "normal.png").image.height(), 18) << "three values: no legend";
    expectFailure("tonemap a.exr b.png --layer heat", 3, {"heat", "albedo"});
    expectFailure("tonemap a.exr b.png --layer samples --tone agx", 2, {"--tone", "samples"});
    expectFailure("tonemap a.exr b.png --layer samples --exposure 1", 2, {"--exposure", "samples"});
    expectFailure("tonemap albedo.pfm b.png --layer samples", 3, {"albedo.pfm", "no layers"});
}

TEST_F(ToneMapping, WhatCannotBeMappedIsRefused) {
    ASSERT_EQ(run("render spheres -o a.pfm" + smallMapped).exitCode, 0);
    ASSERT_EQ(run("render spheres -o a.png" + smallMapped).exitCode, 0);
    expectFailure("tonemap a.png b.png", 3, {"a.png", "tone-mapped already"});
    expectFailure("tonemap a.pfm b.exr", 2, {"b.exr", ".png"});
    expectFailure("tonemap a.pfm b.jpg", 2, {"b.jpg", ".png"});
    expectFailure("tonemap missing.pfm b.png", 3, {"missing.pfm"});
    expectFailure("tonemap a.pfm b.png --tone film", 2, {"--tone", "\"film\"", "aces"});
    expectFailure("tonemap a.pfm b.png --exposure nan", 2, {"--exposure"});
    expectFailure("tonemap a.pfm missing/b.png", 7, {"missing/b.png"});
    expectFailure("tonemap a.pfm", 2, {"OUT"});
    EXPECT_EQ(entries(), (std::set<std::string>{"a.pfm", "a.png"}));
}

} // namespace
} // namespace hyalite::core::testing
