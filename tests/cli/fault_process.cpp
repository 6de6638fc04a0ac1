#include "tests/cli/fault_process.h"

#include "host/base/error.h"
#include "host/cli/commands.h"
#include "host/cli/failure.h"
#include "tests/faults/fault_layer.h"

#include <exception>
#include <sstream>

#include <dlfcn.h>
#include <stdlib.h>

namespace hyalite::core::testing {

// Mesa's layer that sorts devices makes calls of its own: it stays out.
const std::map<std::string, std::string> layerEnvironment{{"VK_ADD_LAYER_PATH", HYALITE_FAULT_LAYER_FOLDER},
                                                          {"VK_INSTANCE_LAYERS", "VK_LAYER_HYALITE_faults"},
                                                          {"NODEVICE_SELECT", "1"}};

namespace {

template <class Function> Function loadersOwn(const char *name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

Tally parseTally(const std::string &text) {
    Tally tally;
    std::istringstream lines(text);
    std::string kind, function;
    for (long number = 0; lines >> kind >> function >> number;)
        if (kind == "call")
            tally.calls[function] = number;
        else if (kind == "alive")
            tally.alive[function] = number;
        else
            tally.faults.push_back(function);
    return tally;
}

void FaultyDevice::SetUp() {
    CommandLine::SetUp();
    for (const auto &[name, value] : layerEnvironment)
        setenv(name.c_str(), value.c_str(), 1);
    setenv("HYALITE_CACHE", (folder / "cache").c_str(), 1); // not the user's own
    // Measurements of the device are made once and kept, so that the calls of what follows can be counted.
    static_cast<void>(runIn({}, "render spheres --width 8 --height 8 --spp 1 -o measured.pfm --quiet"));
    std::filesystem::remove(folder / "measured.pfm");
    setenv("HYALITE_VALIDATION", "0", 1); // it would take most of the time, and is asked for where it matters
}

void FaultyDevice::TearDown() {
    hyaliteSetFaults("");
    hyaliteSetFakes("");
    for (const auto &[name, value] : layerEnvironment)
        unsetenv(name.c_str());
    CommandLine::TearDown();
}

Outcome FaultyDevice::runFaulty(const std::string &line, const std::string &faults, const std::string &fakes,
                                bool isValidated) {
    Surroundings surroundings;
    surroundings.environment = {{"HYALITE_FAULTS", faults},
                                {"HYALITE_FAKES", fakes},
                                {"HYALITE_FAULT_TALLY", (folder / "tally").string()},
                                {"HYALITE_VALIDATION", isValidated ? "1" : "0"}};
    const Outcome outcome = runIn(surroundings, line);
    EXPECT_TRUE(entries().contains("tally")) << "it ended before its end: " << outcome;
    lastTally = parseTally(load("tally"));
    std::filesystem::remove(folder / "tally");
    return outcome;
}

Outcome FaultyDevice::runHere(const std::string &line, const std::string &faults, const std::string &fakes) {
    hyaliteSetFakes(fakes.c_str());
    hyaliteSetFaults(faults.c_str());
    CLI::App app;
    CommandContext context;
    context.commandLine = "hyalite " + line;
    addRenderCommand(app, context);
    addCompareCommand(app, context);
    addProfileCommand(app, context);
    addDevicesCommand(app, context);
    addVerifyCommand(app, context);
    Outcome outcome;
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    try {
        app.parse(line);
        outcome.exitCode = static_cast<int>(context.exitCode);
    } catch (const Error &) {
        const Failure failure = describeFailure(std::current_exception(), context.commandLine);
        outcome.exitCode = static_cast<int>(failure.code);
        outcome.errors = failure.message;
    }
    outcome.output = ::testing::internal::GetCapturedStdout();
    outcome.errors += ::testing::internal::GetCapturedStderr();
    lastTally = parseTally(hyaliteFaultTally());
    return outcome;
}

int exitCodeOf(const std::string &result) {
    if (result == "VK_TIMEOUT" || result == "VK_ERROR_DEVICE_LOST")
        return 6;
    return result == "VK_ERROR_INITIALIZATION_FAILED" ? 4 : 5;
}

} // namespace hyalite::core::testing

// Before there is an instance no layer is asked: these stand in for the loader's own.

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceLayerProperties(std::uint32_t *count,
                                                                  VkLayerProperties *layers) {
    const VkResult fault = hyaliteNextFault("vkEnumerateInstanceLayerProperties");
    return fault != VK_SUCCESS ? fault
                               : hyalite::core::testing::loadersOwn<PFN_vkEnumerateInstanceLayerProperties>(
                                     "vkEnumerateInstanceLayerProperties")(count, layers);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceExtensionProperties(const char *layer, std::uint32_t *count,
                                                                      VkExtensionProperties *extensions) {
    const VkResult fault = hyaliteNextFault("vkEnumerateInstanceExtensionProperties");
    return fault != VK_SUCCESS
               ? fault
               : hyalite::core::testing::loadersOwn<PFN_vkEnumerateInstanceExtensionProperties>(
                     "vkEnumerateInstanceExtensionProperties")(layer, count, extensions);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceVersion(std::uint32_t *version) {
    const VkResult fault = hyaliteNextFault("vkEnumerateInstanceVersion");
    return fault != VK_SUCCESS ? fault
                               : hyalite::core::testing::loadersOwn<PFN_vkEnumerateInstanceVersion>(
                                     "vkEnumerateInstanceVersion")(version);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char *name) {
    if (instance == VK_NULL_HANDLE && std::strcmp(name, "vkEnumerateInstanceVersion") == 0)
        return hyaliteIsFaked("loader-1.0")
                   ? nullptr
                   : reinterpret_cast<PFN_vkVoidFunction>(vkEnumerateInstanceVersion);
    return hyalite::core::testing::loadersOwn<PFN_vkGetInstanceProcAddr>("vkGetInstanceProcAddr")(instance,
                                                                                                  name);
}
