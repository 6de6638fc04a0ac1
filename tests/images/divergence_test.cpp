// A fault planted in one twin is found, and named. Each faulty kernel is ours with one line changed (CMakeLists.txt).
#include "host/reference/divergence.h"
#include "tests/images/rendering.h"

#include "faultInCamera.h"
#include "faultInEmitter.h"
#include "faultInFresnel.h"
#include "faultInLight.h"
#include "faultInNormal.h"
#include "faultInScatter.h"
#include "faultInShadow.h"
#include "faultInSphere.h"
#include "faultInTint.h"
#include "faultInTriangle.h"
#include "tests/fixtures/test_scene.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

/// The first divergence of any sample of the first pixel that differs.
std::optional<Divergence> findPlanted(const TestScene &scene, std::span<const std::uint32_t> spirv) {
    const PackedScene packed = testing::pack(scene);
    gpu::Renderer faulty(testing::testDevice(), {.kernel = gpu::findKernel("stack"), .spirv = spirv});
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    const Film film = faulty.render(packed, scene.settings, crop).film;
    const Film right = testing::renderOnCpu(scene).film;
    EXPECT_GT(testing::differingPixels(film, right), 0u);
    for (int y = 0; y < crop.y1; ++y) {
        for (int x = 0; x < crop.x1; ++x) {
            const std::size_t index = static_cast<std::size_t>(y * crop.x1 + x);
            if (film.pixels[index].sum == right.pixels[index].sum)
                continue;
            const glm::uvec2 pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            for (std::uint32_t sample = 0; sample < 2; ++sample) {
                const auto divergence = findDivergence(
                    faulty.trace(packed, scene.settings, pixel, sample),
                    reference::trace(packed, scene.settings, pixel, sample, reference::Precision::Float32),
                    packed.frame.firstTriangleId);
                if (divergence)
                    return divergence;
            }
        }
    }
    return std::nullopt;
}

void expectNamed(const TestScene &scene, std::span<const std::uint32_t> kernel, const std::string &quantity) {
    const std::optional<Divergence> divergence = findPlanted(scene, kernel);
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->quantity, quantity) << divergence->valueA << " and " << divergence->valueB;
    EXPECT_NE(divergence->valueA, divergence->valueB);
    EXPECT_GE(divergence->rayDepth, 1u);
}

TestScene balls() { return testing::shippedScene("spheres", 40, 30, 2); }

TEST(PlantedFault, InTheCamera) { expectNamed(balls(), faultInCamera, "ray direction"); }

TEST(PlantedFault, InTheSphere) { expectNamed(balls(), faultInSphere, "hit distance"); }

TEST(PlantedFault, InTheTriangle) {
    expectNamed(testing::shippedScene("cat", 40, 30, 2), faultInTriangle, "hit weights");
}

TEST(PlantedFault, InTheNormal) { expectNamed(balls(), faultInNormal, "surface normal"); }

TEST(PlantedFault, InTheFresnelTerm) { expectNamed(balls(), faultInFresnel, "reflectance"); }

TEST(PlantedFault, InTheTintOfGlass) { expectNamed(balls(), faultInTint, "throughput"); }

TEST(PlantedFault, InTheShadow) { expectNamed(balls(), faultInShadow, "light visibility"); }

TestScene lamps() { return testing::shippedScene("lamps", 40, 30, 2); }

TEST(PlantedFault, InTheScatteredDirection) { expectNamed(lamps(), faultInScatter, "scattered direction"); }

TEST(PlantedFault, InTheWeightOfLight) { expectNamed(lamps(), faultInLight, "radiance"); }

TEST(PlantedFault, InTheChoiceOfAnEmitter) { expectNamed(lamps(), faultInEmitter, "light visibility"); }

// The same kernel, traced on both sides: every step is there, and equal.
TEST(Trace, OfBothTwinsIsEqual) {
    for (const char *name : {"spheres-nested", "cat", "cornell", "lamps"}) {
        const TestScene scene = testing::shippedScene(name, 32, 32, 1);
        const PackedScene packed = testing::pack(scene);
        gpu::Renderer &renderer = testing::rendererBy({});
        for (const glm::uvec2 pixel : {glm::uvec2(26, 16), glm::uvec2(16, 16), glm::uvec2(3, 30)}) {
            const auto device = renderer.trace(packed, scene.settings, pixel, 0);
            const auto cpu =
                reference::trace(packed, scene.settings, pixel, 0, reference::Precision::Float32);
            EXPECT_GE(device.size(), 7u);
            EXPECT_EQ(device.size(), cpu.size());
            const auto divergence = findDivergence(device, cpu, packed.frame.firstTriangleId);
            EXPECT_FALSE(divergence) << name << ": " << divergence->quantity << ", " << divergence->valueA;
        }
    }
}

} // namespace
} // namespace hyalite::core
