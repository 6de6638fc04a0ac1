// `hyalite profile` as a user types it.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/page_fixture.h"
#include "tests/fixtures/trace_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

class ProfileCommand : public CommandLine {
  protected:
    [[nodiscard]] nlohmann::json profile(const std::string &line) const {
        const Outcome outcome = run("profile " + line + " --report profile.json");
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        return nlohmann::json::parse(load("profile.json"));
    }
};

const std::string smallProfiled = " --width 32 --height 24 --spp 2 --repeat 2 --warmup 0";

TEST_F(ProfileCommand, VerifiesThenMeasures) {
    const Outcome outcome = run("profile spheres --device " + softwareDevice() + smallProfiled);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    for (const char *part : {"verified     equal to the CPU twin, bit for bit", "clock        timestamps",
                             "measured     2 frames, after 1 that is not", "\nupload ", "\npipeline ",
                             "\nfirst dispatch ", "\ndispatches ", "\nreadback ", "\nwhitted skip-list "})
        EXPECT_TRUE(contains(outcome.output, part)) << part << '\n' << outcome;
}

TEST_F(ProfileCommand, SaysThatNothingWasVerified) {
    const std::string line = "profile spheres" + smallProfiled + " --device ";
    const Outcome unverified = run(line + softwareDevice() + " --no-verify");
    EXPECT_EQ(unverified.exitCode, 0) << unverified;
    EXPECT_TRUE(contains(unverified.output, "verified     not verified, as asked")) << unverified;
    EXPECT_TRUE(contains(unverified.output, "2 frames, after 0 that are not")) << unverified;
    const Outcome reference = run(line + "cpu");
    EXPECT_EQ(reference.exitCode, 0) << reference;
    EXPECT_TRUE(contains(reference.output, "it is the reference itself")) << reference;
    EXPECT_TRUE(contains(reference.output, "clock        the host's clock")) << reference;
}

TEST_F(ProfileCommand, StagesFillTheFrame) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const nlohmann::json report = profile("spheres --device " + device + smallProfiled);
        // Structure, not speed: what is not in any stage is bookkeeping, and bad luck of short frames on a busy
        // machine.
        EXPECT_GT(report.at("stageShare").get<double>(), 0.5);
        EXPECT_LE(report.at("stageShare").get<double>(), 1.0 + 1e-9);
        EXPECT_EQ(report.at("frameMillis").size(), 2u);
        for (const nlohmann::json &stage : report.at("stages")) {
            EXPECT_LE(stage.at("minMillis"), stage.at("medianMillis")) << stage;
            EXPECT_LE(stage.at("medianMillis"), stage.at("p95Millis")) << stage;
            EXPECT_LE(stage.at("p95Millis"), stage.at("maxMillis")) << stage;
        }
    }
}

TEST_F(ProfileCommand, WorkIsEqualOnTwoRunsAndOnTheCpu) {
    const nlohmann::json first = profile("spheres --device " + softwareDevice() + smallProfiled);
    const nlohmann::json second = profile("spheres --device " + softwareDevice() + smallProfiled);
    const nlohmann::json onCpu = profile("spheres --device cpu" + smallProfiled);
    EXPECT_EQ(first.at("work"), second.at("work"));
    EXPECT_EQ(first.at("work").at("rays"), onCpu.at("work").at("rays"));
    EXPECT_EQ(first.at("work").at("rays").at("primary"), 32 * 24 * 2);
}

TEST_F(ProfileCommand, CountsTheSameWorkOnDeviceAndCpu) {
    const std::string line =
        "cat --counts --no-verify --width 32 --height 24 --spp 1 --repeat 1 --warmup 0 --device ";
    const nlohmann::json onDevice = profile(line + softwareDevice()).at("work");
    const nlohmann::json onCpu = profile(line + "cpu").at("work");
    EXPECT_EQ(onDevice.at("rays"), onCpu.at("rays"));
    EXPECT_EQ(onDevice.at("withStack"), onCpu.at("withStack"));
    EXPECT_GT(onCpu.at("withStack").at("nodesVisited").get<int>(), 32 * 24);
    EXPECT_GT(onCpu.at("withStack").at("deepestStack").get<int>(), 1);
    EXPECT_FALSE(profile("spheres --device cpu" + smallProfiled).at("work").contains("withStack"));
}

