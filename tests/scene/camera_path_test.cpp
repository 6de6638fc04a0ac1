// Camera paths: keys are met, what lies between is on a spline or a line, and a turntable is a circle.
#include "host/scene/camera_path.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hyalite::core {
namespace {

CameraKey keyAt(int frame, const glm::dvec3 &position, double fov = 60.0) {
    CameraKey key;
    key.frame = frame;
    key.pose.position = position;
    key.pose.direction = glm::dvec3(0.0, 0.0, -10.0) - position; // towards one point
    key.pose.horizontalFovDegrees = fov;
    return key;
}

void expectNear(const glm::dvec3 &found, const glm::dvec3 &wanted) {
    EXPECT_NEAR(glm::length(found - wanted), 0.0, 1e-12 * (1.0 + glm::length(wanted)))
        << found.x << " " << found.y << " " << found.z;
}

TEST(CameraPath, MeetsItsKeysAndWaitsForTheFirst) {
    const CameraKey keys[] = {keyAt(2, {1, 2, 3}), keyAt(5, {4, 0, 3}, 50.0), keyAt(6, {5, 5, 5}, 30.0)};
    for (const KeyInterpolation interpolation : {KeyInterpolation::Smooth, KeyInterpolation::Linear}) {
        const CameraPath path = pathThrough(keys, interpolation);
        ASSERT_EQ(path.size(), 7u);
        EXPECT_EQ(path[0].position, keys[0].pose.position);
        for (const CameraKey &key : keys) {
            const CameraPose &pose = path[static_cast<std::size_t>(key.frame)];
            EXPECT_EQ(pose.position, key.pose.position);
            EXPECT_EQ(pose.direction, key.pose.direction);
            EXPECT_EQ(pose.horizontalFovDegrees, key.pose.horizontalFovDegrees);
        }
    }
}

TEST(CameraPath, KeepsItsTargetInView) {
    const CameraKey keys[] = {keyAt(0, {10, 0, 0}), keyAt(10, {0, 4, 20}), keyAt(30, {-10, 0, 0})};
    for (const KeyInterpolation interpolation : {KeyInterpolation::Smooth, KeyInterpolation::Linear})
        for (const CameraPose &pose : pathThrough(keys, interpolation))
            expectNear(pose.position + pose.direction, {0.0, 0.0, -10.0});
}

TEST(CameraPath, IsStraightWhereItIsLinear) {
    const CameraKey keys[] = {keyAt(0, {0, 0, 0}, 60.0), keyAt(4, {8, 4, 0}, 40.0)};
    const CameraPath path = pathThrough(keys, KeyInterpolation::Linear);
    expectNear(path[1].position, {2.0, 1.0, 0.0});
    EXPECT_DOUBLE_EQ(path[3].horizontalFovDegrees, 45.0);
}

// A parabola through three keys has the slopes that finite differences find, so that the spline between the first inner
// keys is the parabola itself.
TEST(CameraPath, FollowsAParabola) {
    const auto at = [](double t) { return glm::dvec3(t, 0.25 * t * t, 0.0); };
    std::vector<CameraKey> keys;
    for (const int frame : {0, 3, 8, 10, 16})
        keys.push_back(keyAt(frame, at(frame)));
    const CameraPath path = pathThrough(keys, KeyInterpolation::Smooth);
    for (int frame = 3; frame <= 10; ++frame)
        expectNear(path[static_cast<std::size_t>(frame)].position, at(frame));
}

TEST(CameraPath, OfOneKeyStandsStill) {
    const CameraKey keys[] = {keyAt(3, {1, 2, 3})};
    for (const CameraPose &pose : pathThrough(keys, KeyInterpolation::Smooth))
        EXPECT_EQ(pose.position, keys[0].pose.position);
}

TEST(Turntable, IsACircleAroundThePivot) {
    Camera camera;
    camera.position = {3.0, 4.0, 5.0};
    camera.direction = {-3.0, -2.0, -5.0};
    camera.up = {0.0, 2.0, 0.0};
    const glm::dvec3 pivot = pivotOf(camera, {0.1, 2.0, -0.2});
    expectNear(glm::cross(glm::normalize(pivot - camera.position), glm::normalize(camera.direction)),
               glm::dvec3(0.0));
    const CameraPath path = turntable(camera, pivot, camera.up, 8);
    ASSERT_EQ(path.size(), 8u);
    EXPECT_EQ(path[0].position, camera.position);
    EXPECT_EQ(path[0].direction, camera.direction);
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_NEAR(glm::distance(path[i].position, pivot), glm::distance(camera.position, pivot), 1e-12);
        EXPECT_NEAR(path[i].position.y, 4.0, 1e-12);
        expectNear(glm::normalize(path[i].direction),
                   glm::normalize(pivot - path[i].position)); // it looks at the pivot
        EXPECT_EQ(path[i].up, camera.up);
    }
    // A quarter of the way round, counter-clockwise seen from above: +z goes to +x.
    const glm::dvec3 from = path[0].position - pivot;
    expectNear(path[2].position - pivot, {from.z, from.y, -from.x});
}

TEST(Turntable, TurnsATiltedCameraAboutTheAxis) {
    Camera camera;
    camera.position = {3.0, 4.0, 5.0};
    camera.direction = {-3.0, -4.0, -5.0};
    camera.up = glm::normalize(glm::dvec3(0.5, 1.0, -0.25));
    const CameraPath path = turntable(camera, {0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 4);
    ASSERT_EQ(path.size(), 4u);
    EXPECT_EQ(path[0].up, camera.up);
    const auto quarter = [](const glm::dvec3 &v) { return glm::dvec3(v.z, v.y, -v.x); };
    for (std::size_t i = 1; i < path.size(); ++i) {
        expectNear(path[i].position, quarter(path[i - 1].position));
        expectNear(path[i].direction, quarter(path[i - 1].direction));
        expectNear(path[i].up, quarter(path[i - 1].up));
    }
}

TEST(Turntable, TurnsAroundTheCentreOfWhatLiesBehindTheCamera) {
    Camera camera;
    EXPECT_EQ(pivotOf(camera, {1.0, 2.0, 100.0}), glm::dvec3(1.0, 2.0, 100.0));
}

} // namespace
} // namespace hyalite::core
