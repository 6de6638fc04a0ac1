// What a process renders again and again leaves nothing behind, on the device or in memory.
#include "host/process/process.h"
#include "tests/cli/fault_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <malloc.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace hyalite::core::testing {
namespace {

class ManyRenders : public FaultyDevice {
  protected:
    void render(int count) {
        const std::string line = "render spheres --quiet --width 8 --height 8 --spp 1 --device 0 -o " +
                                 (folder / "a.pfm").string();
        for (int i = 0; i < count; ++i) {
            ASSERT_EQ(runHere(line, "").exitCode, 0);
            ASSERT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
        }
    }
};

TEST_F(ManyRenders, LeaveNoVulkanObjectBehind) { render(20); }

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
struct Memory {
    double residentKibibytes = 0.0;
    double allocatedKibibytes = 0.0;
};

Memory memoryNow() {
    std::ifstream stream("/proc/self/statm");
    double pages = 0.0;
    double residentPages = 0.0;
    stream >> pages >> residentPages;
    return {residentPages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0,
            static_cast<double>(mallinfo2().uordblks) / 1024.0};
}

// A leak grows in every batch; pages that come and go with what happens to be free do not: the least growth is judged,
// of up to ten batches.
TEST_F(ManyRenders, GrowNoMemory) {
    // For long runs by hand: HYALITE_TEST_SCALE=10 renders a thousand times.
    const char *scale = std::getenv("HYALITE_TEST_SCALE");
    const int count = 20 * std::clamp(scale != nullptr ? std::atoi(scale) : 1, 1, 1000);
    prepareProcess();
    prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0); // pages of 2 MiB would hide what is looked for
    render(20);                            // until the heap has its holes
    // The loader and lavapipe keep 0.2 KiB of each instance that there ever was. With a heap a thread a render took 17
    // KiB of resident memory.
    const Memory limit{5.0 * count, 1.0 * count};
    Memory least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    const auto isWithin = [&] {
        return least.residentKibibytes < limit.residentKibibytes &&
               least.allocatedKibibytes < limit.allocatedKibibytes;
    };
    for (int batch = 0; batch < 10 && !isWithin(); ++batch) {
        const Memory before = memoryNow();
        render(count);
        const Memory after = memoryNow();
        const Memory growth{after.residentKibibytes - before.residentKibibytes,
                            after.allocatedKibibytes - before.allocatedKibibytes};
        fmt::print("    {} renders: {:.1f} KiB more allocated, {:.0f} KiB more resident\n", count,
                   growth.allocatedKibibytes, growth.residentKibibytes);
        least.residentKibibytes = std::min(least.residentKibibytes, growth.residentKibibytes);
        least.allocatedKibibytes = std::min(least.allocatedKibibytes, growth.allocatedKibibytes);
    }
    EXPECT_LT(least.allocatedKibibytes, limit.allocatedKibibytes);
    EXPECT_LT(least.residentKibibytes, limit.residentKibibytes);
}
#endif

} // namespace
} // namespace hyalite::core::testing
