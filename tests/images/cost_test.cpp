// Pictures of the cost: the work of each pixel, equal on every device and on the CPU, and adding up to the counts.
#include "tests/images/rendering.h"

#include "host/base/error.h"
#include "host/film/film_file.h"
#include "host/scene/names.h"
#include "tests/fixtures/test_scene.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TestScene costOf(const std::string &name, int samplesPerPixel) {
    TestScene scene = testing::shippedScene(name, 40, 30, samplesPerPixel);
    scene.settings.integrator = Integrator::Cost;
    return scene;
}

TEST(Cost, IsEqualOnDeviceAndCpuHoweverTheWorkIsCut) {
    for (const char *name : {"cat", "spheres-nested"}) {
        const TestScene scene = costOf(name, 3);
        const reference::Result onCpu = testing::renderOnCpu(scene);
        for (const gpu::RenderConfig &config :
             {gpu::RenderConfig{}, gpu::RenderConfig{.kernel = gpu::findKernel("stack")},
              gpu::RenderConfig{.steps = 100, .kernel = gpu::findKernel("stack")}}) {
            const gpu::Result onDevice = testing::renderOnDevice(scene, config);
            EXPECT_EQ(testing::differingPixels(onDevice.film, onCpu.film), 0u) << name;
            EXPECT_EQ(onDevice.work, onCpu.work) << name;
            EXPECT_EQ(onDevice.rays, onCpu.rays) << name;
        }
    }
}

TEST(Cost, OfAllPixelsIsTheCountOfTheFrame) {
    const reference::Result result = testing::renderOnCpu(costOf("cat", 4));
    glm::dvec3 sum(0.0);
    for (const layout::FilmPixel &pixel : result.film.pixels)
        sum += glm::dvec3(pixel.sum);
    EXPECT_EQ(sum.x, static_cast<double>(result.work.nodesVisited));
    EXPECT_EQ(sum.y, static_cast<double>(result.work.boxesTested));
    EXPECT_EQ(sum.z, static_cast<double>(result.work.trianglesTested));
    EXPECT_GT(sum.z, 0.0);
    double tests = 0.0;
    for (const float perSample : testsPerSample(result.film))
        tests += 4.0 * static_cast<double>(perSample);
    EXPECT_EQ(tests, sum.y + sum.z);
}

TEST(Cost, FollowsTheRaysOfThePicture) {
    TestScene scene = costOf("spheres-nested", 2);
    const reference::Result cost = testing::renderOnCpu(scene);
    scene.settings.integrator = Integrator::Whitted;
    EXPECT_EQ(cost.rays, testing::renderOnCpu(scene).rays);
}

TEST(Cost, IsThatOfTheIntegrator) {
    TestScene scene = costOf("cat", 2);
    for (const Integrator integrator : {Integrator::Path, Integrator::AmbientOcclusion}) {
        scene.settings.integrator = integrator;
        scene.settings.isWorkShown = false;
        const reference::Result picture = testing::renderOnCpu(scene);
        scene.settings.isWorkShown = true;
        const reference::Result onCpu = testing::renderOnCpu(scene);
        const gpu::Result onDevice = testing::renderOnDevice(scene);
        EXPECT_EQ(onCpu.rays, picture.rays) << nameOf(integrator);
        EXPECT_EQ(testing::differingPixels(onDevice.film, onCpu.film), 0u) << nameOf(integrator);
        EXPECT_EQ(onDevice.work, onCpu.work) << nameOf(integrator);
        EXPECT_EQ(onDevice.rays, onCpu.rays) << nameOf(integrator);
        double tests = 0.0;
        for (const float perSample : testsPerSample(onCpu.film))
            tests += 2.0 * static_cast<double>(perSample);
        EXPECT_GT(tests, 0.0) << nameOf(integrator);
        EXPECT_EQ(tests, static_cast<double>(onCpu.work.boxesTested + onCpu.work.trianglesTested))
            << nameOf(integrator);
    }
}

TEST(Cost, IsNotThatOfASkipList) {
    const TestScene scene = costOf("cat", 1);
    try {
        (void)testing::renderOnDevice(scene, {.kernel = gpu::findKernel("skip-list")});
        ADD_FAILURE() << "rendered";
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::Usage);
        EXPECT_NE(std::string(error.what()).find("skip-list"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace hyalite::core
