// What a process renders again and again costs it no more memory, neither the host's nor the device's.
#include "tests/cli/fault_process.h"

#include <fstream>

#include <unistd.h>

namespace hyalite::testing {
namespace {

using ManyRenders = FaultyDevice;

long residentBytes() {
    std::ifstream stream("/proc/self/statm");
    long pages = 0;
    long resident = 0;
    stream >> pages >> resident;
    EXPECT_GT(resident, 0);
    return resident * sysconf(_SC_PAGESIZE);
}

TEST_F(ManyRenders, GrowNoMemory) {
    const std::string line =
        "render spheres --quiet --width 8 --height 8 --spp 1 --device 0 -o " + (folder / "a.pfm").string();
    constexpr int warmUpCount = 50; // caches fill, and the heap finds its size
    constexpr int renderCount = 200;
    long before = 0;
    for (int i = 0; i < renderCount; ++i) {
        if (i == warmUpCount)
            before = residentBytes();
        ASSERT_EQ(runHere(line, "").exitCode, 0);
        ASSERT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
    }
#ifndef __SANITIZE_ADDRESS__ // which keeps what is freed for a while
    // A buffer that leaked would cost a page or more each time.
    EXPECT_LT(residentBytes() - before, (renderCount - warmUpCount) * sysconf(_SC_PAGESIZE));
#endif
}

} // namespace
} // namespace hyalite::testing
