// Renders on a device that fails on the way: they go on, to the same bits, or keep what is finished.
#include "host/image/image_file.h"
#include "tests/cli/fault_process.h"

#include <fmt/format.h>

namespace hyalite::core::testing {
namespace {

/// With so much time for each, tiles double: of 32x32, 32x32, 64x32, 64x64 and 128x64 pixels.
const std::string fiveTiles = " --width 128 --height 128 --spp 1 --max-dispatch-ms 10000 --device 0";
/// The arithmetic's check and the warm-up.
constexpr int dispatchesOfTheStart = 2;

class DeviceRecovery : public FaultyDevice {
  protected:
    [[nodiscard]] Outcome render(const std::string &faults, const std::string &options = {}) {
        return runHere("render spheres --quiet --report " + path("r.json") + " -o " + path("a.pfm") +
                           fiveTiles + options,
                       faults);
    }
};

TEST_F(DeviceRecovery, AFaultInAnyDispatchChangesNoBit) {
    ASSERT_EQ(render("").exitCode, 0);
    const std::string wanted = load("a.pfm");
    const nlohmann::json rays = report().at("rays");
    EXPECT_EQ(report().at("faults"), nlohmann::json::array());
    const long submits = lastTally.calls.at("vkQueueSubmit");
    ASSERT_EQ(submits, dispatchesOfTheStart + 5);
    for (const char *fault :
         {"vkQueueSubmit:{}:VK_ERROR_DEVICE_LOST", "vkWaitForFences:{}:VK_ERROR_DEVICE_LOST",
          "vkWaitForFences:{}:VK_ERROR_OUT_OF_HOST_MEMORY", "vkQueueSubmit:{}:VK_ERROR_OUT_OF_DEVICE_MEMORY"})
        for (long call = 2; call <= submits; ++call) {
            const Outcome outcome = render(fmt::format(fmt::runtime(fault), call));
            SCOPED_TRACE(fmt::format(fmt::runtime(fault), call));
            EXPECT_EQ(outcome.exitCode, 0) << outcome;
            EXPECT_TRUE(load("a.pfm") == wanted);
            EXPECT_EQ(report().at("rays"), rays);
            EXPECT_EQ(lastTally.calls.at("vkCreateDevice"), 2);
            EXPECT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
            // Told even where it is quiet, with the dispatch.
            const std::string told = report().at("faults").at(0);
            EXPECT_TRUE(contains(outcome.errors, "note: " + told + ";")) << outcome;
            if (call > dispatchesOfTheStart) {
                EXPECT_TRUE(contains(told, "kernel whitted skip-list, tile (")) << told;
                EXPECT_TRUE(contains(told, "samples 0 to 1")) << told;
            }
        }
}

TEST_F(DeviceRecovery, AnotherDeviceFinishesWhatOneLeaves) {
    const std::string line = "render spheres --width 96 --height 64 --spp 8 --report " + path("r.json") +
                             " -o " + path("a.pfm") + " --device cpu";
    ASSERT_EQ(runHere(line, "").exitCode, 0);
    const std::string wanted = load("a.pfm");
    // While its bits are checked, and while it renders its first tile.
    for (const int submit : {5, 9}) {
        const Outcome outcome =
            runHere(line + " --device 0", fmt::format("vkQueueSubmit:{}+:VK_ERROR_DEVICE_LOST", submit));
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "note: left out llvmpipe")) << outcome;
        EXPECT_TRUE(load("a.pfm") == wanted);
        const nlohmann::json share = report().at("shares").at(1);
        EXPECT_TRUE(contains(share.at("failure"), "VK_ERROR_DEVICE_LOST")) << share;
        EXPECT_EQ(share.at("tiles"), submit == 5 ? 0 : 1) << share;
        EXPECT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
    }
}

TEST_F(DeviceRecovery, ADeviceWithOtherBitsIsLeftOut) {
    const std::string line = "render spheres --width 96 --height 64 --spp 8 --report " + path("r.json") +
                             " -o " + path("a.pfm") + " --device ";
    ASSERT_EQ(runHere(line + "cpu", "").exitCode, 0);
    const std::string wanted = load("a.pfm");
    ASSERT_EQ(runHere(line + "0", "", "other-pi").exitCode, 0);
    ASSERT_TRUE(load("a.pfm") != wanted);
    const Outcome outcome = runHere(line + "0 --device cpu", "", "other-pi");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    for (const char *part : {"note: left out llvmpipe", " and cpu disagree: at pixel (", ") and ("})
        EXPECT_TRUE(contains(outcome.errors, part)) << part << outcome;
    EXPECT_TRUE(load("a.pfm") == wanted);
    EXPECT_TRUE(contains(report().at("shares").at(0).at("failure"), "disagree")) << report();
    EXPECT_TRUE(report().at("shares").at(1).at("failure").is_null()) << report();
}

