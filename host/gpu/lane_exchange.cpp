#include "host/gpu/lane_exchange.h"

#include "host/gpu/kernel.h"
#include "host/gpu/vk/device_list.h"
#include "shaders/embedded_kernels.h"
#include "shaders/layout/layout.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hyalite::core::gpu {

namespace {

constexpr int runCount = 3; // the least of them counts, as others may want the processor

double secondsOf(Kernel &kernel) {
    double least = kernel.run({}, 1).best().seconds(); // and is compiled, by some drivers
    for (int run = 0; run < runCount; ++run)
        least = std::min(least, kernel.run({}, 1).best().seconds());
    return least;
}

} // namespace

bool mayGainFromBroadcasts(const DeviceInfo &device) {
    return device.isSoftware() && device.canShuffle && device.consecutiveLanes == layout::broadcastLanes;
}

bool areBroadcastsFaster(Device &device) {
    constexpr std::size_t invocations = 64;
    const Buffer results(device, "the results of the lane exchange", BufferUse::Counters,
                         invocations * sizeof(std::uint32_t));
    const std::array<const Buffer *, 1> buffers{&results};
    const auto secondsBy = [&](bool isBroadcasting) {
        SpecializationConstants constants{};
        constants[layout::constantBroadcasts] = isBroadcasting;
        Kernel kernel(device, "laneExchange", embeddedKernel("laneExchange"), constants, buffers);
        return secondsOf(kernel);
    };
    return secondsBy(true) < secondsBy(false);
}

} // namespace hyalite::core::gpu
