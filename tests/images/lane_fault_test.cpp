// A device of which one lane computes wrongly: a long verification names it.
#include "host/engine/device_backend.h"
#include "host/lab/shipped_films.h"
#include "host/lab/soak_report.h"
#include "tests/images/rendering.h"

#include "faultInLane.h"

#include <gtest/gtest.h>

#include <stdlib.h>

namespace hyalite::core {
namespace {

TEST(LaneFault, IsTracedToItsLane) {
    setenv("HYALITE_ASSETS", HYALITE_ASSET_DIR, 1);
    Loads loads = readLoads();
    loads.loads.resize(1);
    loads.loads.front().small = {32, 24, 1, 0};
    LoadSize &size = loads.loads.front().small;
    const PreparedScene scene = prepareLoad(loads, loads.loads.front(), size);
    size.hash =
        filmHash(openBackend("cpu", nobody())->render(scene.packed, scene.loaded.settings, scene.crop).film);
    const std::unique_ptr<Backend> faulty =
        makeDeviceBackend(testing::testDevice(), {.kernel = gpu::findKernel("stack"), .spirv = faultInLane});
    SoakRequest request;
    request.passes = 12;
    request.loads = {loads.loads.front().name};
    const SoakVerdict verdict = soak(*faulty, testing::testDevice(), loads, request, nobody(), {});
    EXPECT_EQ(verdict.wrongPasses(), verdict.passes());
    bool isPermanent = false;
    for (const SoakFault &fault : verdict.faults)
        if (fault.recurrence == Recurrence::Permanent) {
            isPermanent = true;
            EXPECT_EQ(fault.lane, 3u);
            EXPECT_EQ(fault.samples, std::vector<std::uint32_t>{0});
            EXPECT_FALSE(fault.divergence) << "the trace runs in lane 0";
            EXPECT_TRUE(describe(fault).ends_with("its path is right where it is traced by itself"))
                << describe(fault);
        }
    EXPECT_TRUE(isPermanent);
    const std::vector<std::uint64_t> &lanes = verdict.patterns.lanes;
    ASSERT_EQ(lanes.size(), 4u) << "none beyond lane 3";
    for (std::size_t lane = 0; lane < 3; ++lane)
        EXPECT_EQ(lanes[lane], 0u) << lane;
    EXPECT_GT(lanes[3], 0u);
}

} // namespace
} // namespace hyalite::core
