// What a process renders again and again leaves nothing behind on the device.
#include "tests/cli/fault_process.h"

namespace hyalite::testing {
namespace {

using ManyRenders = FaultyDevice;

TEST_F(ManyRenders, LeaveNoVulkanObjectBehind) {
    const std::string line =
        "render spheres --quiet --width 8 --height 8 --spp 1 --device 0 -o " + (folder / "a.pfm").string();
    for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(runHere(line, "").exitCode, 0);
        ASSERT_TRUE(lastTally.alive.empty()) << ::testing::PrintToString(lastTally.alive);
    }
}

} // namespace
} // namespace hyalite::testing
