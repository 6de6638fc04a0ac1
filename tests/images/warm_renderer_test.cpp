// A renderer keeps its last scene and pipelines on the device. No picture shows it.
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::pack;
using testing::shippedScene;

struct WarmRenderer : ::testing::Test {
    gpu::Renderer renderer{testing::testDevice()};

    void expectBitsOfTheCpu(const TestScene &scene, const PackedScene &packed, const Crop &crop) {
        const gpu::Result result = renderer.render(packed, scene.settings, crop);
        const reference::Result twin = reference::render(packed, scene.settings, crop);
        EXPECT_EQ(differingPixels(result.film, twin.film), 0u);
        EXPECT_EQ(result.rays, twin.rays);
    }
};

TEST_F(WarmRenderer, FollowsTheCamera) {
    TestScene scene = shippedScene("cat", 40, 32, 2);
    PackedScene packed = pack(scene);
    const Crop whole{0, 40, 0, 32};
    expectBitsOfTheCpu(scene, packed, whole);
    scene.camera.position += glm::dvec3(0.3, 0.2, 0.0);
    packCamera(scene, packed);
    EXPECT_EQ(packed.contentHash(), pack(scene).contentHash());
    expectBitsOfTheCpu(scene, packed, whole);
    scene.camera.aperture = 0.1; // another kernel
    packCamera(scene, packed);
    expectBitsOfTheCpu(scene, packed, whole);
}

TEST_F(WarmRenderer, RendersOtherScenesInBetween) {
    const TestScene cat = shippedScene("cat", 40, 32, 2);
    const TestScene room = shippedScene("cornell", 40, 32, 2);
    const PackedScene packedCat = pack(cat);
    const PackedScene packedRoom = pack(room);
    for (int time = 0; time < 2; ++time) {
        expectBitsOfTheCpu(cat, packedCat, {0, 40, 0, 32});
        expectBitsOfTheCpu(room, packedRoom, {8, 30, 3, 32});
    }
    expectBitsOfTheCpu(cat, pack(cat), {0, 40, 0, 32}); // packed once more
}

TEST_F(WarmRenderer, UploadsASceneOnce) {
    const TestScene scene = shippedScene("cat", 40, 32, 1);
    const PackedScene packed = pack(scene);
    const auto bytesAfterUpload = [&] {
        Timeline timeline;
        static_cast<void>(
            renderer.render(packed, scene.settings, Crop{0, 16, 0, 16}, {.timeline = &timeline}));
        return timeline.stages.front().deviceBytes;
    };
    const std::uint64_t first = bytesAfterUpload();
    EXPECT_GT(first, 100'000u);
    EXPECT_EQ(bytesAfterUpload(), first); // not twice
}

} // namespace
} // namespace hyalite::core
