// --device and --threads: which device renders, and that the image does not depend on it.
#include "host/gpu/kernels.h"
#include "host/gpu/processor_use.h"
#include "tests/cli/command_line.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace hyalite::core::testing {
namespace {

using RenderDevice = CommandLine;

const std::string smallOnDevice = " --width 16 --height 12 --spp 4";

Surroundings withoutDriver() {
    Surroundings surroundings;
    surroundings.environment["VK_DRIVER_FILES"] = "/nonexistent/driver.json";
    surroundings.environment["VK_ICD_FILENAMES"] = "/nonexistent/driver.json";
    return surroundings;
}

/// lavapipe's name has the width of its vectors, which differs from scene to scene.
std::string withoutVectorWidth(const std::string &name) { return name.substr(0, name.rfind(',')); }

/// Of the device that `auto` means, by what the render says.
nlohmann::json findDevice(const std::string &name) {
    for (const nlohmann::json &device : listDevices())
        if (withoutVectorWidth(device.at("name")) == withoutVectorWidth(name))
            return device;
    return {};
}

TEST_F(RenderDevice, EveryWayToNameADeviceGivesTheBytesOfTheCpu) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    const nlohmann::json device = listDevices().at(std::stoul(softwareDevice()));
    std::string part = device.at("name").get<std::string>().substr(0, 6);
    std::string otherCase = part;
    for (char &letter : otherCase)
        letter = static_cast<char>(std::isupper(static_cast<unsigned char>(letter))
                                       ? std::tolower(static_cast<unsigned char>(letter))
                                       : std::toupper(static_cast<unsigned char>(letter)));
    const std::string whole = device.at("name");
    for (const char *scene : {"spheres", "sheet.json"}) {
        const std::string wanted = renderPfm(scene + smallOnDevice + " --device cpu");
        ASSERT_FALSE(wanted.empty());
        for (const std::string &name : {softwareDevice(), part, otherCase, whole})
            EXPECT_EQ(renderPfm(scene + smallOnDevice + " --device '" + name + "'"), wanted)
                << scene << ", " << name;
    }
}

TEST_F(RenderDevice, SeveralDevicesShareThePicture) {
    const std::string shared = "spheres --width 96 --height 64 --spp 8";
    const std::string wanted = renderPfm(shared + " --device cpu");
    const nlohmann::json report = renderReport(shared + " --device cpu --device " + softwareDevice());
    EXPECT_TRUE(load("reported.pfm") == wanted);
    std::uint64_t samples = 0;
    ASSERT_EQ(report.at("shares").size(), 2u) << report;
    for (const nlohmann::json &share : report.at("shares")) {
        EXPECT_GT(share.at("tiles"), 0) << share;
        EXPECT_TRUE(share.at("failure").is_null()) << share;
        samples += share.at("samples").get<std::uint64_t>();
    }
    EXPECT_EQ(samples, 96u * 64u * 8u);
    EXPECT_TRUE(contains(report.at("device").at("name"), "cpu + ")) << report;
}

TEST_F(RenderDevice, AllLeavesTheCpuToTheSoftwareDeviceOnIt) {
    const Outcome outcome = run("render spheres -o a.pfm --device all" + smallOnDevice);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "note: left out cpu: ")) << outcome;
    EXPECT_TRUE(contains(outcome.errors, " computes on the same cores\n")) << outcome;
    EXPECT_EQ(load("a.pfm"), renderPfm("spheres --device cpu" + smallOnDevice));
}

TEST_F(RenderDevice, NamesThatDoNotGoTogetherAreRefused) {
    const std::string line = "render spheres -o a.pfm --device " + softwareDevice();
    expectFailure(line + " --device " + softwareDevice(), 2, {"--device: ", " is given twice"});
    expectFailure(line + " --device cpu-double", 2,
                  {"--device: cpu-double cannot be combined with other devices"});
    expectFailure(line + " --device all", 2, {"--device: all cannot be combined with other devices"});
    expectFailure(line + " --device nothing", 4, {"no device matches 'nothing'"});
}

TEST_F(RenderDevice, AutoIsTheDefaultAndMatchesTheCpu) {
    const nlohmann::json report = renderReport("spheres" + smallOnDevice);
    const std::string byDefault = load("reported.pfm");
    EXPECT_EQ(renderPfm("spheres --device auto" + smallOnDevice), byDefault);
    const nlohmann::json device = findDevice(report.at("device").at("name"));
    ASSERT_TRUE(device.is_object()) << report;
    if (device.at("canRoundToNearestEven") && device.at("canPreserveSignedZeroInfNan")) {
        EXPECT_EQ(renderPfm("spheres --device cpu" + smallOnDevice), byDefault) << device;
    }
}

