// A bare mesh of any size and shape lies within the image, and is lit alike.
#include "host/scene/framing.h"

#include "host/base/error.h"
#include "host/import/load.h"
#include "host/scene/validate.h"
#include "tests/fixtures/temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <vector>

namespace hyalite::core {
namespace {

/// One triangle that has the bounds of a whole box.
TriangleMesh spanning(const glm::vec3 &low, const glm::vec3 &high) {
    TriangleMesh mesh;
    mesh.name = "box.obj";
    mesh.positions = {low, high, {low.x, high.y, low.z}, {1e9f, 1e9f, 1e9f}}; // no triangle uses the last
    mesh.triangles = {{{0, 1, 2}}};
    return mesh;
}

struct Shape {
    glm::vec3 low;
    glm::vec3 high;
};

const std::vector<Shape> &shapes() {
    static const std::vector<Shape> all = {
        {{-1, -1, -1}, {1, 1, 1}},
        {{-1e-6f, -1e-6f, -1e-6f}, {1e-6f, 1e-6f, 1e-6f}},
        {{-1e6f, 0, -1e6f}, {1e6f, 1e6f, 1e6f}},
        {{0, 0, 0}, {50, 30, 8}},                               // a cat
        {{-5, 0, -5}, {5, 0, 5}},                               // flat on the floor
        {{0, -5, -5}, {0, 5, 5}},                               // flat, upright, along z
        {{0, 0, 0}, {0, 1, 0}},                                 // a line
        {{-1, -1000, -1}, {1, 1000, 1}},                        // a needle
        {{1e6f, 1e6f, -1e6f}, {1e6f + 4, 1e6f + 4, -1e6f + 4}}, // far from the origin
    };
    return all;
}

/// The largest |x| and |y| of the box's corners in the image, whose edges are at 1. Corners behind the camera
/// are infinitely far out.
glm::dvec2 largestExtent(const Bounds &bounds, const Camera &camera) {
    const glm::dvec3 forward = glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tangentX = std::tan(glm::radians(camera.horizontalFovDegrees / 2));
    const double tangentY = tangentX * camera.height / camera.width;
    glm::dvec2 largest(0.0);
    for (const double x : {bounds.low.x, bounds.high.x})
        for (const double y : {bounds.low.y, bounds.high.y})
            for (const double z : {bounds.low.z, bounds.high.z}) {
                const glm::dvec3 p = glm::dvec3(x, y, z) - camera.position;
                const double depth = glm::dot(p, forward);
                if (depth <= 0.0)
                    return glm::dvec2(std::numeric_limits<double>::infinity());
                largest.x = std::max(largest.x, std::abs(glm::dot(p, right)) / (depth * tangentX));
                largest.y = std::max(largest.y, std::abs(glm::dot(p, up)) / (depth * tangentY));
            }
    return largest;
}

TEST(Framing, AnyShapeFillsTheImageButForAMargin) {
    for (const Shape &shape : shapes()) {
        const Scene scene = frameMesh(spanning(shape.low, shape.high));
        const glm::dvec2 extent = largestExtent(triangleBounds(scene.meshes[0]), scene.camera);
        EXPECT_NEAR(std::max(extent.x, extent.y), 0.92, 1e-6) << shape.high.x << " " << shape.high.y;
        EXPECT_EQ(scene.camera.width, 512);
        EXPECT_EQ(scene.camera.height, 512);
        EXPECT_EQ(scene.camera.horizontalFovDegrees, 40.0);
        EXPECT_NO_THROW(validateScene(scene, "framed"));
    }
}

TEST(Framing, AnyAspectAndFieldOfViewShowsTheWholeMesh) {
    for (const Shape &shape : shapes())
        for (const glm::ivec2 size : {glm::ivec2(1, 1), {333, 217}, {217, 333}, {4096, 16}, {1, 32768}})
            for (const double fov : {0.1, 40.0, 120.0, 179.0}) {
                const Bounds bounds = triangleBounds(spanning(shape.low, shape.high));
                const Camera camera = frameCamera(bounds, size.x, size.y, fov);
                const glm::dvec2 extent = largestExtent(bounds, camera);
                EXPECT_LE(std::max(extent.x, extent.y), 0.92 + 1e-6) << size.x << "x" << size.y << " " << fov;
                EXPECT_EQ(camera.width, size.x);
                EXPECT_EQ(camera.height, size.y);
            }
}

TEST(Framing, AnyDirectionShowsTheWholeMesh) {
    for (const Shape &shape : shapes())
        for (const double azimuth : {0.0, 45.0, 90.0, 180.0, 270.0})
            for (const double elevation : {-90.0, -30.0, 0.0, 35.0, 89.5, 90.0})
                for (const glm::dvec3 &up :
                     {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)}) {
                    const Bounds bounds = triangleBounds(spanning(shape.low, shape.high));
                    const Camera camera = frameCamera(bounds, 300, 200, 40.0, up, {azimuth, elevation});
                    const glm::dvec2 extent = largestExtent(bounds, camera);
                    EXPECT_LE(std::max(extent.x, extent.y), 0.92 + 1e-6) << azimuth << " " << elevation;
                    EXPECT_GT(glm::length(glm::cross(camera.up, glm::normalize(camera.direction))), 0.1);
                }
}

/// Unit vectors of a camera, rounded: to the right, up, and to the viewer.
std::array<glm::ivec3, 3> axesOf(const Camera &camera) {
    const glm::dvec3 backwards = -glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(camera.up, backwards));
    return {glm::round(right), glm::round(glm::cross(backwards, right)), glm::round(backwards)};
}

