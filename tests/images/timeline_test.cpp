// What a render on the device writes down of itself.
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

struct Recorded {
    Timeline timeline;
    gpu::Result result;
    Span frame; ///< the whole call
};

Recorded record(const TestScene &scene, const Crop &crop, const gpu::RenderConfig &config = {}) {
    const PackedScene packed = testing::pack(scene);
    Timeline timeline;
    gpu::Renderer &renderer = testing::rendererBy(config);
    Stopwatch watch;
    gpu::Result result = renderer.render(packed, scene.settings, crop, {.timeline = &timeline});
    return {std::move(timeline), std::move(result), watch.lap()};
}

TEST(Timeline, HasARecordOfEachDispatch) {
    const Crop crop{8, 50, 5, 40};
    const Recorded all = record(testing::shippedScene("spheres", 64, 48, 3), crop,
                                {.tileWidth = 16, .tileHeight = 16, .steps = 60});
    EXPECT_EQ(all.timeline.dispatches.size(), all.result.timing.dispatchCount);
    RayCounts rays;
    int freshPixelCount = 0;
    int resumedCount = 0;
    std::set<std::pair<int, int>> tiles;
    for (const DispatchRecord &dispatch : all.timeline.dispatches) {
        rays += dispatch.rays;
        if (tiles.insert({dispatch.tileX, dispatch.tileY}).second) {
            EXPECT_FALSE(dispatch.isResumed) << "nothing waits of a tile that was not begun";
            freshPixelCount += dispatch.tileWidth * dispatch.tileHeight;
        }
        resumedCount += dispatch.isResumed ? 1 : 0;
        EXPECT_GE(dispatch.tileX, crop.x0);
        EXPECT_LE(dispatch.tileX + dispatch.tileWidth, crop.x1);
        EXPECT_GE(dispatch.tileY, crop.y0);
        EXPECT_LE(dispatch.tileY + dispatch.tileHeight, crop.y1);
        EXPECT_EQ(dispatch.sampleBegin, 0u);
        EXPECT_EQ(dispatch.sampleEnd, 3u);
        EXPECT_GE(dispatch.invocations * 2, 16u * 16u) << "two slots an invocation";
        EXPECT_TRUE(dispatch.kernel.starts_with("whitted ")) << dispatch.kernel;
    }
    EXPECT_EQ(rays, all.result.rays);
    EXPECT_EQ(freshPixelCount, crop.width() * crop.height());
    EXPECT_GT(resumedCount, 0);
}

TEST(Timeline, ShortDispatchesAreManyAndChangeNoBit) {
    for (const Integrator integrator : {Integrator::Whitted, Integrator::Path}) {
        TestScene scene = testing::shippedScene("spheres-nested", 48, 32, 2);
        scene.settings.maxDepth = 8;
        scene.settings.integrator = integrator;
        const reference::Result wanted = testing::renderOnCpu(scene);
        for (gpu::RenderConfig config : testing::kernelsInTurn(integrator == Integrator::Path ? 0 : 1))
            for (const double seconds : {1e-6, 1e-5, 10.0}) {
                config.dispatchSeconds = seconds;
                const Recorded all = record(scene, {0, 48, 0, 32}, config);
                EXPECT_EQ(testing::differingPixels(all.result.film, wanted.film), 0u) << seconds;
                EXPECT_EQ(all.result.rays, wanted.rays) << seconds;
                const std::size_t count = all.timeline.dispatches.size();
                if (seconds < 0.01)
                    EXPECT_GE(count, 48u * 32u / 512u) << seconds;
                else
                    EXPECT_LE(count, 30u) << seconds;
            }
    }
}

