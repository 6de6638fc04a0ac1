#include "host/base/huge_pages.h"

#include <gtest/gtest.h>

#include <sys/mman.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

/// Whether huge pages are requested at this address: "hg" among its flags in /proc/self/smaps.
bool areRequestedAt(const void *memory) {
    const auto wanted = reinterpret_cast<std::uintptr_t>(memory);
    std::ifstream maps("/proc/self/smaps");
    bool isThere = false;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0;
        std::uintptr_t end = 0;
        if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2)
            isThere = begin <= wanted && wanted < end;
        if (isThere && line.starts_with("VmFlags:"))
            return (line + ' ').find(" hg ") != std::string::npos;
    }
    return false;
}

bool hasHugePages() { return std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled").good(); }

TEST(HugePages, AreRequestedForLargeArraysOnly) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer allocates";
#endif
    if (!hasHugePages())
        GTEST_SKIP() << "this kernel has none";
    const std::vector<std::byte> large(64 * mebibyte);
    EXPECT_TRUE(areRequestedAt(large.data()));
    EXPECT_TRUE(areRequestedAt(&large[62 * mebibyte]));
    const std::vector<std::byte> small(mebibyte / 2);
    EXPECT_FALSE(areRequestedAt(small.data()));
}

TEST(HugePages, AreNoneForMoreThanThereCanBe) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer allocates";
#endif
    const volatile std::size_t most = SIZE_MAX; // whole pages around it would begin at 0 again
    EXPECT_THROW(static_cast<void>(::operator new(most)), std::bad_alloc);
}

TEST(HugePages, AreRequestedWhereTheyLieWhollyInTheRange) {
    if (!hasHugePages())
        GTEST_SKIP() << "this kernel has none";
    void *mapped = mmap(nullptr, 8 * mebibyte, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(mapped, MAP_FAILED);
    const auto address = reinterpret_cast<std::uintptr_t>(mapped);
    std::byte *aligned = static_cast<std::byte *>(mapped) + (2 * mebibyte - address % (2 * mebibyte));
    preferHugePages(aligned - 1, 2 * mebibyte); // a byte short of one
    EXPECT_FALSE(areRequestedAt(aligned));
    preferHugePages(aligned - 1, 2 * mebibyte + 1);
    EXPECT_TRUE(areRequestedAt(aligned));
    EXPECT_FALSE(areRequestedAt(aligned - 1));
    EXPECT_FALSE(areRequestedAt(aligned + 2 * mebibyte));
    munmap(mapped, 8 * mebibyte);
}

TEST(HugePages, LeaveFailuresAsTheyAre) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer allocates";
#endif
    const volatile std::size_t tooMuch = std::size_t{1} << 50;
    EXPECT_THROW(std::make_unique<std::byte[]>(tooMuch), std::bad_alloc);
    EXPECT_EQ(new (std::nothrow) std::byte[tooMuch], nullptr);
    static int calls;
    calls = 0;
    std::set_new_handler([] {
        if (++calls == 2)
            std::set_new_handler(nullptr);
    });
    EXPECT_THROW(std::make_unique<std::byte[]>(tooMuch), std::bad_alloc);
    EXPECT_EQ(calls, 2);
}

} // namespace
} // namespace hyalite::core
