// The kernels over a stack and the CPU twin do the same work: node by node, box by box, triangle by triangle.
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

namespace hyalite {
namespace {

WorkCounts countOnCpu(const Scene &scene) {
    reference::Options options;
    options.isCounting = true;
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    return reference::render(testing::pack(scene), scene.settings, crop, options).work;
}

TEST(WorkCounts, AreEqualOnDeviceAndCpuHoweverTheWorkIsCut) {
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        Scene scene = testing::shippedScene("cat", 40, 30, 2);
        scene.settings.tree = tree;
        const WorkCounts onCpu = countOnCpu(scene);
        EXPECT_GT(onCpu.nodesVisited, 40u * 30u * 2u);
        EXPECT_GT(onCpu.boxesTested, onCpu.nodesVisited);
        EXPECT_LE(onCpu.boxesTested, 2 * onCpu.nodesVisited);
        EXPECT_GT(onCpu.trianglesTested, 0u);
        EXPECT_GT(onCpu.deepestStack, 1u);
        EXPECT_LE(onCpu.deepestStack, layout::maxTreeDepth);
        EXPECT_EQ(testing::renderOnDevice(scene, {.slotsPerInvocation = 1, .isCounting = true}).work, onCpu);
        EXPECT_EQ(
            testing::renderOnDevice(scene, {.steps = 100, .slotsPerInvocation = 2, .isCounting = true}).work,
            onCpu);
    }
}

TEST(WorkCounts, AreLeftOutUnlessAskedFor) {
    const Scene scene = testing::shippedScene("cat", 16, 16, 1);
    EXPECT_EQ(testing::renderOnCpu(scene).work, WorkCounts{});
    EXPECT_EQ(testing::renderOnDevice(scene, {.traversal = gpu::Traversal::Stack}).work, WorkCounts{});
}

TEST(WorkCounts, ChangeNoPixel) {
    const Scene scene = testing::shippedScene("cat", 40, 30, 1);
    EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, {.isCounting = true}).film,
                                       testing::renderOnCpu(scene).film),
              0u);
}

} // namespace
} // namespace hyalite
