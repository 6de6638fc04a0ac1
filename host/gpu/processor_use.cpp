#include "host/gpu/processor_use.h"

#include "host/gpu/vk/instance.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite::gpu {

bool hasWideVectors() {
    // The extensions that compilers assume together.
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

namespace {

// Maximum depths for 512 bits with Whitted's rays: with glass they were slower for a mesh at depth 6, for spheres at
// depth 12.
constexpr int maxDepthInTree = 5;
constexpr int maxDepthOfSpheres = 10;

// In the environment itself, so that the value can change while other threads read other variables.
constexpr const char *widthVariable = "LP_NATIVE_VECTOR_WIDTH";
char widthSetting[] = "LP_NATIVE_VECTOR_WIDTH=512";

char *widthValue() { return std::strchr(widthSetting, '=') + 1; }

bool maySplitDeeply(const ProcessorUse &use) {
    return rowOf(use.integrator).splitsAtGlass &&
           use.maxDepth > (use.hasTriangles ? maxDepthInTree : maxDepthOfSpheres);
}

} // namespace

void tellLavapipe(const ProcessorUse &use) {
    if (use.threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(use.threadCount).c_str(), 1);
    if (!maySplitDeeply(use) && hasWideVectors() && std::getenv(widthVariable) == nullptr)
        putenv(widthSetting);
}

bool gainsFromWideVectors(const DeviceInfo &device) {
    constexpr std::string_view name = "Mesa ";
    constexpr int lastVersion = 22;
    const std::size_t at = device.driver.find(name);
    if (!device.isLavapipe() || at == std::string::npos)
        return false;
    int version = 0;
    const char *digits = device.driver.data() + at + name.size();
    const char *end = device.driver.data() + device.driver.size();
    return std::from_chars(digits, end, version).ec == std::errc{} && version <= lastVersion;
}

LoadedDevices loadDevices() {
    const auto load = [] {
        auto instance = std::make_shared<Instance>();
        auto devices = listDevices(*instance);
        return LoadedDevices{std::move(instance), std::move(devices)};
    };
    LoadedDevices loaded = load();
    const bool isWide = std::getenv(widthVariable) == widthValue() && std::strcmp(widthValue(), "512") == 0;
    const bool isLosing = std::ranges::any_of(loaded.devices, [](const DeviceInfo &device) {
        return device.isLavapipe() && !gainsFromWideVectors(device);
    });
    if (!isWide || !isLosing)
        return loaded;
    std::memcpy(widthValue(), "256", 3);
    loaded = {};
    return load();
}

} // namespace hyalite::gpu
