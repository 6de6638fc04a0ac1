// Values that lanes exchange, by shuffles and by broadcasts.
#include "host/gpu/kernel.h"
#include "shaders/embedded_kernels.h"
#include "tests/kernels/probe_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace hyalite::core::testing {
namespace {

constexpr std::size_t invocations = 64;
constexpr std::size_t samplesInFlight = 8;

/// What shaders/kernels/lane_exchange.comp computes.
std::vector<std::uint32_t> expectedResults() {
    std::vector<std::uint32_t> mine(invocations);
    std::iota(mine.begin(), mine.end(), 0u);
    for (int exchange = 0; exchange < 300; ++exchange)
        for (std::size_t first = 0; first < invocations; first += samplesInFlight) {
            const std::span pixel = std::span(mine).subspan(first, samplesInFlight);
            const std::vector<std::uint32_t> values(pixel.begin(), pixel.end());
            for (std::uint32_t &one : pixel)
                for (const std::uint32_t value : values)
                    one = one * 5u + value;
            const bool isTrueForAll =
                std::ranges::all_of(pixel, [](std::uint32_t one) { return (one & 0x1010u) != 0; });
            for (std::uint32_t &one : pixel)
                one += isTrueForAll ? 1u : 0u;
        }
    return mine;
}

std::vector<std::uint32_t> resultsBy(bool isBroadcasting) {
    std::vector<std::uint32_t> results(invocations);
    const gpu::Buffer buffer(probeDevice(), "results", gpu::BufferUse::Counters,
                             std::as_bytes(std::span(results)).size());
    const std::array<const gpu::Buffer *, 1> buffers{&buffer};
    gpu::SpecializationConstants constants{};
    constants[layout::constantBroadcasts] = isBroadcasting;
    gpu::Kernel kernel(probeDevice(), "laneExchange", embeddedKernel("laneExchange"), constants, buffers);
    kernel.run({}, 1);
    buffer.download(std::as_writable_bytes(std::span(results)));
    return results;
}

TEST(LaneExchange, ByShufflesIsThatOfTheSlotsOfAPixel) {
    if (probeDevice().info().subgroupSize < samplesInFlight)
        GTEST_SKIP() << "subgroups of " << probeDevice().info().subgroupSize;
    EXPECT_EQ(resultsBy(false), expectedResults());
}

TEST(LaneExchange, ByBroadcastsIsTheSame) {
    if (probeDevice().info().subgroupSize != layout::broadcastLanes)
        GTEST_SKIP() << "subgroups of " << probeDevice().info().subgroupSize;
    EXPECT_EQ(resultsBy(true), expectedResults());
}

} // namespace
} // namespace hyalite::core::testing
