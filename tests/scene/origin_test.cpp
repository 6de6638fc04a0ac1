// The origin of scenes that are small and far from zero.
#include "host/scene/origin.h"

#include "host/scene/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyalite::core {
namespace {

Bounds cubeAt(const glm::dvec3 &centre, double side) { return {centre - 0.5 * side, centre + 0.5 * side}; }

TEST(Origin, IsZeroUntilStepsOfFloatsShow) {
    EXPECT_EQ(originOf(cubeAt({1e6, 0, 0}, 1e6 / 1000.0)), glm::dvec3(0.0));
    EXPECT_NE(originOf(cubeAt({1e6, 0, 0}, 1e6 / 1100.0)), glm::dvec3(0.0));
    EXPECT_EQ(originOf(cubeAt({0, 0, 0}, 1e-9)), glm::dvec3(0.0));
    EXPECT_EQ(OriginFinder().origin(), glm::dvec3(0.0));
}

TEST(Origin, TakesTheRoundNumberThatAFarSceneWasMovedBy) {
    const glm::dvec3 utm(500'000, 100, 5'400'000);
    for (const double side : {10.0, 7.3, 1.0})
        EXPECT_EQ(originOf(cubeAt(utm + glm::dvec3(0.1, -0.2, 0.3), side)), utm);
    for (int exponent = 12; exponent < 48; ++exponent) {
        const glm::dvec3 binary(std::exp2(exponent), -std::exp2(exponent), 0.0);
        EXPECT_EQ(originOf(cubeAt(binary, 1.5)), binary) << exponent;
    }
    EXPECT_EQ(originOf(cubeAt({0.25, -300.0, 0.0}, 1e-4)), glm::dvec3(0.25, -300.0, 0.0));
}

TEST(Origin, IsNearWhateverIsFar) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (int i = 0; i < 10'000; ++i) {
        const double scale = std::exp2(60.0 * place(random));
        const double side = scale * std::exp2(-24.0 + 12.0 * place(random));
        const glm::dvec3 centre = scale * glm::dvec3(place(random), place(random), place(random));
        const glm::dvec3 origin = originOf(cubeAt(centre, side));
        if (origin == glm::dvec3(0.0))
            continue;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            EXPECT_LE(std::abs(origin[axis] - centre[axis]), 2.0 * side * (1.0 + 1e-9)) << i;
    }
}

TEST(Origin, IsKnownToBeZeroAsSoonAsPointsAreNotFar) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        OriginFinder finder;
        bool wasNear = false;
        glm::dvec3 point(0.0, 1000.0 * place(random), 1000.0);
        for (int k = 0; k < 60; ++k) {
            point += std::exp2(0.2 * k) * glm::dvec3(place(random), place(random), place(random));
            const bool isFar = finder.add(point);
            EXPECT_FALSE(wasNear && isFar) << i << ' ' << k;
            wasNear = !isFar;
            EXPECT_EQ(finder.origin() == glm::dvec3(0.0), wasNear) << i << ' ' << k;
        }
    }
}

/// A scene of all that has a place, moved. Its coordinates are exact in double precision, and near zero as floats.
Scene sceneAt(const glm::dvec3 &place) {
    const auto mapTo = [&](const glm::dvec3 &offset) {
        return glm::dmat4x3(0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5, offset.x, offset.y, offset.z);
    };
    Scene scene;
    scene.materials.resize(1);
    scene.camera.position = place + glm::dvec3(0.1, 0.2, 5.0);
    scene.lights = {{.position = place + glm::dvec3(1.5), .power = glm::dvec3(1.0)},
                    {.position = glm::dvec3(0.0), .power = glm::dvec3(1.0), .kind = LightKind::Directional}};
    scene.spheres = {{.centre = place + glm::dvec3(0.25, 0.5, 0.75), .radius = 0.5}};
    scene.meshes.push_back(transformed(makeShape(ShapeKind::Box, 0), mapTo(place)));
    scene.meshes.push_back(
        transformed(makeShape(ShapeKind::Quad, 0), mapTo(place + glm::dvec3(1, 0, 0.125))));
    scene.prototypes.push_back(makeShape(ShapeKind::Disk, 8));
    Instance instance;
    instance.toWorld.offset = glm::vec3(place + 0.375);
    instance.toWorld.offsetRest = place + 0.375 - glm::dvec3(instance.toWorld.offset);
    scene.instances = {instance};
    return scene;
}

TEST(MoveNear, GivesAFarSceneTheBitsOfTheNearOne) {
    const Scene wanted = sceneAt(glm::dvec3(0.0));
    for (const glm::dvec3 &place :
         {glm::dvec3(500'000, 100, 5'400'000), glm::dvec3(-4'194'304, 0, 1'048'576)}) {
        Scene scene = sceneAt(place);
        CameraPath path{poseOf(scene.camera)};
        moveNear(scene, path);
        EXPECT_EQ(scene.origin, place);
        EXPECT_EQ(path[0].position, scene.camera.position);
        EXPECT_LT(glm::length(scene.camera.position - wanted.camera.position), 1e-8);
        EXPECT_EQ(scene.lights[0].position, wanted.lights[0].position);
        EXPECT_EQ(scene.lights[1].position, wanted.lights[1].position);
        EXPECT_EQ(scene.spheres[0].centre, wanted.spheres[0].centre);
        for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
            EXPECT_EQ(scene.meshes[i].positions, wanted.meshes[i].positions) << i;
            EXPECT_EQ(scene.meshes[i].origin, glm::dvec3(0.0));
        }
        EXPECT_EQ(scene.instances[0].toWorld.offset, wanted.instances[0].toWorld.offset);
        EXPECT_EQ(scene.instances[0].toWorld.offsetRest, glm::dvec3(0.0));
    }
}

TEST(MoveNear, DoesNotLookAtCamerasAndLights) {
    Scene scene = sceneAt({500'000, 100, 5'400'000});
    scene.camera.position = glm::dvec3(0.0);
    scene.lights[0].position = glm::dvec3(1e9);
    CameraPath path;
    moveNear(scene, path);
    EXPECT_EQ(scene.origin, glm::dvec3(500'000, 100, 5'400'000));
    EXPECT_EQ(scene.camera.position, -scene.origin);
}

TEST(MoveNear, BringsFarMeshesOfALargeSceneToTheirPlace) {
    Scene scene = sceneAt({500'000, 100, 5'400'000});
    EXPECT_NE(scene.meshes[0].origin, glm::dvec3(0.0));
    scene.spheres.push_back({.centre = glm::dvec3(0.0), .radius = 1.0});
    CameraPath path;
    moveNear(scene, path);
    EXPECT_EQ(scene.origin, glm::dvec3(0.0));
    EXPECT_EQ(scene.meshes[0].positions[0],
              glm::vec3(glm::dvec3(500'000, 100, 5'400'000) +
                        0.5 * glm::dvec3(makeShape(ShapeKind::Box, 0).positions[0])));
}

TEST(MoveNear, HasOneOriginAtAllTimesWhereOneIsKnown) {
    Scene scene = sceneAt({500'000, 100, 5'400'000});
    CameraPath path;
    moveNear(scene, path, glm::dvec3(500'000, 0, 5'400'000));
    EXPECT_EQ(scene.origin, glm::dvec3(500'000, 0, 5'400'000));
    EXPECT_EQ(scene.spheres[0].centre, glm::dvec3(0.25, 100.5, 0.75));
}

} // namespace
} // namespace hyalite::core