/// Balls of glass, through which a path of whitted splits in two up to 23 times.
std::string glassScene() {
    nlohmann::json scene{{"camera", {{"position", {0, 6, 12}}, {"target", {0, 0, 0}}}},
                         {"background", 0.5},
                         {"lights", {{{"type", "point"}, {"position", {0, 10, 5}}, {"power", 3000}}}},
                         {"materials", {{"glass", {{"type", "dielectric"}, {"index", 1.5}}}}},
                         {"settings", {{"integrator", "path"}, {"maxDepth", 24}}}};
    for (int i = 0; i < 49; ++i)
        scene["spheres"].push_back(
            {{"centre", {(i % 7 - 3) * 1.5, 0, (i / 7 - 3) * 1.5}}, {"radius", 0.7}, {"material", "glass"}});
    return scene.dump();
}

TEST_F(ProfileCommand, CountsTheWorkOfTheIntegratorThatIsMeasured) {
    store("glass.json", glassScene());
    const std::string line =
        "glass.json --counts --heatmap heat.png --html page.html --no-verify" + smallProfiled;
    const nlohmann::json onDevice = profile(line + " --device " + softwareDevice());
    const Image heatOfDevice = readImage(folder / "heat.png").image;
    const nlohmann::json onCpu = profile(line + " --device cpu");
    EXPECT_EQ(onDevice.at("settings").at("integrator"), "path");
    EXPECT_EQ(onDevice.at("work").at("rays"), onCpu.at("work").at("rays"));
    EXPECT_EQ(onDevice.at("work").at("withStack"), onCpu.at("work").at("withStack"));
    EXPECT_EQ(onDevice.at("testsPerSample"), onCpu.at("testsPerSample"));
    EXPECT_EQ(heatOfDevice.pixels(), readImage(folder / "heat.png").image.pixels());
    EXPECT_FALSE(onCpu.contains("timeLimit"));
}

TEST_F(ProfileCommand, ChargesTheSameRaysOnEveryDevice) {
    store("sheet.obj", wavySheetObj(8));
    store("sheet.json", wavySheetScene());
    const std::string line =
        "sheet.json --integrator path --counts --html page.html --no-verify" + smallProfiled;
    const nlohmann::json onDevice = profile(line + " --device " + softwareDevice());
    const nlohmann::json onCpu = profile(line + " --device cpu");
    const nlohmann::json &charges = onCpu.at("charges");
    EXPECT_EQ(onDevice.at("charges"), charges);
    EXPECT_EQ(reportInPage(load("page.html")).at("charges"), charges);
    for (const char *stage : {"primary", "further", "shadow"})
        EXPECT_TRUE(reportInPage(load("page.html")).at("stagePictures").contains(stage));
    EXPECT_EQ(charges.at("samplesPerPixel"), 2);
    std::set<std::string> names;
    std::map<std::string, std::uint64_t> sums;
    for (const nlohmann::json &row : charges.at("objects").at("rows")) {
        names.insert(row.value("name", ""));
        for (const auto &[stage, work] : row.at("work").items())
            for (const auto &[kind, count] : work.items())
                sums[kind] += count.get<std::uint64_t>();
    }
    EXPECT_EQ(names, (std::set<std::string>{"", "sheet.obj", "sphere 0", "sphere 1"}));
    EXPECT_EQ(sums["boxesTested"], onCpu.at("work").at("withStack").at("boxesTested"));
    EXPECT_EQ(sums["trianglesTested"], onCpu.at("work").at("withStack").at("trianglesTested"));
    EXPECT_EQ(sums["rays"], onCpu.at("work").at("rays").at("total"));
    const nlohmann::json &shading = charges.at("shading");
    const nlohmann::json &rays = onCpu.at("work").at("rays");
    EXPECT_EQ(shading.at("filmSamples"), rays.at("primary"));
    EXPECT_GE(shading.at("lightSamples"), rays.at("shadow")) << "some lights are below the surface";
    EXPECT_GT(shading.at("lobes").at("diffuse"), 0);
    EXPECT_EQ(shading.at("lobes").at("sheen"), 0);
    const std::string output = run("profile " + line + " --device cpu").output;
    EXPECT_TRUE(contains(output, "\ndearest      "));
    EXPECT_TRUE(contains(output, "\nshading      "));
    EXPECT_FALSE(profile("sheet.json --device cpu" + smallProfiled).contains("charges"));
    EXPECT_FALSE(
        profile("sheet.json --counts --integrator ao --device cpu" + smallProfiled).contains("charges"));
}

