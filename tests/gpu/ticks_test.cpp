#include "host/gpu/memory_claim.h"
#include "host/gpu/vk/ticks.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace hyalite::core::gpu {
namespace {

constexpr std::uint64_t allBits = std::numeric_limits<std::uint64_t>::max();

TEST(Ticks, BitsThatAreNotValidMeanNothing) {
    EXPECT_EQ(validTicks(0xFFFF'FFFF'0000'0001u, 32), 1u);
    EXPECT_EQ(validTicks(allBits, 36), 0xF'FFFF'FFFFu);
    EXPECT_EQ(validTicks(allBits, 64), allBits);
    // Garbage above the valid bits does not reach the duration.
    EXPECT_EQ(elapsedTicks(0xABCD'0000'0000'0010u, 0x1234'0000'0000'0035u, 40, 1000), 0x25u);
}

TEST(Ticks, ElapseAcrossTheWrapOfTheCounter) {
    for (const std::uint32_t bits : {36u, 40u, 48u, 63u, 64u}) {
        const std::uint64_t last = validTicks(allBits, bits);
        EXPECT_EQ(elapsedTicks(last - 9, 5, bits, 1000), 15u) << bits;
        EXPECT_EQ(elapsedTicks(last, 0, bits, 1), 1u) << bits;
        EXPECT_EQ(elapsedTicks(7, 7, bits, 0), 0u) << bits;
    }
}

TEST(Ticks, ALongDispatchMayOutlastSeveralWraps) {
    const std::uint64_t wrap = std::uint64_t{1} << 36;
    for (const std::uint64_t elapsed : {wrap - 1, wrap, wrap + 1, 3 * wrap + 12345, 100 * wrap}) {
        const std::uint64_t begin = wrap - 777;
        const std::uint64_t end = validTicks(begin + elapsed, 36);
        // The host has measured a little more, and knows no better.
        for (const std::uint64_t overhead : {std::uint64_t{0}, std::uint64_t{1000}, wrap - 1})
            EXPECT_EQ(elapsedTicks(begin, end, 36, elapsed + overhead), elapsed);
    }
}

TEST(Ticks, ADeviceClockThatRunsFastIsBelieved) {
    EXPECT_EQ(elapsedTicks(100, 1100, 40, 990), 1000u);
    EXPECT_EQ(elapsedTicks(100, 1100, 64, 0), 1000u);
}

TEST(Ticks, LieBeforeOrAfterAReference) {
    for (const std::uint32_t bits : {36u, 64u}) {
        EXPECT_EQ(signedTicks(1000, 1042, bits), 42);
        EXPECT_EQ(signedTicks(1000, 958, bits), -42);
        EXPECT_EQ(signedTicks(1000, 1000, bits), 0);
        EXPECT_EQ(signedTicks(validTicks(allBits, bits), 4, bits), 5) << "the counter wraps";
        EXPECT_EQ(signedTicks(4, validTicks(allBits, bits), bits), -5) << "the counter wraps";
    }
}

TEST(MemoryClaim, CountsWhileItLives) {
    std::uint64_t total = 0;
    {
        MemoryClaim first(total, 100);
        MemoryClaim second;
        EXPECT_EQ(total, 100u);
        second = MemoryClaim(total, 20);
        EXPECT_EQ(total, 120u);
        const MemoryClaim third(std::move(first));
        EXPECT_EQ(total, 120u);
        second = MemoryClaim(total, 3);
        EXPECT_EQ(total, 103u);
    }
    EXPECT_EQ(total, 0u);
}

} // namespace
} // namespace hyalite::core::gpu
