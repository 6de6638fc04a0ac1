// Every Vulkan call of the program fails once, in every way that it can: the exit code and the message say so, and
// nothing is left behind. The layer in tests/faults makes them fail.
#include "tests/cli/fault_process.h"
#include "tests/faults/fault_layer.h"
#include "tests/fixtures/test_extent.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace hyalite::core::testing {
namespace {

const std::string smallFaulty = " --width 8 --height 8 --spp 1";

std::string textOf(const std::filesystem::path &path) {
    std::ifstream stream(path);
    EXPECT_TRUE(stream.good()) << path;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::set<std::string> matches(const std::string &text, const std::string &expression) {
    const std::regex regex(expression);
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        found.insert((*at)[1]);
    return found;
}

/// What a call can return, by the specification, as far as the program tells results apart.
std::vector<std::string> resultsOf(const std::string &function) {
    std::vector<std::string> results{"VK_ERROR_OUT_OF_HOST_MEMORY", "VK_ERROR_OUT_OF_DEVICE_MEMORY"};
    const auto isOneOf = [&](std::initializer_list<const char *> names) {
        return std::find(names.begin(), names.end(), function) != names.end();
    };
    if (isOneOf({"vkCreateInstance", "vkCreateDevice", "vkEnumeratePhysicalDevices"}))
        results.push_back("VK_ERROR_INITIALIZATION_FAILED");
    if (isOneOf({"vkCreateDevice", "vkQueueSubmit", "vkWaitForFences", "vkGetQueryPoolResults"}))
        results.push_back("VK_ERROR_DEVICE_LOST");
    if (function == "vkMapMemory")
        results.push_back("VK_ERROR_MEMORY_MAP_FAILED");
    return results;
}

/// Each buffer and each submission, of which six are usual; of what is called with them, and of names, a few.
std::vector<long> chooseCalls(const std::string &function, long count) {
    const bool isEach =
        function == "vkAllocateMemory" || function == "vkQueueSubmit" || function == "vkWaitForFences";
    const long stride = isEach && isTestingAll() ? 1 : std::max(count / (isEach ? 6 : 3), 1l);
    std::vector<long> chosen;
    for (long call = 1; call <= count; call += stride)
        chosen.push_back(call);
    return chosen;
}

class DeviceFaults : public FaultyDevice {
  protected:
    /// Expects the first fault to be told and nothing to be left.
    void expectTold(const Outcome &outcome, const std::string &function, const std::string &result) const {
        EXPECT_EQ(outcome.exitCode, exitCodeOf(result)) << outcome;
        // The loader asks for extensions, too, while it makes a device.
        const bool isOfLoader = function == "vkEnumerateDeviceExtensionProperties" &&
                                contains(outcome.errors, "vkCreateDevice for ");
        EXPECT_TRUE(isOfLoader || contains(outcome.errors, function + " for ")) << outcome;
        EXPECT_TRUE(contains(outcome.errors, result)) << outcome;
        EXPECT_EQ(lastTally.faults.empty() ? "nothing" : lastTally.faults.front(), function);
        EXPECT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
        EXPECT_EQ(entries(), std::set<std::string>{}) << "files are left";
    }

    /// Lets each call of `line` fail, one in each run, in every way that it can if everything is tested. `known`: how
    /// often functions are called elsewhere, where the same numbers of calls fail.
    void failEachCall(const std::string &line, const std::string &fakes,
                      const std::map<std::string, long> &known = {}) {
        ASSERT_EQ(runHere(line, "", fakes).exitCode, 0);
        EXPECT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
        const bool hasPicture = entries().contains("a.pfm");
        const std::string wanted = hasPicture ? load("a.pfm") : "";
        std::filesystem::remove(folder / "a.pfm");
        int recoveredCount = 0;
        std::map<std::string, long> calls = lastTally.calls;
        std::erase_if(calls, [&](const auto &call) {
            return known.contains(call.first) && known.at(call.first) == call.second;
        });
        ASSERT_FALSE(calls.empty());
        std::size_t turn = 0;
        for (const auto &[function, count] : calls)
            for (const long call : chooseCalls(function, count)) {
                std::vector<std::string> results = resultsOf(function);
                if (call > 1 || !isTestingAll()) // the same line of ours, for another object
                    results = {results[turn++ % results.size()]};
                for (const std::string &result : results) {
                    const std::string fault = fmt::format("{}:{}:{}", function, call, result);
                    SCOPED_TRACE(fault + " in " + line);
                    const Outcome outcome = runHere(line, fault, fakes);
                    // How often clocks are read and work is cut depends on the time: there may be fewer calls now.
                    const bool isUnfaulted = lastTally.faults.empty() && lastTally.calls[function] < call;
                    // What fails once while the device renders is done again.
                    const bool isRecovered = contains(outcome.errors, "note: " + function);
                    if (outcome.exitCode == 0 && (isUnfaulted || isRecovered)) {
                        EXPECT_TRUE(isUnfaulted || contains(outcome.errors, result)) << outcome;
                        EXPECT_TRUE(!hasPicture || load("a.pfm") == wanted);
                        std::filesystem::remove(folder / "a.pfm");
                        recoveredCount += isRecovered ? 1 : 0;
                    } else {
                        expectTold(outcome, function, result);
                    }
                    if (HasFailure())
                        return;
                }
            }
        EXPECT_EQ(recoveredCount > 0, hasPicture);
        for (const auto &[function, count] : calls)
            visited.insert(function);
    }

    std::set<std::string> visited;
};

TEST_F(DeviceFaults, TheLayerKnowsEveryCallThatCanFail) {
    std::string sources;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(HYALITE_SOURCE_DIR "/host/gpu"))
        sources += textOf(entry.path());
    const std::set<std::string> called = matches(sources, R"(\b(vk[A-Z]\w+))");
    const std::set<std::string> fallible =
        matches(textOf(HYALITE_VULKAN_HEADER), R"(typedef VkResult \(VKAPI_PTR \*PFN_(vk\w+)\))");
    ASSERT_GT(fallible.size(), 100u);
    const std::set<std::string> loadersOwn{"vkEnumerateInstanceExtensionProperties",
                                           "vkEnumerateInstanceLayerProperties",
                                           "vkEnumerateInstanceVersion"}; // fault_process.cpp
    std::size_t count = 0;
    for (const std::string &function : called) {
        if (!fallible.contains(function))
            continue;
        ++count;
        EXPECT_TRUE(hyaliteCanFail(function.c_str()) || loadersOwn.contains(function))
            << function << " is called by host/gpu: add it to tests/faults/layer.cpp";
    }
    EXPECT_GT(count, 20u);
}

TEST_F(DeviceFaults, EachCallOfARenderIsChecked) {
    failEachCall("render spheres --quiet -o " + (folder / "a.pfm").string() + smallFaulty, "calibrated");
    for (const char *function : {"vkGetCalibratedTimestampsEXT", "vkCreateBufferView", "vkWaitForFences",
                                 "vkEnumerateInstanceExtensionProperties", "vkEnumerateInstanceVersion"})
        EXPECT_TRUE(visited.contains(function)) << function;
}

TEST_F(DeviceFaults, EachCallOfARenderThroughStagingBuffersIsChecked) {
    const std::string line = "render spheres --quiet -o " + (folder / "a.pfm").string() + smallFaulty;
    std::map<std::string, long> known;
    if (!isTestingAll()) {
        ASSERT_EQ(runHere(line, "", "calibrated").exitCode, 0);
        known = lastTally.calls;
        std::filesystem::remove(folder / "a.pfm");
    }
    failEachCall(line, "discrete", known);
}

TEST_F(DeviceFaults, EachCallOfTheListOfDevicesIsChecked) { failEachCall("devices", ""); }

TEST_F(DeviceFaults, EveryCommandTellsThem) {
    struct Case {
        std::string line;
        std::string function;
        std::string call;
        std::string result;
    };
    const Case cases[] = {
        {"render spheres -o a.png", "vkQueueSubmit", "3+", "VK_ERROR_DEVICE_LOST"},
        {"render spheres -o a.pfm --report r.json", "vkAllocateMemory", "12+",
         "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
        {"compare spheres --report r.json", "vkWaitForFences", "3+", "VK_ERROR_DEVICE_LOST"},
        {"profile spheres --repeat 1 --report r.json", "vkGetQueryPoolResults", "5+",
         "VK_ERROR_OUT_OF_HOST_MEMORY"},
        {"profile spheres --repeat 1 -o a.png", "vkCreateComputePipelines", "2+",
         "VK_ERROR_OUT_OF_HOST_MEMORY"},
        {"devices --json", "vkCreateInstance", "1", "VK_ERROR_INITIALIZATION_FAILED"},
    };
    for (const Case &c : cases)
        for (const bool isValidated : {false, true}) {
            const std::string line = c.line + (contains(c.line, "devices") ? "" : smallFaulty);
            const Outcome outcome =
                runFaulty(line, fmt::format("{}:{}:{}", c.function, c.call, c.result), "", isValidated);
            SCOPED_TRACE(line);
            expectTold(outcome, c.function, c.result);
            EXPECT_FALSE(contains(outcome.errors, "validation:")) << outcome;
        }
}

TEST_F(DeviceFaults, AFailingDispatchIsNamed) {
    const Outcome outcome =
        runFaulty("render spheres -o a.png --crop 16,24,8,16 --width 32 --height 32 --spp 3",
                  "vkWaitForFences:3:VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(outcome.exitCode, 0) << "it is done again: " << outcome;
    EXPECT_TRUE(contains(outcome.errors, "kernel whitted skip-list, tile (16, 8), samples 0 to 3"))
        << outcome;
}

} // namespace
} // namespace hyalite::core::testing