TEST_F(RenderDevice, AutoPrefersHardware) {
    bool hasHardware = false;
    for (const nlohmann::json &device : listDevices())
        hasHardware |= device.at("isUsable") && !contains(device.at("type"), "software");
    const Outcome outcome = run("render spheres -o a.png" + smallOnDevice);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(contains(outcome.errors, "software"), !hasHardware) << outcome;
}

TEST_F(RenderDevice, TheDeviceIsNamedOnceOnStandardError) {
    const std::string index = softwareDevice();
    const std::string name = withoutVectorWidth(listDevices().at(std::stoul(index)).at("name"));
    const Outcome outcome = run("render spheres -o a.png --device " + index + smallOnDevice);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, name)) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "software")) << outcome;
    EXPECT_EQ(outcome.errors.find("software"), outcome.errors.rfind("software")) << outcome;
    const std::string firstWord = name.substr(0, name.find(' '));
    EXPECT_EQ(outcome.errors.find(firstWord), outcome.errors.rfind(firstWord)) << outcome;
    EXPECT_FALSE(contains(outcome.output, name)) << outcome;
}

TEST_F(RenderDevice, TheReferenceRendererIsNamedToo) {
    const Outcome outcome = run("render spheres -o a.png --device cpu" + smallOnDevice);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "cpu")) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "reference")) << outcome;
}

TEST_F(RenderDevice, AnUnknownDeviceIsAnsweredWithTheList) {
    std::vector<std::string> names{"cpu"};
    for (const nlohmann::json &device : listDevices())
        names.push_back(withoutVectorWidth(device.at("name")));
    for (const char *wanted : {"nonesuch", "99", "-1", "''", "99999999999999999999"})
        expectFailure("render spheres -o a.png --device " + std::string(wanted) + smallOnDevice, 4, names);
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderDevice, WithoutADriverItSaysWhatToInstall) {
    for (const char *line :
         {"render spheres -o a.png", "render spheres -o a.png --device 0", "devices", "devices --json"}) {
        const Outcome outcome = runIn(withoutDriver(), line);
        EXPECT_EQ(outcome.exitCode, 4) << line << '\n' << outcome;
        EXPECT_TRUE(contains(outcome.errors, "install")) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "mesa-vulkan-drivers")) << outcome;
        EXPECT_EQ(outcome.output, "") << line;
    }
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderDevice, WithoutADriverTheReferenceRendererStillRenders) {
    const Outcome outcome = runIn(withoutDriver(), "render spheres -o a.png --device cpu" + smallOnDevice);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(entries(), std::set<std::string>{"a.png"});
    // The remedy that needs no installation.
    EXPECT_TRUE(contains(runIn(withoutDriver(), "render spheres -o b.png").errors, "--device cpu"));
}

TEST_F(RenderDevice, TheNumberOfThreadsDoesNotChangeTheImage) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    const std::string wanted = renderPfm("sheet.json" + smallOnDevice + " --device cpu");
    for (const std::string &device : {std::string("cpu"), softwareDevice()})
        for (const char *threads : {"1", "2"})
            EXPECT_EQ(
                renderPfm("sheet.json" + smallOnDevice + " --device " + device + " --threads " + threads),
                wanted)
                << device << ", " << threads;
}

TEST_F(RenderDevice, TheKernelDoesNotChangeTheImage) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    const std::string wanted = renderPfm("sheet.json" + smallOnDevice + " --device cpu");
    for (const auto &[kernel, row] : gpu::kernelNames)
        if (hasKernel(row)) {
            EXPECT_EQ(renderPfm(fmt::format("sheet.json{} --device {} --kernel {}", smallOnDevice,
                                            softwareDevice(), kernel)),
                      wanted)
                << kernel;
        }
}

TEST_F(RenderDevice, RefusesRayQueriesWhereTheDeviceHasNone) {
    if (hasKernel(gpu::findKernel("ray-query")))
        GTEST_SKIP() << "this one has them";
    const Outcome outcome =
        run("render spheres --width 16 --height 16 --kernel ray-query -o a.pfm --device " + softwareDevice());
    EXPECT_EQ(outcome.exitCode, 5) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "the kernel ray-query cannot run on llvmpipe")) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "it offers no ray queries (VK_KHR_ray_query)")) << outcome;
}

