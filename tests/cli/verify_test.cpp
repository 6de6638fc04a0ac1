// verify: films of all devices against shipped hashes, and where a film differs that has other bits.
#include "host/gpu/kernels.h"
#include "tests/cli/fault_process.h"
#include "tests/fixtures/test_extent.h"

#include <fmt/format.h>

#include <functional>

#include <stdlib.h>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Verify : public FaultyDevice {
  protected:
    void TearDown() override {
        unsetenv("HYALITE_ASSETS");
        FaultyDevice::TearDown();
    }

    /// From now on the shipped films are those for which `change` returns true, as it leaves their rows.
    void changeFilms(const std::function<bool(Json &)> &change) const {
        fs::create_directory(folder / "assets");
        fs::copy(fs::path(HYALITE_ASSET_DIR) / "verify", folder / "assets/verify");
        Json document = Json::parse(load("assets/verify/films.json"));
        Json kept = Json::array();
        for (Json film : document.at("films"))
            if (change(film))
                kept.push_back(film);
        document["films"] = kept;
        store("assets/verify/films.json", document.dump());
        setenv("HYALITE_ASSETS", path("assets").c_str(), 1);
    }
    /// Those of one scene by these integrators, with one slot an invocation: to compile takes longer than all the rest.
    void keepLights(const std::set<std::string> &integrators) const {
        changeFilms([&](Json &film) {
            film.erase("maxSlots");
            return film.at("scene") == "lights" &&
                   integrators.contains(film.at("integrator").get<std::string>());
        });
    }
};

TEST_F(Verify, MayHaveTheKernelsThatAreNamed) {
    keepLights({"id", "cost"});
    const Outcome outcome =
        runHere("verify --device 0 --kernels skip-list --quiet --report " + path("r.json"), "");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    ASSERT_EQ(report().at("devices").at(0).at("films").size(), 1u) << report(); // no cost without a stack
    EXPECT_EQ(report().at("devices").at(0).at("films").at(0).at("kernel"), "skip-list");
    const Outcome refused = runHere("verify --kernels skip-lists", "");
    EXPECT_EQ(refused.exitCode, 2) << refused;
    EXPECT_TRUE(contains(refused.errors, "--kernels: found \"skip-lists\"")) << refused;
}

