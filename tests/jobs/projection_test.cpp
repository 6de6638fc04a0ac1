// Cameras as the matrices of pictures.
#include "host/jobs/projection.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hyalite::core {
namespace {

/// (x y z 1) M, before the division by w.
glm::dvec4 transformed(const glm::dvec3 &point, const std::array<double, 16> &matrix) {
    const glm::dvec4 row(point, 1.0);
    glm::dvec4 result(0.0);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            result[static_cast<glm::length_t>(j)] += row[static_cast<glm::length_t>(i)] * matrix[4 * i + j];
    return result;
}

Scene sceneBy(CameraKind kind) {
    Scene scene;
    scene.camera.kind = kind;
    scene.camera.position = {1.0, 2.0, 3.0};
    scene.camera.direction = {2.0, 0.0, 0.0};
    scene.camera.up = {0.0, 0.0, 5.0};
    scene.camera.width = 40;
    scene.camera.height = 20;
    return scene;
}

TEST(Projection, CameraSpaceIsLeftHandedAndLooksAlongZ) {
    const std::optional<Projection> projection = projectionOf(sceneBy(CameraKind::Perspective));
    ASSERT_TRUE(projection);
    const auto inCamera = [&](const glm::dvec3 &offset) {
        return glm::dvec3(transformed(glm::dvec3(1.0, 2.0, 3.0) + offset, projection->worldToCamera));
    };
    const auto expectAt = [&](const glm::dvec3 &offset, const glm::dvec3 &wanted) {
        EXPECT_LT(glm::distance(inCamera(offset), wanted), 1e-12);
    };
    expectAt({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    expectAt({7.0, 0.0, 0.0}, {0.0, 0.0, 7.0});  // the view
    expectAt({0.0, 0.0, 1.0}, {0.0, 1.0, 0.0});  // up
    expectAt({0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}); // to the right
}

TEST(Projection, NdcIsFromTheTopLeftToTheBottomRight) {
    Scene scene = sceneBy(CameraKind::Perspective);
    scene.camera.horizontalFovDegrees = 90.0;
    const Projection perspective = *projectionOf(scene);
    EXPECT_NEAR(perspective.screenWindowWidth, 2.0, 1e-12);
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.viewWidth = 8.0;
    const Projection orthographic = *projectionOf(scene);
    EXPECT_EQ(orthographic.screenWindowWidth, 1.0);
    for (const auto &[matrix, halfWidth] :
         {std::pair{&perspective.worldToNdc, 4.0}, {&orthographic.worldToNdc, 4.0}}) {
        const auto ndcOf = [&, m = matrix](double right, double up) {
            const glm::dvec4 point =
                transformed(glm::dvec3(5.0, 2.0 - right, 3.0 + up), *m); // at the depth 4
            return glm::dvec2(point) / point.w;
        };
        EXPECT_LT(glm::distance(ndcOf(0.0, 0.0), glm::dvec2(0.5, 0.5)), 1e-12);
        EXPECT_LT(glm::distance(ndcOf(-halfWidth, halfWidth / 2.0), glm::dvec2(0.0, 0.0)), 1e-12);
        EXPECT_LT(glm::distance(ndcOf(halfWidth, -halfWidth / 2.0), glm::dvec2(1.0, 1.0)), 1e-12);
    }
}

TEST(Projection, IsOfTheCoordinatesOfTheFile) {
    Scene scene = sceneBy(CameraKind::Perspective);
    const Projection near = *projectionOf(scene);
    scene.origin = {4e6, 5e5, 100.0};
    const Projection far = *projectionOf(scene);
    const glm::dvec3 point(6.0, 2.5, 3.25);
    const glm::dvec4 wanted = transformed(point, near.worldToNdc);
    EXPECT_LT(glm::distance(transformed(point + scene.origin, far.worldToNdc), wanted), 1e-8);
}

TEST(Projection, ThereIsNoneOfAPanorama) { EXPECT_FALSE(projectionOf(sceneBy(CameraKind::Panorama))); }

} // namespace
} // namespace hyalite::core