TEST(Framing, SidesAreThoseOfDrawings) {
    const Bounds cube{{-1, -1, -1}, {1, 1, 1}};
    const auto seen = [&](const ViewDirection &from, const glm::dvec3 &up) {
        return axesOf(frameCamera(cube, 100, 100, 40.0, up, from));
    };
    using Axes = std::array<glm::ivec3, 3>;
    const glm::dvec3 y(0, 1, 0);
    EXPECT_EQ(seen({0, 0}, y), (Axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})) << "front";
    EXPECT_EQ(seen({90, 0}, y), (Axes{{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}})) << "right";
    EXPECT_EQ(seen({180, 0}, y), (Axes{{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}})) << "back";
    EXPECT_EQ(seen({0, 90}, y), (Axes{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}})) << "top";
    EXPECT_EQ(seen({0, -90}, y), (Axes{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}})) << "bottom";
    const glm::dvec3 z(0, 0, 1);
    EXPECT_EQ(seen({0, 0}, z), (Axes{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}))
        << "front, as programs with +z up have it";
    EXPECT_EQ(seen({0, 90}, z), (Axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})) << "top";
}

TEST(Framing, LightsOfACameraAreThoseOfAMeshSeenFromThere) {
    const Scene scene = frameMesh(spanning({-1, -1, -1}, {1, 1, 1}));
    const Bounds bounds = triangleBounds(scene.meshes[0]);
    const auto inCamera = [&](const Camera &camera, const Light &light) {
        const glm::dvec3 backwards = -glm::normalize(camera.direction);
        const glm::dvec3 right = glm::normalize(glm::cross(camera.up, backwards));
        return glm::dvec3(glm::dot(light.position, right),
                          glm::dot(light.position, glm::cross(backwards, right)),
                          glm::dot(light.position, backwards));
    };
    for (const ViewDirection &from : {defaultView, ViewDirection{0, -90}, {180, 0}, {-90, 45}, {0, 90}}) {
        const Camera camera = frameCamera(bounds, 512, 512, 40.0, {0, 1, 0}, from);
        const std::vector<Light> lights = frameLights(bounds, camera);
        ASSERT_EQ(lights.size(), scene.lights.size());
        for (std::size_t i = 0; i < lights.size(); ++i) {
            EXPECT_EQ(lights[i].power, scene.lights[i].power);
            EXPECT_NEAR(glm::length(inCamera(camera, lights[i]) - inCamera(scene.camera, scene.lights[i])),
                        0.0, 1e-6);
        }
    }
}

TEST(Framing, TheCameraLooksFromFrontRightAndAbove) {
    const Camera camera = frameMesh(spanning({-1, -1, -1}, {1, 1, 1})).camera;
    EXPECT_GT(camera.position.z, camera.position.x);
    EXPECT_GT(camera.position.x, camera.position.y);
    EXPECT_GT(camera.position.y, 0.0);
    EXPECT_NEAR(glm::length(glm::cross(camera.position, camera.direction)), 0.0, 1e-9); // at the centre
}