TEST_F(ProfileCommand, APageHasBothProfiles) {
    const std::string line = "profile spheres --html page.html" + smallProfiled + " --device ";
    ASSERT_EQ(run(line + "cpu --report old.json").exitCode, 0);
    EXPECT_FALSE(reportInPage(load("page.html")).contains("baseline"));
    const Outcome outcome = run(line + softwareDevice() + " --baseline old.json --report new.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    const nlohmann::json report = reportInPage(load("page.html"));
    EXPECT_EQ(report.at("baseline"), nlohmann::json::parse(load("old.json")));
    EXPECT_EQ(report.at("comparison").at("isSameDevice"), false);
    EXPECT_EQ(report.at("comparison").at("comparedCounts"), 6);
    EXPECT_EQ(report.at("coldStart").at("frame"), "verification");
    EXPECT_GT(report.at("coldStart").at("millis"), report.at("warmFrame").at("millis"));
    EXPECT_FALSE(nlohmann::json::parse(load("new.json")).contains("comparison"));
}

TEST_F(ProfileCommand, ATimeLimitEndsItWithAllThatThereIs) {
    store("glass.json", glassScene());
    const std::string line =
        "glass.json --integrator whitted --counts --heatmap heat.png --html page.html --trace "
        "trace.json --width 512 --height 512 --spp 1000 --device ";
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const nlohmann::json report = profile(line + device + " --time-limit 2");
        EXPECT_EQ(report.at("timeLimit").at("seconds"), 2);
        EXPECT_GE(report.at("timeLimit").at("leftOut").size(), 2u) << report.at("timeLimit");
        EXPECT_GT(report.at("finishedShare").get<double>(), 0.0);
        EXPECT_LT(report.at("finishedShare").get<double>(), 1.0);
        EXPECT_GT(report.at("work").at("rays").at("primary").get<std::uint64_t>(), 0u);
        EXPECT_FALSE(report.at("work").contains("withStack"));
        EXPECT_FALSE(report.at("testsPerSample").empty());
        EXPECT_EQ(readImage(folder / "heat.png").image.width(), 512);
        EXPECT_TRUE(contains(load("heat.png"), "leftOut"));
        EXPECT_EQ(reportInPage(load("page.html")).at("timeLimit"), report.at("timeLimit"));
        const nlohmann::json trace = nlohmann::json::parse(load("trace.json"));
        expectTrace(trace);
        EXPECT_EQ(trace.at("otherData").at("leftOut"), report.at("timeLimit").at("leftOut"));
    }
    expectFailure("profile " + line + "cpu --baseline profile.json", 3, {"profile.json", "its only frame"});
    ASSERT_EQ(run("profile spheres --device cpu --report old.json" + smallProfiled).exitCode, 0);
    const Outcome cut =
        run("profile spheres --device cpu --baseline old.json --time-limit 1e-9" + smallProfiled);
    EXPECT_EQ(cut.exitCode, 1) << cut;
    EXPECT_TRUE(contains(cut.output, "NOT compared with the baseline")) << cut;
}

TEST_F(ProfileCommand, CountsTheWarmUp) {
    const nlohmann::json report = profile("spheres --device cpu --width 8 --height 8 --warmup 2 --repeat 3");
    EXPECT_EQ(report.at("frameMillis").size(), 3u);
    EXPECT_EQ(report.at("repeats"), 3);
    const auto &stages = report.at("stages");
    const auto dispatches = std::find_if(stages.begin(), stages.end(), [](const nlohmann::json &stage) {
        return stage.at("name") == "dispatches";
    });
    EXPECT_TRUE(dispatches->contains("firstMillis"));
}

