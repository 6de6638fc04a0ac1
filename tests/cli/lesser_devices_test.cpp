// Devices that can do less than the one of the machine, by the layer in tests/faults: the same image, or a refusal.
#include "tests/cli/fault_process.h"

namespace hyalite::core::testing {
namespace {

class LesserDevices : public FaultyDevice {
  protected:
    void SetUp() override {
        FaultyDevice::SetUp();
        store("sheet.obj", wavySheetObj(12));
        store("sheet.json", wavySheetScene());
    }

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
          "discrete", "small-allocations", "few-images", "few-storage-buffers", "few-texels", "no-subgroups",
          "portability", "other-driver", "no-float-controls",
          "few-images,no-subgroups,small-buffers,small-heap",
          "small-buffers,small-heap,workgroup-128,no-timestamps"})
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
}

TEST_F(LesserDevices, GetTheKernelThatTheyCanRun) {
    const auto kernelOf = [&](const std::string &options, const std::string &fakes) {
        const Outcome outcome =
            runHere("render " + path("sheet.json") + " --quiet --width 16 --height 16 -o " + path("a.pfm") +
                        " --report " + path("report.json") + " --device 0" + options,
                    "", fakes);
        EXPECT_EQ(outcome.exitCode, 0) << fakes << outcome;
        return nlohmann::json::parse(load("report.json"))
            .at("device")
            .at("kernel")
            .at("name")
            .get<std::string>();
    };
    EXPECT_EQ(kernelOf("", ""), "skip-list-x2");
    for (const char *fakes : {"few-images", "few-texels", "no-subgroups"})
        EXPECT_EQ(kernelOf("", fakes), "stack") << fakes;
    EXPECT_EQ(kernelOf("", "few-storage-buffers"), "skip-list-x2");
    EXPECT_EQ(kernelOf("", "few-storage-buffers,discrete"), "skip-list");
    EXPECT_EQ(kernelOf("", "discrete"), "skip-list");
    EXPECT_EQ(kernelOf("", "few-texels,discrete"), "stack");
}

TEST_F(LesserDevices, AreRefusedByWhatTheyLack) {
    struct Refusal {
        std::string fakes;
        std::string options;
        int exitCode;
        std::vector<std::string> parts;
    };
    const std::vector<Refusal> refusals{
        {"few-images,few-storage-buffers", "", 4, {"allows 8 storage buffers in a kernel, 19 are needed"}},
        {"vulkan-1.0", "", 4, {"offers Vulkan 1.0", "1.1 is needed"}},
        {"no-subgroups", " --kernel skip-list", 5, {"no subgroup shuffles and sums", "leave out --kernel"}},
        {"few-images",
         " --kernel skip-list",
         5,
         {"allows 4 storage texel buffers and images in a kernel, 13 are needed", "leave out --kernel"}},
        {"few-storage-buffers", " --kernel stack", 5, {"allows 8 storage buffers", "leave out --kernel"}},
        {"few-storage-buffers", " --integrator cost", 5, {"allows 8 storage buffers", "--device cpu"}}};
    for (const Refusal &refusal : refusals) {
        const Outcome outcome =
            runFaulty("render sheet.json -o a.pfm --device 0" + refusal.options, "", refusal.fakes);
        EXPECT_EQ(outcome.exitCode, refusal.exitCode) << refusal.fakes << refusal.options << '\n' << outcome;
        for (const std::string &part : refusal.parts)
            EXPECT_TRUE(contains(outcome.errors, part)) << part << '\n' << outcome;
        EXPECT_TRUE(lastTally.alive.empty());
        EXPECT_FALSE(entries().contains("a.pfm"));
    }
}

TEST_F(LesserDevices, NeedALoaderOfVulkan11) {
    const Outcome outcome =
        runHere("render " + path("sheet.json") + " -o " + path("a.pfm"), "", "loader-1.0");
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    for (const char *part : {"the Vulkan loader is of version 1.0, and 1.1 is needed", "--device cpu"})
        EXPECT_TRUE(contains(outcome.errors, part)) << part << '\n' << outcome;
    EXPECT_FALSE(entries().contains("a.pfm"));
}

TEST_F(LesserDevices, WithoutTimestampsAreTimedByTheHost) {
    const std::string size = " --width 16 --height 16 --spp 1";
    const Outcome outcome =
        runHere("profile " + path("sheet.json") + " --quiet --repeat 1" + size, "", "no-timestamps");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "the host's clock, from submission to fence")) << outcome;
    EXPECT_FALSE(lastTally.calls.contains("vkCreateQueryPool"));
}

TEST_F(LesserDevices, WithoutFloatControlsPassTheStartUpCheck) {
    const Outcome outcome = runFaulty("compare sheet.json --width 16 --height 16", "", "no-float-controls");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "equal bits are not promised by")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "but the start-up check finds no wrong result")) << outcome;
    const auto list = nlohmann::json::parse(runHere("devices --json", "", "no-float-controls").output);
    EXPECT_TRUE(contains(list.at(0).at("equalBits").get<std::string>(), "finds no wrong result")) << list;
}

} // namespace
} // namespace hyalite::core::testing
