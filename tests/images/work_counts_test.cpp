// The kernels over a stack and the CPU twin do the same work: node by node, box by box, triangle by triangle.
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace hyalite::core {
namespace {

WorkCounts countOnCpu(const TestScene &scene) {
    reference::Options options;
    options.isCounting = true;
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    return reference::render(testing::pack(scene), scene.settings, crop, options).work;
}

gpu::RenderConfig counting(std::string_view kernel, std::uint32_t steps = 0) {
    return {.steps = steps, .isCounting = true, .kernel = gpu::findKernel(kernel)};
}

TEST(WorkCounts, AreEqualOnDeviceAndCpuHoweverTheWorkIsCut) {
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        TestScene scene = testing::shippedScene("cat", 40, 30, 2);
        scene.settings.tree = tree;
        const WorkCounts onCpu = countOnCpu(scene);
        EXPECT_GT(onCpu.nodesVisited, 40u * 30u * 2u);
        EXPECT_GT(onCpu.boxesTested, onCpu.nodesVisited);
        EXPECT_LE(onCpu.boxesTested, 2 * onCpu.nodesVisited);
        EXPECT_GT(onCpu.trianglesTested, 0u);
        EXPECT_GT(onCpu.deepestStack, 1u);
        EXPECT_LE(onCpu.deepestStack, layout::maxTreeDepth);
        EXPECT_EQ(testing::renderOnDevice(scene, counting("stack")).work, onCpu);
        EXPECT_EQ(testing::renderOnDevice(scene, counting("stack", 100)).work, onCpu);
    }
}

TEST(WorkCounts, OfSkipListsAreEqualHoweverTheWorkIsCut) {
    for (const std::string name : {"cat", "studio-cat", "cornell"}) {
        TestScene scene = testing::shippedScene(name, 40, 30, 3);
        const gpu::Result whole = testing::renderOnDevice(scene, counting("skip-list"));
        if (name ==
            "cornell") { // few triangles in a room: each ray is tested with all of them, without a tree
            EXPECT_EQ(whole.work.nodesVisited, 0u);
            EXPECT_EQ(whole.work.trianglesTested % 32u, 0u);
            EXPECT_GT(whole.work.trianglesTested, 32u * 40u * 30u * 3u);
        } else {
            EXPECT_GT(whole.work.nodesVisited, 40u * 30u * 3u) << name;
        }
        EXPECT_EQ(whole.work.boxesTested, whole.work.nodesVisited) << name;
        EXPECT_GT(whole.work.trianglesTested, 0u) << name;
        EXPECT_EQ(whole.work.deepestStack, 0u) << name;
        gpu::RenderConfig cut = counting("skip-list-x2", 100);
        cut.tileWidth = 16;
        cut.samplesInFlight = 2;
        EXPECT_EQ(testing::renderOnDevice(scene, cut).work, whole.work) << name;
    }
}

// One ray keeps one of the lanes busy, however many there are; and every node and every triangle is looked at in a
// pass.
TEST(LaneCounts, AreThoseOfTheRaysThatAreTraced) {
    const TestScene scene = testing::shippedScene("cat", 64, 64, 8);
    const gpu::Result result = testing::renderOnDevice(scene, counting("skip-list-x2"));
    EXPECT_EQ(result.lanes.busySlots, result.work.nodesVisited + result.work.trianglesTested);
    EXPECT_GE(result.lanes.slotsPerSubgroup, 2u);
    EXPECT_GT(result.lanes.busyShare(), 1.0 / result.lanes.slotsPerSubgroup);
    EXPECT_LT(result.lanes.busyShare(), 1.0);
    const TestScene onePixel = testing::shippedScene("cat", 1, 1, 1);
    const gpu::Result alone = testing::renderOnDevice(onePixel, counting("skip-list"));
    EXPECT_EQ(alone.lanes.passes, alone.lanes.busySlots);
    const gpu::Result withStack = testing::renderOnDevice(onePixel, counting("stack"));
    EXPECT_EQ(withStack.lanes.passes, withStack.lanes.busySlots);
}

TEST(WorkCounts, AreLeftOutUnlessAskedFor) {
    const TestScene scene = testing::shippedScene("cat", 16, 16, 1);
    EXPECT_EQ(testing::renderOnCpu(scene).work, WorkCounts{});
    EXPECT_EQ(testing::renderOnDevice(scene, {.kernel = gpu::findKernel("stack")}).work, WorkCounts{});
}

TEST(WorkCounts, ChangeNoPixel) {
    const TestScene scene = testing::shippedScene("cat", 40, 30, 1);
    EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, {.isCounting = true}).film,
                                       testing::renderOnCpu(scene).film),
              0u);
}

} // namespace
} // namespace hyalite::core
