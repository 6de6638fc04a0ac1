#include "host/reference/camera.h"

#include "tests/unit/geometry_fixture.h"

namespace hyalite::reference {
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

} // namespace
} // namespace hyalite::reference