TEST_F(ProfileCommand, WritesTheImageAndTimesThat) {
    const nlohmann::json report = profile("spheres --device cpu -o profiled.pfm" + smallProfiled);
    EXPECT_EQ(report.at("stages").back().at("name"), "write");
    EXPECT_EQ(load("profiled.pfm"), renderPfm("spheres --device cpu --width 32 --height 24 --spp 2"));
}

TEST_F(ProfileCommand, WritesALineForEachDispatch) {
    const Outcome outcome = run("profile spheres --csv dispatches.csv --width 300 --height 24 --spp 1 "
                                "--repeat 2 --warmup 0 --device " +
                                softwareDevice());
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    const std::string csv = load("dispatches.csv");
    EXPECT_TRUE(csv.starts_with("frame,measured,dispatch,kernel,"));
    // The first dispatches of the first frame are small; later frames know what samples cost.
    EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 + 2 * 1);
    EXPECT_TRUE(contains(csv, "\r\nverification,0,1,whitted skip-list,32,0,32,24,0,1,0,")) << csv;
    EXPECT_TRUE(contains(csv, "\r\nrepeat 2,1,0,whitted skip-list,0,0,")) << csv;
}

TEST_F(ProfileCommand, WritesATimelineThatKeepsTheRulesOfItsFormat) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const Outcome outcome =
            run("profile spheres --trace trace.json -o image.png" + smallProfiled + " --device " + device);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        const nlohmann::json trace = nlohmann::json::parse(load("trace.json"));
        expectTrace(trace);
        const std::vector<nlohmann::json> dispatches = traceSlices(trace, "dispatch");
        ASSERT_GE(dispatches.size(), 2u);
        EXPECT_EQ(dispatches.front().at("args").at("tile"), "32x24 at (0, 0)");
        // Of the repeats, and of the verification where there is one.
        EXPECT_EQ(traceSlices(trace, "frame").size(), device == "cpu" ? 2u : 3u);
    }
}

TEST_F(ProfileCommand, AHeatMapIsThePictureOfTheCost) {
    store("sheet.obj", wavySheetObj(8));
    store("sheet.json", wavySheetScene());
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const nlohmann::json report =
            profile("sheet.json --heatmap heat.png --html page.html --device " + device + smallProfiled);
        ASSERT_EQ(run("render sheet.json --integrator cost -o cost.png --quiet --device " + device +
                      " --width 32 --height 24 --spp 2")
                      .exitCode,
                  0);
        EXPECT_EQ(readImage(folder / "heat.png").image.pixels(),
                  readImage(folder / "cost.png").image.pixels());
        EXPECT_EQ(report.at("settings").at("integrator"), "whitted");
        std::uint64_t pixelCount = 0;
        for (const nlohmann::json &bin : report.at("testsPerSample"))
            pixelCount += bin.at("pixels").get<std::uint64_t>();
        EXPECT_EQ(pixelCount, 32u * 24u);
        EXPECT_EQ(reportInPage(load("page.html")).at("testsPerSample"), report.at("testsPerSample"));
    }
    expectFailure("profile sheet.json --heatmap heat.pfm" + smallProfiled, 2, {"--heatmap", ".png"});
    expectFailure("render sheet.json --integrator cost --kernel skip-list -o a.png --quiet --device " +
                      softwareDevice(),
                  2, {"skip-list", "stack"});
}

TEST_F(ProfileCommand, TheCostIsEqualOnDeviceAndCpu) {
    store("sheet.obj", wavySheetObj(8));
    store("sheet.json", wavySheetScene());
    const std::string line = "sheet.json --integrator cost --width 32 --height 24 --spp 2 --device ";
    const std::string onDevice = renderPfm(line + softwareDevice());
    EXPECT_EQ(onDevice, renderPfm(line + "cpu"));
    EXPECT_EQ(onDevice, renderPfm(line + softwareDevice() + " --kernel stack"));
    EXPECT_NE(onDevice, renderPfm(line + "cpu --bvh sah"));
    EXPECT_EQ(
        run("compare sheet.json --integrator cost" + smallProfiled.substr(0, smallProfiled.find(" --repeat")))
            .exitCode,
        0);
}

