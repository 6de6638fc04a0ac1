// Black pictures explain themselves.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

const std::string smallDark = " -o a.pfm --width 16 --height 16 --spp 1 --device cpu";
const std::string ball = R"({ "centre": [0, 0, 0], "radius": 1, "material": "m" })";
const std::string eye = R"("camera": { "position": [0, 0, 5], "target": [0, 0, 0] })";

class DarkPictures : public CommandLine {
  protected:
    /// The warnings of rendering a scene with these members, and with a grey ball.
    [[nodiscard]] std::string warningsOf(const std::string &members, const std::string &options = "") const {
        store("scene.json", "{" + eye + R"(, "materials": { "m": { "type": "diffuse" },
            "lamp": { "type": "diffuse", "emission": 5 } } )" +
                                (members.empty() ? "" : ", " + members) + "}");
        const Outcome outcome = run("render scene.json" + smallDark + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        std::string warnings;
        for (std::size_t at = outcome.errors.find("hyalite: warning: "); at != std::string::npos;
             at = outcome.errors.find("hyalite: warning: ", at + 1))
            warnings += outcome.errors.substr(at + 18, outcome.errors.find('\n', at) - at - 17);
        return warnings;
    }
    void expectWarning(const std::string &part, const std::string &members,
                       const std::string &options = "") const {
        const std::string warnings = warningsOf(members, options);
        EXPECT_TRUE(contains(warnings, part)) << part << " is not in:\n" << warnings;
    }
};

const std::string onlyBall = "\"spheres\": [ " + ball + " ]";
const std::string lit =
    onlyBall + R"(, "lights": [ { "type": "point", "position": [3, 3, 6], "power": 500 } ])";

TEST_F(DarkPictures, NothingIsSaidOfALitScene) {
    EXPECT_EQ(warningsOf(lit), "");
    EXPECT_EQ(warningsOf(lit, " --integrator path"), "");
    EXPECT_EQ(warningsOf(onlyBall, " --integrator normal"), "") << "no picture of light";
    EXPECT_EQ(warningsOf(onlyBall, " --quiet"), "");
}

TEST_F(DarkPictures, NothingIsInView) {
    const std::string away = " --camera-position 0,0,50 --look-at 0,0,100";
    for (const char *integrator : {"path", "whitted", "normal"})
        expectWarning("no primary ray met anything", lit + ", \"background\": 1",
                      away + " --integrator " + integrator);
    EXPECT_EQ(warningsOf("\"background\": 1"), "") << "there is nothing to meet";
}

TEST_F(DarkPictures, NothingLightsThisScene) {
    expectWarning("nothing lights this scene", onlyBall);
    expectWarning("nothing lights this scene", onlyBall, " --integrator path");
    const std::string warnings = warningsOf(onlyBall);
    EXPECT_FALSE(contains(warnings, "the picture is black")) << "said a second time:\n" << warnings;
}

TEST_F(DarkPictures, WhittedSaysWhatItDoesNotSee) {
    const std::string lamp =
        R"("spheres": [ )" + ball + R"(, { "centre": [0, 5, 0], "radius": 1, "material": "lamp" } ])";
    expectWarning("whitted lights surfaces by lights without size", lamp, " --integrator whitted");
    expectWarning("whitted shows emitters, but does not light surfaces by them",
                  lamp + R"(, "lights": [ { "type": "point", "position": [3, 3, 6], "power": 500 } ])",
                  " --integrator whitted");
    expectWarning("whitted lights surfaces by lights without size", onlyBall + R"(, "background": 1)");
}

TEST_F(DarkPictures, SceneWithEmittersAndWithoutAnIntegratorGetsPath) {
    const std::string lamp =
        R"("spheres": [ )" + ball + R"(, { "centre": [0, 5, 5], "radius": 1, "material": "lamp" } ])";
    EXPECT_EQ(warningsOf(lamp), "");
    store("a.json", "{" + eye + R"(, "materials": { "m": { "type": "diffuse" }, "lamp": { "type": "diffuse",
        "emission": 5 } }, )" +
                        lamp + "}");
    EXPECT_EQ(
        renderReport("a.json --width 4 --height 4 --spp 1 --device cpu").at("settings").at("integrator"),
        "path");
    store("b.json", "{" + eye + R"(, "materials": { "m": { "type": "diffuse" } }, )" + lit + "}");
    EXPECT_EQ(
        renderReport("b.json --width 4 --height 4 --spp 1 --device cpu").at("settings").at("integrator"),
        "whitted");
}

TEST_F(DarkPictures, TheMostLikelyReasonIsNamed) {
    const std::string light = R"(, "lights": [ { "type": "point", "position": )";
    expectWarning("the picture is black: no surface is in view", lit, " --look-at 0,0,100");
    expectWarning(
        "surfaces stand between each light and all that is in view: a light may be inside an object",
        onlyBall + light + R"([0, 0, 0], "power": 500 } ])");
    const std::string floor =
        R"("shapes": [ { "type": "quad", "material": "m" }, { "type": "quad", "material": "lamp",
        "transform": [ { "translate": [0, 0, 9] } ] } ])";
    expectWarning("they may face away", floor, " --integrator path");
    const std::string inside =
        R"("shapes": [ { "type": "box", "material": "shell", "transform": [ { "scale": 9 } ] } ])";
    store("scene.json", "{" + eye +
                            R"(, "materials": { "shell": { "type": "diffuse", "twoSided": false } }, )" +
                            inside + light + R"([0, 0, 6], "power": 500 } ] })");
    const Outcome outcome = run("render scene.json" + smallDark);
    EXPECT_TRUE(contains(outcome.errors, "all surfaces in view are seen from behind")) << outcome;
}

TEST_F(DarkPictures, PixelsThatAreNotFiniteAreCounted) {
    const std::string bright = R"("spheres": [ { "centre": [0, 0, 0], "radius": 1e-10, "material": "m" } ],
        "lights": [ { "type": "point", "position": [0, 0, 3e-10], "power": 1e30 } ],
        "camera": { "position": [0, 0, 4e-10], "target": [0, 0, 0] })";
    store("bright.json", R"({"materials": { "m": { "type": "diffuse" } }, )" + bright + "}");
    const Outcome outcome = run("render bright.json" + smallDark);
    EXPECT_TRUE(contains(outcome.errors, "% of the pixels are not finite numbers")) << outcome;
}

} // namespace
} // namespace hyalite::core::testing
