// Motion vectors of sequences: closed forms, as Cycles has them in Blender's pass Vector.
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace hyalite::core::testing {
namespace {

constexpr int width = 24;
constexpr int height = 15; // the middle row looks along the horizon
const std::string smallMoving = " --motion --width 24 --height 15 --spp 1 --device cpu --quiet";

/// Pixels in the unit of the tangent, for a field of view of 60 degrees.
const double focal = width / (2.0 * std::tan(std::numbers::pi / 6.0));

struct Vectors {
    std::map<std::string, std::vector<float>> channels;

    [[nodiscard]] double at(const char *channel, int x, int y) const {
        return static_cast<double>(
            channels.at(std::string("vector.") + channel)[static_cast<std::size_t>(y * width + x)]);
    }
};

class Motion : public CommandLine {
  protected:
    [[nodiscard]] Vectors vectorsOf(const std::string &name) const { return {channelsOf(folder / name)}; }

    /// Each channel at every pixel, or at those of the middle row.
    void expectVectors(const std::string &name,
                       const std::function<std::array<double, 4>(double u, double v)> &form,
                       double tolerance = 1e-4) const {
        const Vectors found = vectorsOf(name);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const std::array<double, 4> wanted = form(x + 0.5 - width / 2.0, height / 2.0 - (y + 0.5));
                for (std::size_t i = 0; i < 4; ++i) {
                    const char letter[2] = {"XYZW"[i], '\0'};
                    ASSERT_NEAR(found.at(letter, x, y), wanted[i], tolerance)
                        << letter << " of " << x << ", " << y;
                }
            }
    }
};

/// A wall 10 in front of a camera with this path.
std::string wallScene(const std::string &keys) {
    return R"({"camera": {"position": [0, 0, 10], "direction": [0, 0, -1], "horizontalFov": 60,
                          "path": {"interpolation": "linear", "keys": [)" +
           keys + R"(]}},
               "background": 0.3, "materials": {"grey": {"type": "diffuse"}},
               "shapes": [{"type": "quad", "material": "grey", "transform": [{"scale": 400}]}]})";
}

// What the camera passes goes the other way; at the ends of its path the camera stands still.
TEST_F(Motion, OfACameraThatMovesAside) {
    store("aside.json", wallScene(R"({"frame": 0}, {"frame": 4, "position": [2, -1, 10]})"));
    ASSERT_EQ(run("render aside.json --frames 0..5 -o f.#.exr" + smallMoving).exitCode, 0);
    const double right = 0.5 * focal / 10.0;
    const double down = 0.25 * focal / 10.0;
    expectVectors("f.2.exr", [&](double, double) { return std::array{right, -down, right, -down}; });
    expectVectors("f.0.exr", [&](double, double) { return std::array{0.0, 0.0, right, -down}; });
    expectVectors("f.4.exr", [&](double, double) { return std::array{right, -down, 0.0, 0.0}; });
    expectVectors("f.5.exr", [](double, double) { return std::array{0.0, 0.0, 0.0, 0.0}; });
}

// By the angle a: the tangent of a direction's angle to the view becomes that of the angle less a.
TEST_F(Motion, OfACameraThatPans) {
    const double a = 0.1;
    const auto towards = [](double angle) {
        return "[" + std::to_string(std::sin(angle)) + ", 0, " + std::to_string(-std::cos(angle)) + "]";
    };
    store("pan.json", wallScene(R"({"frame": 0, "direction": )" + towards(-a) + R"(}, {"frame": 1},
                                   {"frame": 2, "direction": )" +
                                towards(a) + "}"));
    ASSERT_EQ(run("render pan.json --frames 1 -o p.#.exr" + smallMoving).exitCode, 0);
    expectVectors(
        "p.1.exr",
        [&](double u, double v) {
            const auto seenFrom = [&](double angle) { // right of the view by it
                const double depth = focal * std::cos(angle) + u * std::sin(angle);
                return std::pair{focal * (u * std::cos(angle) - focal * std::sin(angle)) / depth,
                                 focal * v / depth};
            };
            const auto [beforeX, beforeY] = seenFrom(-a);
            const auto [afterX, afterY] = seenFrom(a);
            return std::array{beforeX - u, beforeY - v, u - afterX, v - afterY};
        },
        2e-4);
}

// Around a ball of radius 10, from a distance of 55: its nearest point turns away.
TEST_F(Motion, OfATurntable) {
    store("ball.json", R"({"camera": {"position": [0, 0, 55], "target": [0, 0, 0], "horizontalFov": 60},
        "materials": {"grey": {"type": "diffuse"}}, "background": 0.3,
        "spheres": [{"centre": [0, 0, 0], "radius": 10, "material": "grey"}]})");
    ASSERT_EQ(
        run("render ball.json --turntable 36 --frames 0 -o t.#.exr --motion --width 25 --height 15 --spp 1 "
            "--device cpu --quiet")
            .exitCode,
        0);
    const auto channels = channelsOf(folder / "t.0.exr");
    const double angle = std::numbers::pi / 18.0;
    const double pixels = 25.0 / (2.0 * std::tan(std::numbers::pi / 6.0)) * 10.0 * std::sin(angle) /
                          (55.0 - 10.0 * std::cos(angle));
    constexpr std::size_t middle = 7 * 25 + 12;
    EXPECT_NEAR(static_cast<double>(channels.at("vector.X")[middle]), pixels, 1e-4);
    EXPECT_NEAR(static_cast<double>(channels.at("vector.Z")[middle]), pixels, 1e-4);
    EXPECT_NEAR(static_cast<double>(channels.at("vector.Y")[middle]), 0.0, 1e-4);
    EXPECT_EQ(channels.at("vector.X")[0], 0.0f) << "the background";
}