TEST(Framing, AnotherUpTurnsCameraAndLights) {
    const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
    const Camera usual = frameCamera(bounds, 512, 512, 40.0);
    const Camera standing = frameCamera(bounds, 512, 512, 40.0, {0.0, 0.0, 1.0});
    EXPECT_NEAR(
        glm::length(standing.position - glm::dvec3(usual.position.x, -usual.position.z, usual.position.y)),
        0.0, 1e-9)
        << "+y became +z, and the front -y";
    EXPECT_EQ(standing.up, glm::dvec3(0.0, 0.0, 1.0));
    const Scene scene = frameMesh(spanning({-1, -1, -1}, {1, 1, 1}));
    const std::vector<Light> lights = frameLights(bounds, {0.0, 0.0, 1.0}, standing.position);
    ASSERT_EQ(lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 expected = scene.lights[i].position;
        EXPECT_NEAR(glm::length(lights[i].position - glm::dvec3(expected.x, -expected.z, expected.y)), 0.0,
                    1e-6);
    }
    for (const glm::dvec3 &up :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1), glm::dvec3(0.6, 0.8, 0)}) {
        const Camera camera = frameCamera(bounds, 512, 512, 40.0, up);
        EXPECT_NEAR(glm::length(camera.position), glm::length(usual.position), 0.7) << "as far, more or less";
        EXPECT_GT(glm::dot(camera.position, up), 0.0) << "from above";
    }
}

TEST(Framing, LightsFollowTheEye) {
    const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
    const Camera camera = frameCamera(bounds, 512, 512, 40.0);
    const std::vector<Light> usual = frameLights(bounds, {0, 1, 0}, camera.position);
    const std::vector<Light> behind =
        frameLights(bounds, {0, 1, 0}, {-camera.position.x, 5.0, -camera.position.z});
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(behind[i].position.x, -usual[i].position.x, 1e-6);
        EXPECT_NEAR(behind[i].position.y, usual[i].position.y, 1e-6);
        EXPECT_NEAR(behind[i].position.z, -usual[i].position.z, 1e-6);
    }
}

TEST(Framing, TheLightAtTheCentreIsTheSameForAnySize) {
    for (const Shape &shape : shapes()) {
        const Scene scene = frameMesh(spanning(shape.low, shape.high));
        const Bounds bounds = triangleBounds(scene.meshes[0]);
        const glm::dvec3 centre = (bounds.low + bounds.high) / 2.0;
        ASSERT_EQ(scene.lights.size(), 2u);
        const auto radiance = [&](const Light &light) {
            const glm::dvec3 toLight = light.position - centre;
            return light.power.x / (4 * std::numbers::pi * glm::dot(toLight, toLight)) * 0.8 /
                   std::numbers::pi;
        };
        EXPECT_NEAR(radiance(scene.lights[0]), 0.7, 1e-6);
        EXPECT_NEAR(radiance(scene.lights[1]), 0.2, 1e-6);
    }
}

TEST(Framing, TheMaterialIsNeutralAndTwoSided) {
    const Scene scene = frameMesh(spanning({-1, -1, -1}, {1, 1, 1}));
    const Material &material = scene.materials.at(scene.meshes.at(0).materialIndex);
    EXPECT_EQ(material.kind, MaterialKind::Diffuse);
    EXPECT_EQ(material.albedo, glm::vec3(0.8f));
    EXPECT_TRUE(material.twoSided);
    EXPECT_EQ(scene.background, glm::vec3(0.05f));
}

TEST(Framing, SizesBeyondReasonAreRefused) {
    const std::vector<TriangleMesh> refused = {spanning({0, 0, 0}, {1e14f, 1, 1}),
                                               spanning({0, 0, 0}, {1e-20f, 0, 0}), TriangleMesh{}};
    for (const TriangleMesh &mesh : refused)
        try {
            static_cast<void>(frameMesh(mesh));
            ADD_FAILURE() << "accepted";
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::BadInput);
        }
}

TEST(Framing, ABareObjFileIsLoadedFramedAndValid) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "triangle.obj";
    std::ofstream(file) << "v 0 0 0\nv 10 0 0\nv 0 20 0\nf 1 2 3\n";
    const LoadedScene loaded = loadScene(file.string());
    EXPECT_TRUE(loaded.autoFramed);
    EXPECT_EQ(loaded.file, file);
    EXPECT_EQ(loaded.meshReports.size(), 1u);
    EXPECT_EQ(triangleCount(loaded.scene), 1u);
    const glm::dvec2 extent = largestExtent(triangleBounds(loaded.scene.meshes.at(0)), loaded.scene.camera);
    EXPECT_NEAR(std::max(extent.x, extent.y), 0.92, 1e-6);
}

} // namespace
} // namespace hyalite::core
