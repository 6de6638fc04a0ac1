#include "host/packing/pixel_filter.h"
#include "tests/fixtures/leaves.h"

#include "tests/fixtures/geometry_fixture.h"

namespace hyalite::core::reference {
namespace {

TEST(Camera, EachOffsetMovesTheRayAlongItsOwnAxis) {
    layout::FrameRecord frame{};
    frame.imageWidth = 40;
    frame.imageHeight = 30;
    frame.pixelRight = {0.5f, 0.0f, 0.0f};
    frame.pixelUp = {0.0f, 0.25f, 0.0f};
    frame.imagePlane = {0.0f, 0.0f, -8.0f};
    const auto direction = primaryDirection<double>(frame, {7, 3}, {0.125, 0.75});
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0.5 * (7.125 - 20.0), 0.25 * (15.0 - 3.75), -8.0));
    EXPECT_LT(glm::distance(direction, expected), 1e-14);
}

Scene sceneOf(CameraKind kind, int width, int height) {
    Scene scene;
    scene.camera.kind = kind;
    scene.camera.position = {1, 2, 3};
    scene.camera.direction = {0, 0, -2};
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
}

TEST(LensCamera, RaysOfOneImagePointMeetInTheFocusPlane) {
    Scene scene = sceneOf(CameraKind::Perspective, 40, 30);
    const PackedScene pinhole = testing::packed(scene);
    scene.camera.aperture = 0.5;
    scene.camera.focusDistance = 7.0;
    const PackedScene lens = testing::packed(scene);
    double widest = 0.0;
    for (std::uint32_t sample = 0; sample < 256; ++sample) {
        const auto centre = layout::samplerCentre;
        const PrimaryRay<double> through = primaryRay<double>(lens, centre, {33, 4}, sample);
        const PrimaryRay<double> straight = primaryRay<double>(pinhole, centre, {33, 4}, sample);
        EXPECT_NEAR(through.origin.z, 3.0, 1e-12) << "the lens is flat";
        const glm::dvec3 met = through.origin + through.direction * (7.0 / -through.direction.z);
        const glm::dvec3 wanted = straight.origin + straight.direction * (7.0 / -straight.direction.z);
        EXPECT_LT(glm::distance(met, wanted), 1e-6);
        widest = std::max(widest, glm::distance(through.origin, straight.origin));
    }
    EXPECT_LE(widest, 0.25 + 1e-6);
    EXPECT_GT(widest, 0.24);
}

TEST(OrthographicCamera, RaysAreParallelAndAPixelApart) {
    Scene scene = sceneOf(CameraKind::Orthographic, 40, 30);
    scene.camera.viewWidth = 20.0;
    const PackedScene packed = testing::packed(scene);
    for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(17, 22)}) {
        const PrimaryRay<double> ray = primaryRay<double>(packed, layout::samplerCentre, pixel, 0);
        EXPECT_EQ(ray.direction, glm::dvec3(0, 0, -1));
        const glm::dvec3 origin(1.0 + 0.5 * (pixel.x + 0.5 - 20.0), 2.0 + 0.5 * (15.0 - pixel.y - 0.5), 3.0);
        EXPECT_LT(glm::distance(ray.origin, origin), 1e-12);
    }
}

TEST(PanoramaCamera, ShowsAllDirections) {
    const PackedScene packed = testing::packed(sceneOf(CameraKind::Panorama, 512, 256));
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return primaryRay<double>(packed, layout::samplerCentre, {x, y}, 0).direction;
    };
    EXPECT_LT(glm::distance(at(256, 128), glm::dvec3(0, 0, -1)), 0.02) << "the middle is ahead";
    EXPECT_LT(glm::distance(at(384, 128), glm::dvec3(1, 0, 0)), 0.02) << "right of it is the right";
    EXPECT_LT(glm::distance(at(0, 128), glm::dvec3(0, 0, 1)), 0.02) << "the left edge is behind";
    EXPECT_LT(glm::distance(at(77, 0), glm::dvec3(0, 1, 0)), 0.02) << "the top is up";
    EXPECT_LT(glm::distance(at(77, 255), glm::dvec3(0, -1, 0)), 0.02);
}

// A wide filter moves rays beyond the edges of a small image, around the whole panorama.
TEST(PanoramaCamera, RaysHaveUnitLengthThroughAWideFilter) {
    for (const CameraKind kind : {CameraKind::Panorama, CameraKind::Perspective}) {
        PackedScene packed = testing::packed(sceneOf(kind, 3, 2));
        packFilter(packed);
        for (std::uint32_t sample = 0; sample < 4096; ++sample) {
            const PrimaryRay<float> ray =
                primaryRay<float>(packed, layout::samplerFiltered, {sample % 3, sample % 2}, sample);
            EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-6f) << "sample " << sample;
        }
    }
}

} // namespace
} // namespace hyalite::core::reference