/// A large triangle in the plane z = 0, whose node or shape an animation moves, before a camera at z = 10.
GltfMaker moving() {
    GltfMaker maker;
    const std::size_t positions = maker.addVec3({-90, -90, 0, 90, -90, 0, 0, 90, 0});
    const std::size_t shift = maker.addVec3({3, 0, 0, 3, 0, 0, 3, 0, 0});
    maker.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", shift}}}}}}}}};
    maker.json["cameras"] = {{{"type", "perspective"},
                              {"perspective",
                               {{"yfov", 2.0 * std::atan(std::tan(std::numbers::pi / 6.0) * height / width)},
                                {"aspectRatio", static_cast<double>(width) / height},
                                {"znear", 0.1}}}}};
    maker.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 10}}});
    maker.json["scenes"][0]["nodes"] = {0, 1};
    return maker;
}

void animate(GltfMaker &maker, const char *path, std::size_t input, std::size_t output) {
    maker.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
                                 {"samplers", {{{"input", input}, {"output", output}}}}}};
}

// From the second 0 to 1 by 3 to the right, in four frames.
TEST_F(Motion, OfANodeAndOfAMorph) {
    GltfMaker node = moving();
    animate(node, "translation", node.addScalars({0, 1}), node.addVec3({0, 0, 0, 3, 0, 0}));
    store("node.glb", node.glb());
    GltfMaker morph = moving();
    animate(morph, "weights", morph.addScalars({0, 1}), morph.addScalars({0, 1}));
    store("morph.glb", morph.glb());
    const double right = 0.75 * focal / 10.0;
    for (const std::string scene : {"node", "morph"}) {
        ASSERT_EQ(run("render " + scene + ".glb --frames 0..4 --fps 4 -o " + scene + ".#.exr" + smallMoving)
                      .exitCode,
                  0);
        expectVectors(scene + ".2.exr", [&](double, double) { return std::array{-right, 0.0, -right, 0.0}; });
        expectVectors(scene + ".0.exr", [&](double, double) { return std::array{0.0, 0.0, -right, 0.0}; });
        expectVectors(scene + ".4.exr", [&](double, double) { return std::array{-right, 0.0, 0.0, 0.0}; });
    }
}

// The layer of a crop, of a part and of a device is that of the whole; a frame without it is rendered anew.
TEST_F(Motion, IsTheSameHoweverItIsMade) {
    store("aside.json", wallScene(R"({"frame": 0}, {"frame": 4, "position": [2, -1, 10]})"));
    const std::string line = "render aside.json -o f.#.exr --width 24 --height 15 --spp 1 ";
    ASSERT_EQ(run(line + "--frames 0..2 --motion --device cpu").exitCode, 0);
    const auto whole = channelsOf(folder / "f.1.exr");
    ASSERT_EQ(run(line + "--frames 0..2 --motion --part 2/3 --device " + softwareDevice()).exitCode, 0);
    EXPECT_EQ(channelsOf(folder / "f.1.exr"), whole);
    ASSERT_EQ(run(line + "--frames 1 --motion --crop 4,9,3,5 --device cpu").exitCode, 0);
    const auto crop = channelsOf(folder / "f.1.exr");
    for (const char *channel : {"vector.X", "vector.Y", "vector.Z", "vector.W"})
        for (std::size_t y = 0; y < 2; ++y)
            for (std::size_t x = 0; x < 5; ++x)
                EXPECT_EQ(crop.at(channel)[y * 5 + x], whole.at(channel)[(y + 3) * 24 + x + 4]) << channel;
    ASSERT_EQ(run(line + "--frames 1 --device cpu").exitCode, 0);
    EXPECT_FALSE(channelsOf(folder / "f.1.exr").contains("vector.X"));
    EXPECT_TRUE(contains(run(line + "--frames 1 --motion --resume --device cpu").output, "1 spp"));
    EXPECT_EQ(channelsOf(folder / "f.1.exr"), whole);
    EXPECT_TRUE(contains(run(line + "--frames 1 --motion --resume --device cpu").output, "is finished"));
}

TEST_F(Motion, IsOfFrames) {
    store("aside.json", wallScene(R"({"frame": 0}, {"frame": 4, "position": [2, -1, 10]})"));
    expectFailure("render aside.json -o a.exr --motion", 2, {"--motion: found one picture", "--frames"});
    expectFailure("render aside.json -o a.#.png --frames 1 --motion", 2, {"--motion is for .exr files"});
}

} // namespace
} // namespace hyalite::core::testing
