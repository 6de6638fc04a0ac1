// Standard input and output in the place of files: `render - -o -`.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

using StandardStreams = CommandLine;

const std::string small = " --width 24 --height 18 --spp 2 --device cpu";

Surroundings reading(const std::string &file) {
    Surroundings surroundings;
    surroundings.input = file;
    return surroundings;
}

Surroundings writingTo(Stream output) {
    Surroundings surroundings;
    surroundings.output = output;
    return surroundings;
}

TEST_F(StandardStreams, PictureGoesToStandardOutput) {
    for (const std::string format : {"png", "exr", "hdr", "pfm"}) {
        // The command line is in PNG and EXR, and so the pixels are compared.
        ASSERT_EQ(run("render spheres --quiet -o a." + format + small).exitCode, 0);
        const Outcome outcome = run("render spheres -o " + format + ":-" + small);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        store("b." + format, outcome.output);
        EXPECT_EQ(readImage(folder / ("b." + format)).image.pixels(),
                  readImage(folder / ("a." + format)).image.pixels())
            << format;
        EXPECT_TRUE(contains(outcome.errors, "24x18, 2 spp")) << outcome; // what is a result elsewhere
    }
    const Outcome plain = run("render spheres --quiet -o -" + small);
    store("c.png", plain.output);
    EXPECT_EQ(readImage(folder / "c.png").image.pixels(), readImage(folder / "b.png").image.pixels());
    EXPECT_EQ(plain.errors, "");
}

TEST_F(StandardStreams, ReportGoesToStandardOutput) {
    const Outcome outcome = run("render spheres --report - -o a.png" + small);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(nlohmann::json::parse(outcome.output).at("settings").at("spp"), 2);
}

TEST_F(StandardStreams, PictureComesFromStandardInput) {
    ASSERT_EQ(run("render spheres --quiet -o a.exr" + small).exitCode, 0);
    ASSERT_EQ(run("render spheres --quiet -o a.png" + small).exitCode, 0);
    const Outcome outcome = runIn(reading("a.exr"), "tonemap - -");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    store("b.png", outcome.output);
    EXPECT_EQ(readImage(folder / "b.png").image.pixels(), readImage(folder / "a.png").image.pixels());
    EXPECT_EQ(runIn(reading("a.png"), "diff - b.png").exitCode, 0);
}

const std::string trianglePly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
    "end_header\n-1 -1 0\n1 -1 0\n0 1 0\n3 0 1 2\n";
const std::string textStl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 1 -1 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
const std::string triangleGltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

/// One triangle of zeros would be no mesh: its corners differ.
std::string binaryStl() {
    std::string bytes(84 + 50, '\0');
    bytes[80] = 1;
    const auto place = [&](std::size_t corner, std::size_t axis) {
        bytes.replace(84 + 12 + 12 * corner + 4 * axis, 4, std::string("\0\0\x80\x3f", 4)); // 1.0f
    };
    place(1, 0);
    place(2, 1);
    return bytes;
}

/// The same JSON, padded, as the only chunk of a .glb.
std::string glbOf(std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        return std::string{static_cast<char>(value & 255), static_cast<char>(value >> 8 & 255), 0, 0};
    };
    return "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
}

TEST_F(StandardStreams, SceneOfAnyFormatComesFromStandardInput) {
    store("square.obj", squareObj());
    const std::pair<std::string, std::string> files[] = {
        {"a.json", squareScene()},     {"a.obj", squareObj()},
        {"a.ply", trianglePly},        {"a.stl", textStl},
        {"b.stl", binaryStl()},        {"a.gltf", triangleGltf},
        {"a.glb", glbOf(triangleGltf)}};
    for (const auto &[name, contents] : files) {
        store(name, contents);
        const Image wanted = renderImage(name + small);
        const Outcome outcome = runIn(reading(name), "render - --quiet -o b.pfm" + small);
        ASSERT_EQ(outcome.exitCode, 0) << name << outcome;
        EXPECT_EQ(readImage(folder / "b.pfm").image.pixels(), wanted.pixels()) << name;
        EXPECT_GT(litPixelCount(wanted), 0) << name;
    }
}

TEST_F(StandardStreams, FileOfTheirNameStaysWithinReach) {
    ASSERT_EQ(run("render spheres --quiet -o ./-.png" + small).exitCode, 0);
    EXPECT_TRUE(entries().contains("-.png"));
    ASSERT_EQ(run("render spheres --quiet --report ./- -o a.png" + small).exitCode, 0);
    EXPECT_TRUE(entries().contains("-"));
}

TEST_F(StandardStreams, WhatTheyCannotDoIsRefused) {
    expectFailure("render - -o a.png" + small, 3, {"standard input is empty"});
    expectFailure("render spheres -o jpg:-" + small, 2, {"jpg:-", "exr:-"});
    expectFailure("render spheres -o - --report -" + small, 2, {"--output", "--report", "same file"});
    expectFailure("render spheres -o - --partial 1" + small, 2, {"--partial", "standard output"});
    expectFailure("render spheres -o a.png --checkpoint -" + small, 2, {"--checkpoint", "name a file"});
    expectFailure("render spheres -o - --part 1/2" + small, 2, {"--part", ".part"});
    store("a.fbx", "Kaydara FBX Binary  ");
    store("a.html", "<!DOCTYPE html><html></html>");
    for (const auto &[name, word] : {std::pair("a.fbx", "FBX"), std::pair("a.html", "a web page")}) {
        const Outcome outcome = runIn(reading(name), "render - -o a.png" + small);
        EXPECT_EQ(outcome.exitCode, 3) << outcome;
        EXPECT_TRUE(contains(outcome.errors, word)) << outcome;
    }
    const Outcome terminal = runIn(writingTo(Stream::Terminal), "render spheres -o -" + small);
    EXPECT_EQ(terminal.exitCode, 7);
    EXPECT_TRUE(contains(terminal.errors, "standard output is a terminal")) << terminal;
    EXPECT_EQ(runIn(writingTo(Stream::FullDevice), "render spheres -o -" + small).exitCode, 7);
    EXPECT_EQ(entries(), (std::set<std::string>{"a.fbx", "a.html"}));
}

} // namespace
} // namespace hyalite::core::testing