TEST_F(DeviceRecovery, ADeviceThatFailsForGoodLeavesWhatIsFinished) {
    ASSERT_EQ(render("").exitCode, 0);
    const Image whole = readImage(folder / "a.pfm").image;
    for (const auto &[fault, exitCode] : {std::pair{"vkQueueSubmit:6+:VK_ERROR_DEVICE_LOST", 6},
                                          {"vkWaitForFences:6+:VK_ERROR_DEVICE_LOST", 6},
                                          {"vkQueueSubmit:6+:VK_ERROR_OUT_OF_DEVICE_MEMORY", 5},
                                          {"vkCreateDevice:2+:VK_ERROR_INITIALIZATION_FAILED,"
                                           "vkQueueSubmit:6:VK_ERROR_DEVICE_LOST",
                                           6}}) {
        const Outcome outcome = render(fault);
        SCOPED_TRACE(fault);
        EXPECT_EQ(outcome.exitCode, exitCode) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "stopped by the device: ")) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "reopened 3 times")) << outcome;
        EXPECT_EQ(lastTally.calls.at("vkCreateDevice"), 4);
        EXPECT_TRUE(lastTally.alive.empty());
        EXPECT_EQ(report().at("faults").size(), 4u);
        // The copies of the film are made by the clock, except for the first, after the first of three tiles.
        const long pixels = report().at("finished").at("pixels");
        EXPECT_TRUE(pixels == 32 * 32 || pixels == 64 * 32 || pixels == 64 * 64) << pixels;
        const auto isFinished = [&](int x, int y) {
            return x < (pixels > 1024 ? 64 : 32) && y < (pixels > 2048 ? 64 : 32);
        };
        const Image image = readImage(folder / "a.pfm").image;
        int differentCount = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                differentCount += image.at(x, y) != (isFinished(x, y) ? whole.at(x, y) : glm::vec3(0.0f));
        EXPECT_EQ(differentCount, 0);
    }
}

TEST_F(DeviceRecovery, WithoutASampleNothingIsWritten) {
    for (const char *fault :
         {"vkQueueSubmit:2+:VK_ERROR_DEVICE_LOST", "vkAllocateMemory:8+:VK_ERROR_OUT_OF_DEVICE_MEMORY"}) {
        const Outcome outcome = render(fault);
        EXPECT_EQ(outcome.exitCode, contains(fault, "LOST") ? 6 : 5) << outcome;
        EXPECT_EQ(entries(), std::set<std::string>{}) << fault;
    }
}

TEST_F(DeviceRecovery, AWaitIsLongButNotEndless) {
    ASSERT_EQ(render("").exitCode, 0);
    const std::string wanted = load("a.pfm");
    // One slice of it is nothing.
    const Outcome slow = render("vkWaitForFences:4:VK_TIMEOUT");
    EXPECT_EQ(slow.exitCode, 0) << slow;
    EXPECT_EQ(slow.errors, "");
    EXPECT_TRUE(load("a.pfm") == wanted);
    // In a process of its own: what may still run is never freed.
    const Outcome hanging =
        runFaulty("render spheres -o a.pfm --report r.json" + fiveTiles, "vkWaitForFences:5+:VK_TIMEOUT");
    EXPECT_EQ(hanging.exitCode, 6) << hanging;
    EXPECT_TRUE(contains(hanging.errors, "tile (0, 32)")) << hanging;
    EXPECT_TRUE(contains(hanging.errors, "VK_TIMEOUT")) << hanging;
    EXPECT_TRUE(contains(hanging.errors, "stopped by the device: ")) << hanging;
    EXPECT_EQ(lastTally.alive.at("vkCreateDevice"), 4);
}

TEST_F(DeviceRecovery, BothRendersOfAComparisonSurvive) {
    const Outcome outcome =
        runFaulty("compare spheres --width 64 --height 64 --spp 2 --against 0 --device 0",
                  "vkQueueSubmit:5:VK_ERROR_DEVICE_LOST,vkQueueSubmit:9:VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "equal, bit for bit")) << outcome;
    EXPECT_EQ(lastTally.faults.size(), 2u);
    EXPECT_TRUE(lastTally.alive.empty());
}

} // namespace
} // namespace hyalite::core::testing
