// Warnings about a scene: given once, where they apply, and not with --quiet.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace hyalite::core::testing {
namespace {

using Warnings = CommandLine;

const std::string smallWarned = " --width 8 --height 8 --spp 1 --device cpu -o a.pfm";
const std::string behindGlass = "through smooth glass: its shadow is dark";

/// How often `render scene.json` speaks of lights behind glass; `key` is of the ball's material.
class LightsBehindGlass : public Warnings {
  protected:
    [[nodiscard]] int countOf(const std::string &key, const std::string &lights,
                              const std::string &options = "") const {
        store("scene.json", R"({ "materials": { "ball": { )" + key + R"( } },
  "spheres": [ { "centre": [0, 0, 0], "radius": 1, "material": "ball" } ],
  "lights": [ )" + lights + R"( ], "settings": { "integrator": "path" } })");
        const Outcome outcome = run("render scene.json" + options + smallWarned);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        int count = 0;
        for (std::size_t at = outcome.errors.find(behindGlass); at != std::string::npos;
             at = outcome.errors.find(behindGlass, at + 1))
            ++count;
        return count;
    }
};

const std::string glass = R"("type": "dielectric")";
const std::string point = R"({ "type": "point", "position": [0, 5, 0], "power": 100 })";
const std::string spot = R"({ "type": "spot", "position": [0, 5, 0], "direction": [0, -1, 0], "power": 9 })";
const std::string sun = R"({ "type": "directional", "direction": [0, -1, 0], "irradiance": 1 })";

TEST_F(LightsBehindGlass, AreSpokenOfOnce) {
    EXPECT_EQ(countOf(glass, point), 1);
    EXPECT_EQ(countOf(glass, spot), 1);
    EXPECT_EQ(countOf(glass, sun), 1);
    EXPECT_EQ(countOf(glass, point + ", " + spot + ", " + sun), 1);
}

TEST_F(LightsBehindGlass, AreFoundOtherwise) {
    EXPECT_EQ(countOf(glass, ""), 0) << "no light";
    EXPECT_EQ(countOf(glass + R"(, "roughness": 0.3)", point), 0) << "rough glass is aimed through";
    EXPECT_EQ(countOf(R"("type": "principled", "transmission": 1)", point), 0) << "never smooth";
    EXPECT_EQ(countOf(R"("type": "mirror")", point), 0);
    EXPECT_EQ(countOf(glass, point, " --integrator whitted"), 0) << "shadow rays pass glass";
    EXPECT_EQ(countOf(glass, point, " --quiet"), 0);
}

TEST_F(Warnings, NameTheIntegratorOfTheCommandLine) {
    EXPECT_FALSE(contains(run("render spheres" + smallWarned).errors, behindGlass)) << "whitted";
    const std::string told = run("render spheres --integrator path" + smallWarned).errors;
    EXPECT_TRUE(contains(told, behindGlass)) << told;
    EXPECT_TRUE(contains(told, "a sphere with emission, or use the integrator whitted")) << told;
}

TEST_F(Warnings, NameTheExposureOfAPictureThatIsWhite) {
    store("square.obj", squareObj());
    const std::string line =
        "render square.obj --background 64,64,64 --width 8 --height 8 --spp 1 --device cpu -o a";
    const std::string white = "most of the picture is far brighter than white: an exposure of -7.0 shows it";
    EXPECT_TRUE(contains(run(line + ".png").errors, white)) << run(line + ".png");
    EXPECT_TRUE(contains(run(line + ".png --exposure 2").errors, white));
    for (const char *other : {".png --exposure -7", ".exr", ".png --integrator normal", ".png --quiet"})
        EXPECT_FALSE(contains(run(line + other).errors, "brighter than white")) << other;
}

TEST_F(Warnings, SpeakOfMeshesOfGlass) {
    store("tile.obj", squareObj());
    store("tile.json", R"({ "materials": { "pane": { "type": "dielectric" } },
  "meshes": [ { "file": "tile.obj", "material": "pane" } ],
  "lights": [ )" + point + R"( ], "settings": { "integrator": "path" } })");
    EXPECT_TRUE(contains(run("render tile.json" + smallWarned).errors, behindGlass));
}

} // namespace
} // namespace hyalite::core::testing
