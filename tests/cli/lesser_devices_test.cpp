// Devices that can do less than the one of the machine, by the layer in tests/faults: the same image, or a refusal.
#include "tests/cli/fault_process.h"

namespace hyalite::testing {
namespace {

class LesserDevices : public FaultyDevice {
  protected:
    void SetUp() override {
        FaultyDevice::SetUp();
        store("sheet.obj", wavySheetObj(12));
        store("sheet.json", wavySheetScene());
    }

    [[nodiscard]] std::string path(const std::string &name) const { return (folder / name).string(); }

    /// The picture that `render LINE` writes; expects success.
    [[nodiscard]] std::string renderHere(const std::string &line, const std::string &fakes) {
        const Outcome outcome =
            runHere("render " + path("sheet.json") + " --quiet -o " + path("a.pfm") + line, "", fakes);
        EXPECT_EQ(outcome.exitCode, 0) << fakes << '\n' << outcome;
        EXPECT_TRUE(lastTally.alive.empty());
        return outcome.exitCode == 0 ? load("a.pfm") : std::string();
    }
};

TEST_F(LesserDevices, GiveTheSameBits) {
    // More than a tile, and more film than a small buffer holds.
    const std::string size = " --width 300 --height 280 --spp 1";
    const std::string wanted = renderHere(size + " --device cpu", "");
    for (const char *fakes :
         {"", "small-buffers", "small-heap", "tiny-heap", "workgroup-128", "no-timestamps", "calibrated",
          "discrete", "small-buffers,small-heap,workgroup-128,no-timestamps"})
        EXPECT_TRUE(renderHere(size + " --device 0", fakes) == wanted) << fakes;
}

TEST_F(LesserDevices, AreNotAskedForMoreMemoryThanTheyHave) {
    store("large.obj", wavySheetObj(100));
    for (const char *kernel : {"stack", "skip-list"}) {
        const Outcome outcome = runHere("render " + path("large.obj") + " --quiet -o " + path("a.pfm") +
                                            " --spp 1 --width 64 --height 64 --device 0 --kernel " + kernel,
                                        "", "tiny-heap");
        EXPECT_EQ(outcome.exitCode, 5) << outcome;
        for (const char *part : {"which has 1.0 MiB", "the triangles: 937.5 KiB", "--device cpu"})
            EXPECT_TRUE(contains(outcome.errors, part)) << part << '\n' << outcome;
        EXPECT_EQ(lastTally.calls.at("vkCreateBuffer"), 2) << "of the check of the arithmetic";
        EXPECT_TRUE(lastTally.alive.empty());
        EXPECT_FALSE(entries().contains("a.pfm"));
    }
}

TEST_F(LesserDevices, AreListedAsTheyAre) {
    const auto list = [&](const char *fakes) {
        return nlohmann::json::parse(runHere("devices --json", "", fakes).output).at(0);
    };
    EXPECT_EQ(list("small-buffers").at("maxStorageBufferBytes"), 1 << 20);
    EXPECT_EQ(list("small-heap").at("deviceMemoryBytes"), 256 << 20);
    EXPECT_EQ(list("workgroup-128").at("maxWorkgroupInvocations"), 128);
    EXPECT_EQ(list("no-timestamps").at("hasTimestamps"), false);
    EXPECT_EQ(list("no-float-controls").at("areBitsPromised"), false);
    EXPECT_EQ(list("no-subgroups").at("isUsable"), false);
}

TEST_F(LesserDevices, WithoutTimestampsAreTimedByTheHost) {
    const std::string size = " --width 16 --height 16 --spp 1";
    const Outcome outcome =
        runHere("profile " + path("sheet.json") + " --quiet --repeat 1" + size, "", "no-timestamps");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "the host's clock, from submission to fence")) << outcome;
    EXPECT_FALSE(lastTally.calls.contains("vkCreateQueryPool"));
}

TEST_F(LesserDevices, WithoutFloatControlsPromiseNoBits) {
    const Outcome outcome =
        runFaulty("render sheet.json -o a.png --width 16 --height 16", "", "no-float-controls");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "bits may differ")) << outcome;
}

TEST_F(LesserDevices, WithoutSubgroupShufflesAreRefused) {
    for (const char *device : {"auto", "0"}) {
        const Outcome outcome =
            runFaulty("render sheet.json -o a.png --device " + std::string(device), "", "no-subgroups");
        EXPECT_EQ(outcome.exitCode, 4) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "subgroup shuffles")) << outcome;
        EXPECT_TRUE(lastTally.alive.empty());
        EXPECT_FALSE(entries().contains("a.png"));
    }
}

} // namespace
} // namespace hyalite::testing
