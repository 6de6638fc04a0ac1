// devices --tune: what is measured is shown, kept and used, and a file that is damaged does no harm.
#include "host/base/hash.h"
#include "host/gpu/processor_use.h"
#include "host/gpu/render_config.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/test_extent.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

const std::string smallTuned = "spheres --width 16 --height 12 --spp 4";

class Tuning : public CommandLine {
  protected:
    /// Stores an entry for the software device as `--tune` writes it, with these kernels. Returns its text.
    std::string tune(const std::string &spheres, const std::string &kernelsHash) const {
        const nlohmann::json device = listDevices().at(std::stoul(softwareDevice()));
        const nlohmann::json entry{{"key",
                                    {{"vendorId", device.at("vendorId")},
                                     {"deviceId", device.at("deviceId")},
                                     {"driver", device.at("driver")},
                                     {"kernels", kernelsHash}}},
                                   {"date", "2026-01-02"},
                                   {"spheres", spheres},
                                   {"triangles", "stack"},
                                   {"shading", "skip-list"}};
        const std::string text = nlohmann::json{{"devices", {entry}}}.dump();
        fs::create_directory(folder / "cache");
        store("cache/tuning.json", text);
        return text;
    }
    [[nodiscard]] std::string kernelOf(const std::string &line) const {
        return renderReport(line + " --device " + softwareDevice()).at("device").at("kernel").at("name");
    }
};

TEST_F(Tuning, MeasuresShowsAndKeeps) {
    if (!isTestingAll())
        GTEST_SKIP() << "takes as long as a user waits for it";
    const Outcome outcome = run("devices --tune --device " + softwareDevice());
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    for (const char *part :
         {"Mray/s", "spheres", "triangles", "shading", "stack", "skip-list-x2", "cache/tuning.json"})
        EXPECT_TRUE(contains(outcome.output, part)) << part << outcome;
    const nlohmann::json kept = nlohmann::json::parse(load("cache/tuning.json")).at("devices");
    ASSERT_EQ(kept.size(), 1u) << kept;
    const Outcome shown = run("devices");
    EXPECT_TRUE(contains(shown.output, "as measured on " + kept[0].at("date").get<std::string>())) << shown;
    EXPECT_EQ(kernelOf(smallTuned), kept[0].at("spheres").get<std::string>());
    EXPECT_EQ(kept[0].at("key").at("kernels"), hashText(gpu::hashOfKernels()));
}

TEST_F(Tuning, OfTheseKernelsDecidesAndChangesNoBit) {
    const std::string hash = hashText(gpu::hashOfKernels());
    const std::string wanted = renderPfm(smallTuned + " --device cpu");
    for (const gpu::KernelRow &kernel : gpu::kernelTable) {
        if (!hasKernel(&kernel))
            continue;
        tune(std::string(kernel.name), hash);
        EXPECT_EQ(kernelOf(smallTuned), kernel.name);
        EXPECT_EQ(load("reported.pfm"), wanted) << kernel.name;
    }
    EXPECT_EQ(kernelOf(smallTuned + " --kernel skip-list"), "skip-list") << "the command line decides first";
}

TEST_F(Tuning, OfOtherKernelsDoesNotHold) {
    const std::string usual = kernelOf(smallTuned);
    tune("skip-list-x2", "0123456789abcdef");
    EXPECT_EQ(kernelOf(smallTuned), usual);
    EXPECT_TRUE(contains(run("devices").output, "--tune")) << "nothing is measured";
}

TEST_F(Tuning, ADamagedFileIsToldAndChangesNothing) {
    const std::string wanted = renderPfm(smallTuned);
    const std::string whole = tune("stack", "0");
    fs::create_directory(folder / "cache/deep");
    for (const std::string &text :
         {std::string(), std::string("[]"), std::string("{\"devices\": 3}"),
          whole.substr(0, whole.size() / 2), std::string(100'000, '['), std::string("\0\x7f\xff", 3)}) {
        store("cache/tuning.json", text);
        const Outcome outcome = run("render " + smallTuned + " -o a.pfm");
        EXPECT_EQ(outcome.exitCode, 0) << text.substr(0, 80) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "note: ")) << text.substr(0, 80) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "tuning.json")) << outcome;
        EXPECT_EQ(load("a.pfm"), wanted);
    }
}

TEST_F(Tuning, KeepsHowLanesExchangeWhichChangesNoBit) {
    if (!gpu::hasWideVectors())
        GTEST_SKIP() << "the processor has no vectors of 512 bits, and so no subgroups of 16 lanes";
    leaveLavapipe();
    const std::string key = "exchange of 16 lanes";
    const std::string onDevice = " --device " + softwareDevice();
    static_cast<void>(renderPfm(smallTuned + onDevice));
    nlohmann::json kept = nlohmann::json::parse(load("cache/tuning.json"));
    const std::string measured = kept.at("devices").at(0).at(key);
    EXPECT_TRUE(measured == "shuffles" || measured == "broadcasts") << measured;
    for (const std::string &line :
         {smallTuned, smallTuned + " --integrator path", std::string("cat --width 24 --height 16 --spp 5"),
          std::string("many-lights --width 24 --height 16 --spp 9"), smallTuned + " --integrator ao"}) {
        const std::string wanted = renderPfm(line + " --device cpu");
        for (const char *exchange : {"shuffles", "broadcasts"}) {
            kept.at("devices").at(0).at(key) = exchange;
            store("cache/tuning.json", kept.dump());
            EXPECT_EQ(renderPfm(line + onDevice), wanted) << line << ", " << exchange;
            EXPECT_EQ(load("cache/tuning.json"), kept.dump()) << "nothing is measured again";
        }
    }
}

TEST_F(Tuning, RefusesWhatMakesNoSense) {
    expectFailure("devices --tune --json", 2, {"--tune", "--json"});
    expectFailure("devices --device 0", 2, {"--tune"});
    expectFailure("devices --tune --device nonesuch", 4, {"nonesuch"});
    EXPECT_EQ(entries(), std::set<std::string>{});
    EXPECT_FALSE(fs::exists(folder / "cache")) << "nothing is kept of it";
}

} // namespace
} // namespace hyalite::core::testing
