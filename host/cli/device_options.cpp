#include "host/cli/device_options.h"

#include "host/base/message.h"
#include "host/cli/options.h"
#include "host/scene/limits.h"

namespace hyalite::core {

namespace {

constexpr Interval dispatchMillis{1.0, 10'000.0};

} // namespace

CLI::Option *addDevicesOption(CLI::App &command, RendererNames &devices, const std::string &help) {
    return command.add_option("--device", devices, help)
        ->type_name("DEVICE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->capture_default_str();
}

void addThreadsOption(CLI::App &command, int &threadCount) {
    addNumber(command, "--threads", threadCount, limits::threadCount,
              "threads of the reference renderer and of lavapipe; default: all");
}

void addDeviceOptions(CLI::App &command, DeviceOptions &options) {
    addChoice(command, "--kernel", options.kernel, gpu::kernelNames,
              "how kernels go through the tree (x2: two paths an invocation); auto: as `hyalite devices` "
              "says. The image "
              "is the same")
        ->transform(presentKernelWord);
    addNumber(command, "--max-dispatch-ms", options.maxDispatchMillis, dispatchMillis,
              "how long a dispatch on a Vulkan device should take, in milliseconds: long ones block a "
              "display, short ones cost more. The image is the same")
        ->default_str(fmt::format("{}", options.maxDispatchMillis));
}

std::string presentKernelWord(const std::string &word) {
    std::string present(gpu::presentKernel(word));
    if (present != word)
        printMessage("note: the kernel {} is gone, as it was slower; {} is in its place\n", word, present);
    return present;
}

} // namespace hyalite::core