// In the background samples take a microsecond, in the nested glass a thousand times as long.
TEST(Timeline, DispatchesAreNotMuchLongerThanIsWanted) {
    const Recorded all = record(testing::shippedScene("spheres-nested", 160, 160, 4), {0, 160, 0, 160},
                                {.dispatchSeconds = 0.01});
    std::vector<double> seconds;
    for (const DispatchRecord &dispatch : all.timeline.dispatches)
        seconds.push_back(dispatch.times.best().seconds());
    std::ranges::sort(seconds);
    EXPECT_GT(seconds.size(), 20u);
    // One in ten may meet a machine that is busy with something else, and come to ten times as long.
    EXPECT_LT(seconds.at(seconds.size() * 9 / 10), 0.1);
}

TEST(Timeline, NamesTheKernelThatRan) {
    const Recorded all =
        record(testing::shippedScene("spheres", 8, 8, 1), {0, 8, 0, 8}, {.kernel = gpu::findKernel("stack")});
    const std::string kernel = all.timeline.dispatches.front().kernel;
    EXPECT_TRUE(kernel.starts_with("whitted stack")) << kernel;
}

TEST(Timeline, DeviceTimesLieInsideOfTheHostsAndFollowEachOther) {
    const Recorded all = record(testing::shippedScene("cat", 96, 96, 2), {0, 96, 0, 96},
                                {.tileWidth = 32, .tileHeight = 32, .steps = 500});
    EXPECT_NE(all.timeline.clock.find("timestamps of the device, 64 bits, 1 ns a tick"), std::string::npos)
        << all.timeline.clock;
    std::int64_t last = all.frame.beginNanos;
    std::int64_t deviceTotal = 0;
    std::int64_t hostTotal = 0;
    for (const DispatchRecord &dispatch : all.timeline.dispatches) {
        const Span &host = dispatch.times.host;
        ASSERT_TRUE(dispatch.times.device);
        const Span &device = *dispatch.times.device;
        EXPECT_LE(last, host.beginNanos);
        EXPECT_LE(host.beginNanos, device.beginNanos);
        EXPECT_LT(device.beginNanos, device.endNanos);
        EXPECT_LE(device.endNanos, host.endNanos);
        EXPECT_EQ(&dispatch.times.best(), &*dispatch.times.device);
        last = host.endNanos;
        deviceTotal += device.endNanos - device.beginNanos;
        hostTotal += host.endNanos - host.beginNanos;
    }
    EXPECT_LE(last, all.frame.endNanos);
    // Whoever counts in another unit is off by more, and whoever waits for a busy machine by less.
    EXPECT_GT(deviceTotal, hostTotal / 100);
}

TEST(Timeline, StagesFollowEachOtherAndFillTheFrame) {
    const Recorded all = record(testing::shippedScene("spheres", 64, 64, 2), {0, 64, 0, 64});
    const std::vector<std::string> names{"upload",         "buffers",    "pipeline",
                                         "first dispatch", "dispatches", "readback"};
    ASSERT_EQ(all.timeline.stages.size(), names.size());
    std::int64_t last = all.frame.beginNanos;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const StageRecord &stage = all.timeline.stages[i];
        EXPECT_EQ(stage.name, names[i]);
        EXPECT_LE(last, stage.span.beginNanos);
        EXPECT_LE(stage.span.beginNanos, stage.span.endNanos);
        EXPECT_GT(stage.deviceBytes, 0u);
        last = stage.span.endNanos;
    }
    EXPECT_LE(last, all.frame.endNanos);
    const Span &dispatches = all.timeline.stages[4].span;
    EXPECT_LE(dispatches.beginNanos, all.timeline.dispatches.front().times.host.beginNanos);
    EXPECT_GE(dispatches.endNanos, all.timeline.dispatches.back().times.host.endNanos);
    EXPECT_DOUBLE_EQ(dispatches.seconds(), all.result.timing.renderSeconds);
    // The film alone has that many bytes.
    EXPECT_GT(all.timeline.stages[1].deviceBytes,
              all.timeline.stages[0].deviceBytes + 64 * 64 * sizeof(layout::FilmPixel));
}

} // namespace
} // namespace hyalite::core