TEST_F(RenderDevice, TakesTheKernelInPlaceOfOneThatIsGone) {
    const std::string line = "spheres --width 16 --height 16 --spp 1 --device " + softwareDevice();
    const Outcome outcome = run("render " + line + " --kernel stack-x2 -o a.pfm --report r.json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "note: the kernel stack-x2 is gone, as it was slower; stack is"))
        << outcome;
    EXPECT_EQ(nlohmann::json::parse(load("r.json")).at("device").at("kernel").at("name"), "stack");
}

TEST_F(RenderDevice, TheWidthOfVectorsDoesNotChangeTheImage) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    for (const std::string scene : {"spheres", "spheres --integrator path", "sheet.json", "many-lights"}) {
        const std::string wanted = renderPfm(scene + smallOnDevice + " --device cpu");
        for (const std::string bits : {"128", "256", "512"}) {
            Surroundings surroundings;
            surroundings.environment["LP_NATIVE_VECTOR_WIDTH"] = bits;
            const Outcome outcome = runIn(surroundings, "render " + scene + smallOnDevice +
                                                            " -o wide.pfm --device " + softwareDevice());
            ASSERT_EQ(outcome.exitCode, 0) << outcome;
            EXPECT_TRUE(contains(outcome.errors, bits + " bits")) << outcome;
            EXPECT_EQ(load("wide.pfm"), wanted) << scene << ", " << bits << " bits";
        }
    }
}

TEST_F(RenderDevice, VectorsAreWideUnlessGlassSplitsRaysDeeply) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    const bool hasWideVectors = gpu::hasWideVectors();
    const auto isWide = [&](const std::string &scene) {
        Surroundings surroundings;
        surroundings.environment["LP_NATIVE_VECTOR_WIDTH"] = std::nullopt;
        const Outcome outcome = runIn(surroundings, "render " + scene + smallOnDevice +
                                                        " -o wide.pfm --device " + softwareDevice());
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        return contains(outcome.errors, "512 bits");
    };
    EXPECT_EQ(isWide("spheres"), hasWideVectors);
    EXPECT_EQ(isWide("spheres --integrator path"), hasWideVectors);
    EXPECT_EQ(isWide("sheet.json --max-depth 5"), hasWideVectors);
    EXPECT_EQ(isWide("sheet.json --integrator ao"), hasWideVectors);
    EXPECT_EQ(isWide("sheet.json --integrator path"), hasWideVectors);
    EXPECT_EQ(isWide("cornell"), hasWideVectors);
    EXPECT_FALSE(isWide("sheet.json --max-depth 6"));
    EXPECT_FALSE(isWide("spheres --max-depth 11"));
}

TEST_F(RenderDevice, OnlyVulkanDevicesHaveKernels) {
    expectFailure("render spheres -o a.png --device cpu --kernel stack", 2, {"--kernel", "cpu"});
    expectFailure("render spheres -o a.png --kernel heap", 2, {"--kernel", "heap", "skip-list-x2"});
}

TEST_F(RenderDevice, RepeatedRendersAreEqual) {
    const std::string line = "spheres --device " + softwareDevice() + smallOnDevice;
    EXPECT_EQ(renderPfm(line), renderPfm(line));
}

TEST_F(RenderDevice, TheLengthOfDispatchesChangesNothing) {
    const std::string line = "spheres --width 96 --height 96 --spp 4 --device " + softwareDevice();
    const std::string wanted = renderPfm(line);
    for (const char *millis : {"1", "2.5", "10000"})
        EXPECT_TRUE(renderPfm(line + " --max-dispatch-ms " + millis) == wanted) << millis;
    const long few = renderReport(line + " --max-dispatch-ms 10000").at("dispatches");
    const long many = renderReport(line + " --max-dispatch-ms 1").at("dispatches");
    EXPECT_LT(few, many);
}

TEST_F(RenderDevice, TheLengthOfDispatchesHasLimits) {
    for (const char *millis : {"0", "0.9", "-1", "10001", "nan", "x"})
        expectFailure("render spheres -o a.png --max-dispatch-ms " + std::string(millis), 2,
                      {"--max-dispatch-ms", "1 to 10000"});
}

} // namespace
} // namespace hyalite::core::testing