TEST_F(ProfileCommand, ABaselineCatchesASlowerKernelAndMoreWork) {
    const std::string line = "profile spheres --device cpu --no-verify" + smallProfiled;
    ASSERT_EQ(run(line + " --report old.json").exitCode, 0);
    nlohmann::json old = nlohmann::json::parse(load("old.json"));
    // As if it had taken hours: whatever this machine does now is faster.
    const auto storeOld = [&](const std::string &name, double millis, double rays) {
        nlohmann::json changed = old;
        changed["kernels"][0]["frameMillis"] = {millis, millis};
        changed["work"]["rays"]["shadow"] =
            static_cast<std::uint64_t>(changed["work"]["rays"]["shadow"].get<double>() * rays);
        store(name, changed.dump());
    };
    storeOld("slow.json", 1e7, 1.0);
    storeOld("fast.json", 1e-7, 1.0);
    storeOld("less.json", 1e7, 0.5);

    const Outcome faster = run(line + " --baseline slow.json");
    EXPECT_EQ(faster.exitCode, 0) << faster;
    EXPECT_TRUE(contains(faster.output, "no regression")) << faster;
    const Outcome slower = run(line + " --baseline fast.json --max-regression 50%");
    EXPECT_EQ(slower.exitCode, 1) << slower;
    EXPECT_TRUE(contains(slower.output, "SLOWER")) << slower;
    EXPECT_EQ(run(line + " --baseline fast.json --gate work").exitCode, 0);
    const Outcome more = run(line + " --baseline less.json --gate work");
    EXPECT_EQ(more.exitCode, 1) << more;
    EXPECT_TRUE(contains(more.output, "MORE WORK")) << more;
}

TEST_F(ProfileCommand, RefusesABaselineThatIsNone) {
    const std::string line = "profile spheres --device cpu" + smallProfiled;
    ASSERT_EQ(run(line + " --report old.json").exitCode, 0);
    store("none.json", "{}");
    expectFailure(line + " --baseline none.json", 3,
                  {"none.json", "not a profile report", "`hyalite profile --report` writes one"});
    expectFailure(line + " --baseline missing.json", 3, {"missing.json"});
    expectFailure(line + " --baseline old.json --max-regression 5", 2, {"--max-regression", "a percentage"});
    expectFailure(line + " --baseline old.json --max-regression -1%", 2, {"--max-regression"});
    expectFailure(line + " --baseline old.json --report old.json", 2, {"would overwrite"});
    expectFailure("profile spheres --device cpu --width 16 --baseline old.json", 3, {"another job"});
    store("a.json", squareScene()); // a file of one name with two scenes
    store("square.obj", squareObj());
    ASSERT_EQ(run("profile a.json --device cpu --report a-old.json" + smallProfiled).exitCode, 0);
    store("a.json", wavySheetScene());
    store("sheet.obj", wavySheetObj(2));
    expectFailure("profile a.json --device cpu --baseline a-old.json" + smallProfiled, 3, {"another job"});
}

TEST_F(ProfileCommand, WritesAPageWithTheImageInIt) {
    const Outcome outcome =
        run("profile spheres --html profile.html --device cpu -o image.png" + smallProfiled);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    const nlohmann::json report = reportInPage(load("profile.html"));
    // "\x89PNG\r\n" in base64.
    EXPECT_TRUE(report.at("picture").get<std::string>().starts_with("iVBORw0K"));
    EXPECT_TRUE(contains(report.at("commandLine"), "profile spheres --html profile.html"));
}

TEST_F(ProfileCommand, RefusesWhatMakesNoSense) {
    expectFailure("profile spheres --repeat 0", 2, {"--repeat", "from 1 to 10000"});
    expectFailure("profile spheres --warmup -1", 2, {"--warmup"});
    expectFailure("profile spheres --report a.json --csv a.json", 2, {"name the same file"});
    expectFailure("profile spheres --device nonesuch" + smallProfiled, 4);
    expectFailure("profile spheres --csv missing/a.csv", 7);
    EXPECT_TRUE(entries().empty());
}

} // namespace
} // namespace hyalite::core::testing
