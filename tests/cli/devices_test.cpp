// The devices command: a table for people and JSON for programs, which say the same.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace hyalite::core::testing {
namespace {

using DevicesCommand = CommandLine;

TEST_F(DevicesCommand, JsonDescribesEachDevice) {
    const Outcome outcome = run("devices --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(outcome.errors, "");
    ASSERT_TRUE(nlohmann::json::parse(outcome.output).is_array());
    const nlohmann::json devices = listDevices();
    ASSERT_GE(devices.size(), 1u);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const nlohmann::json &device = devices[i];
        EXPECT_EQ(device.at("index"), i);
        for (const char *key : {"name", "type", "driver"})
            EXPECT_NE(device.at(key).get<std::string>(), "") << key;
        for (const char *workload : {"spheres", "triangles", "shading"})
            EXPECT_NE(device.at("kernels").at(workload).get<std::string>(), "") << workload;
        EXPECT_TRUE(std::regex_match(device.at("apiVersion").get<std::string>(),
                                     std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")));
        EXPECT_EQ(device.contains("rejection"), !device.at("isUsable").get<bool>());
        for (const char *key : {"hasTimestamps", "canRoundToNearestEven", "canPreserveSignedZeroInfNan"})
            EXPECT_TRUE(device.at(key).is_boolean()) << key;
        if (!device.at("isUsable"))
            continue;
        // What Vulkan 1.1 guarantees.
        EXPECT_GE(device.at("maxStorageBufferBytes"), 1 << 27);
        EXPECT_GE(device.at("maxStorageBuffersPerStage"), 4);
        EXPECT_GE(device.at("maxWorkgroupInvocations"), 128);
        EXPECT_GE(device.at("maxWorkgroupCount"), 65535);
        EXPECT_GE(device.at("subgroupSize"), 1);
        EXPECT_GT(device.at("deviceMemoryBytes"), 0);
    }
}

TEST_F(DevicesCommand, ThereIsAUsableSoftwareDevice) { EXPECT_NO_THROW(static_cast<void>(softwareDevice())); }

TEST_F(DevicesCommand, TheTableSaysTheSame) {
    const Outcome outcome = run("devices");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(outcome.errors, "");
    for (const nlohmann::json &device : listDevices()) {
        const std::string title = std::to_string(device.at("index").get<int>()) + "  " +
                                  device.at("name").get<std::string>() + "\n";
        EXPECT_TRUE(contains(outcome.output, title)) << title << outcome;
        for (const char *key : {"type", "driver", "apiVersion"})
            EXPECT_TRUE(contains(outcome.output, device.at(key))) << key << '\n' << outcome;
        for (const auto &[workload, kernel] : device.at("kernels").items())
            EXPECT_TRUE(contains(outcome.output, kernel.get<std::string>() + " for " + workload)) << outcome;
        if (device.contains("rejection")) {
            EXPECT_TRUE(contains(outcome.output, device.at("rejection"))) << outcome;
        }
    }
}

TEST_F(DevicesCommand, TheReferenceRendererIsListedLast) {
    const Outcome outcome = run("devices");
    EXPECT_TRUE(std::regex_search(outcome.output, std::regex("\ncpu  [^\n]*reference[^\n]*\n$"))) << outcome;
    const nlohmann::json last = nlohmann::json::parse(run("devices --json").output).back();
    EXPECT_EQ(last.at("name"), "cpu"); // as --device takes it
    EXPECT_FALSE(last.contains("index"));
    EXPECT_TRUE(contains(last.at("type"), "reference"));
    EXPECT_TRUE(last.at("isUsable"));
}

TEST_F(DevicesCommand, WhatIsNotExpectedIsAUsageError) {
    expectFailure("devices all", 2, {"all"});
    expectFailure("devices --xml", 2, {"--xml"});
}

} // namespace
} // namespace hyalite::core::testing