TEST_F(Verify, PassesOnAllDevices) {
    // Images have each kernel's pictures on the driver at hand; to compile them all takes a minute, or half an hour.
    std::set<std::string> wanted{"skip-list"};
    gpu::DeviceInfo software;
    software.type = gpu::DeviceType::Cpu;
    for (const gpu::KernelRow &kernel : gpu::kernelTable)
        if (isTestingAll() && !kernel.suits.isByNameOn(software))
            wanted.insert(std::string(kernel.name));
    const Outcome outcome = run("verify --report r.json --junit r.xml" +
                                std::string(isTestingAll() ? "" : " --kernels skip-list"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(outcome.output.ends_with("equal, bit for bit\n")) << outcome;
    const Json devices = report().at("devices");
    ASSERT_EQ(devices.size(), 1 + listDevices().size());
    EXPECT_EQ(devices[0].at("name"), "cpu");
    std::set<std::string> kernels;
    for (const Json &film : devices[1].at("films")) {
        EXPECT_EQ(film.at("isEqual"), true) << film;
        EXPECT_EQ(film.at("hash"), film.at("shippedHash"));
        kernels.insert(film.at("kernel").get<std::string>());
    }
    EXPECT_EQ(kernels, wanted);
    const std::string junit = load("r.xml");
    EXPECT_TRUE(contains(junit, "failures=\"0\" skipped=\"0\"")) << junit;
    EXPECT_TRUE(contains(junit, "<testcase classname=\"cpu\" name=\"lights, path\"")) << junit;
}

TEST_F(Verify, NamesTheFirstDifferenceOfADriverThatComputesOtherwise) {
    keepLights({"path", "whitted", "depth"});
    const Outcome outcome = runHere("verify --device 0 --kernels skip-list --report " + path("r.json") +
                                        " --junit " + path("r.xml"),
                                    "", "other-pi");
    EXPECT_EQ(outcome.exitCode, 1) << outcome;
    for (const char *part :
         {"lights, path, skip-list: ", "pixels differ from the CPU's", "; tile (0, 0) of ", "; pixel (",
          ", sample ", ", bounce ", " on the device, ", " on the CPU", "NOT equal\n"})
        EXPECT_TRUE(contains(outcome.output, part)) << part << outcome;
    std::set<std::string> differing;
    const Json found = report();
    for (const Json &film : found.at("devices").at(0).at("films"))
        if (!film.at("isEqual").get<bool>()) {
            differing.insert(film.at("integrator").get<std::string>());
            const Json &difference = film.at("differenceFromCpu");
            EXPECT_GT(difference.at("differingPixels"), 0);
            EXPECT_LT(difference.at("pixel").at(0), 48);
            EXPECT_LT(difference.at("sample"), 4);
            EXPECT_NE(difference.at("first"), difference.at("second"));
            EXPECT_GE(difference.at("tile").at("width"), 8);
        }
    EXPECT_EQ(differing, (std::set<std::string>{"path", "whitted"}));
    EXPECT_TRUE(contains(load("r.xml"), "<failure message=\"")) << load("r.xml");
}

// Where device and CPU agree on other bits, the program is wrong: it or its libraries were compiled otherwise.
TEST_F(Verify, SaysThatTheProgramItselfComputesOtherwise) {
    changeFilms([](Json &film) {
        film["hash"] = "0123456789abcdef";
        return film.at("integrator") == "depth";
    });
    for (const char *device : {"cpu", "0"}) {
        const Outcome outcome = run(fmt::format("verify --device {} --quiet", device));
        EXPECT_EQ(outcome.exitCode, 1) << outcome;
        EXPECT_TRUE(contains(outcome.output, "this build of the program computes otherwise")) << outcome;
    }
}

TEST_F(Verify, CountsDevicesThatFail) {
    keepLights({"ao"});
    const Outcome outcome = runHere("verify --device 0 --quiet", "vkQueueSubmit:4:VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(outcome.exitCode, 1) << outcome;
    EXPECT_TRUE(contains(outcome.output, "VK_ERROR_DEVICE_LOST")) << outcome;
}

TEST_F(Verify, SaysWhatADeviceCannotRun) {
    keepLights({"ao"});
    const Outcome outcome = runHere("verify --device 0", "", "few-images");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "not run: the kernel skip-list cannot run on")) << outcome;
    const Outcome none = runHere("verify --device all", "", "few-images,few-storage-buffers");
    EXPECT_EQ(none.exitCode, 4) << "no kernel is left" << none;
}

// Bits of a device that promises nothing count as measured once its films were verified, all of them.
TEST_F(Verify, IsRememberedByDevices) {
    const auto equalBits = [&] {
        const Json devices = Json::parse(runHere("devices --json", "", "no-float-controls").output);
        return devices.at(0).at("equalBits").get<std::string>();
    };
    const auto verify = [&](const std::string &options, const std::string &fakes) {
        return runHere("verify --device 0" + options, "", "no-float-controls" + fakes).exitCode;
    };
    keepLights({"whitted", "depth"});
    EXPECT_TRUE(equalBits().starts_with("none: ")) << equalBits();
    EXPECT_TRUE(contains(equalBits(), "`hyalite verify`")) << equalBits();
    EXPECT_EQ(verify(" --scenes lights", ""), 0);
    EXPECT_TRUE(equalBits().starts_with("none: ")) << "a part does not suffice";
    EXPECT_EQ(verify("", ""), 0);
    EXPECT_TRUE(equalBits().starts_with("measured: ")) << equalBits();
    EXPECT_EQ(verify("", ",other-pi"), 1);
    EXPECT_TRUE(equalBits().starts_with("none: ")) << equalBits();
}

TEST_F(Verify, RefusesWhatIsNotThere) {
    expectFailure("verify --scenes ligths", 2, {"--scenes", "ligths", "did you mean \"lights\""});
    expectFailure("verify --device cpu-double", 2, {"--device", "double precision has other bits"});
    expectFailure("verify --device no-such-device", 4, {"no-such-device"});
    expectFailure("verify --device cpu --kernels stack", 2, {"--kernels", "--device cpu"});
    expectFailure("verify --device cpu --junit a --report a", 2, {"--junit", "--report"});
}

} // namespace
} // namespace hyalite::core::testing
