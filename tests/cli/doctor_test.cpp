// The doctor command: what it says of machines with drivers, with faulty ones and without any.
#include "tests/cli/fault_process.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Doctor : public FaultyDevice {
  protected:
    [[nodiscard]] std::set<std::string> problems() const {
        std::set<std::string> codes;
        const Json document = report();
        for (const Json &finding : document.at("findings"))
            if (finding.at("isProblem"))
                codes.insert(finding.at("code").get<std::string>());
        return codes;
    }
    /// Where the loader finds no driver but those in this folder's icd.d.
    [[nodiscard]] Surroundings alone() const {
        Surroundings surroundings;
        surroundings.environment = {
            {"XDG_DATA_DIRS", folder.string()},   {"XDG_CONFIG_DIRS", folder.string()},
            {"XDG_DATA_HOME", folder.string()},   {"XDG_CONFIG_HOME", folder.string()},
            {"VK_DRIVER_FILES", std::nullopt},    {"VK_ICD_FILENAMES", std::nullopt},
            {"VK_ADD_DRIVER_FILES", std::nullopt}};
        return surroundings;
    }
};

TEST_F(Doctor, DescribesMachineAndDevices) {
    const Outcome outcome = run("doctor --report r.json" + atOnce);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_TRUE(contains(outcome.output, "ready to render\n")) << outcome;
    const Json document = report();
    for (const char *key : {"doctorVersion", "program", "commandLine", "date", "filmsVersion", "machine",
                            "devices", "findings"})
        EXPECT_TRUE(document.contains(key)) << key;
    EXPECT_EQ(document.at("doctorVersion"), 1);
    for (const char *key : {"system", "kernel", "architecture", "libc", "processor", "threads", "isContainer",
                            "cards", "nodes", "variables", "drivers"})
        EXPECT_TRUE(document.at("machine").contains(key)) << key;
    const Json devices = listDevices();
    ASSERT_EQ(document.at("devices").size(), devices.size() + 1);
    EXPECT_EQ(document.at("devices")[0].at("name"), "cpu");
    for (std::size_t i = 0; i < devices.size(); ++i) {
        for (const char *key : {"name", "driver", "equalBits", "isUsable"})
            EXPECT_EQ(document.at("devices")[i + 1].at(key), devices[i].at(key)) << key;
        EXPECT_TRUE(contains(outcome.output, devices[i].at("name")));
    }
}

TEST_F(Doctor, ChecksBitsAndSpeed) {
    const Outcome outcome = run("doctor --device cpu --report r.json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    const Json cpu = report().at("devices").at(0);
    const Json bits = cpu.at("bits");
    EXPECT_TRUE(bits.at("isWhole").get<bool>()) << bits;
    EXPECT_GE(bits.at("rendered"), 10);
    EXPECT_EQ(bits.at("equal"), bits.at("rendered"));
    EXPECT_EQ(bits.at("faults"), Json::array());
    for (const char *scene : {"spheres", "cat", "studio-cat"}) {
        EXPECT_GT(cpu.at("megaraysPerSecond").at(scene), 0.0);
        EXPECT_TRUE(contains(outcome.output, scene)) << outcome;
    }
}

TEST_F(Doctor, SaysWhereNoDriverIs) {
    const Outcome outcome = runIn(alone(), "doctor --report r.json" + atOnce);
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    EXPECT_TRUE(problems().contains("no-driver")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "mesa-vulkan-drivers")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "no Vulkan device can be used; --device cpu renders without"))
        << outcome;
    EXPECT_EQ(report().at("devices").size(), 1u) << "the CPU needs none";
    EXPECT_EQ(runIn(alone(), "doctor --device cpu" + atOnce).exitCode, 0) << "nobody asked for Vulkan";
}

TEST_F(Doctor, NamesADriverThatDoesNotLoad) {
    fs::create_directories(folder / "vulkan/icd.d");
    store("vulkan/icd.d/broken.json", R"({"file_format_version": "1.0.0",
          "ICD": {"library_path": "/nonexistent/libvulkan_broken.so", "api_version": "1.1.0"}})");
    const Outcome outcome = runIn(alone(), "doctor --report r.json" + atOnce);
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    EXPECT_TRUE(problems().contains("driver-file")) << outcome;
    EXPECT_FALSE(problems().contains("no-driver")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "broken.json")) << outcome;
}

TEST_F(Doctor, SaysThatAVariableHidesDrivers) {
    Surroundings surroundings;
    surroundings.environment["VK_DRIVER_FILES"] = "/nonexistent/driver.json";
    surroundings.environment["VK_ICD_FILENAMES"] = "/nonexistent/driver.json";
    const Outcome outcome = runIn(surroundings, "doctor --report r.json" + atOnce);
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    EXPECT_TRUE(contains(outcome.output, "VK_DRIVER_FILES is /nonexistent/driver.json")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "there is no file /nonexistent/driver.json")) << outcome;
}

TEST_F(Doctor, SaysWhyADeviceCannotBeUsed) {
    Surroundings surroundings;
    surroundings.environment["HYALITE_FAKES"] = "few-images,few-storage-buffers";
    const Outcome outcome = runIn(surroundings, "doctor --report r.json" + atOnce);
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    EXPECT_TRUE(problems().contains("unusable-device")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "NOT usable: ")) << outcome;
}

TEST_F(Doctor, RefusesWhatIsNotThere) {
    expectFailure("doctor --device no-such-device" + atOnce, 4, {"no-such-device"});
    expectFailure("doctor now", 2, {"now"});
    Surroundings surroundings;
    surroundings.environment["HYALITE_BUNDLED_DRIVER"] = "yes";
    EXPECT_EQ(runIn(surroundings, "devices").exitCode, 2);
    surroundings.environment["HYALITE_BUNDLED_DRIVER"] = "1";
    const Outcome outcome = runIn(surroundings, "devices");
    EXPECT_EQ(outcome.exitCode, 4) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "HYALITE_BUNDLED_DRIVER is 1")) << outcome;
}

} // namespace
} // namespace hyalite::core::testing
