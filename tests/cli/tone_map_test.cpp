// `tonemap`, and `render --tone`.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

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
