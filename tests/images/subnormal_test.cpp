// No picture depends on whether numbers below 2^-126 are flushed to zero, as some drivers do and Vulkan allows.
#include "host/import/assets.h"
#include "tests/fixtures/subnormals.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

namespace hyalite::core::testing {
namespace {

void expectNoChange(const TestScene &scene, const std::string &name) {
    const PackedScene packed = pack(scene);
    const auto film = [&] {
        return reference::render(packed, scene.settings, Crop{0, scene.camera.width, 0, scene.camera.height},
                                 {.threadCount = 1})
            .film;
    };
    EXPECT_EQ(differingPixels(film(), withSubnormalsFlushed(film)), 0u) << name;
}

TEST(Subnormals, ChangeNoBitOfTheShippedScenes) {
    ASSERT_GE(availableScenes().size(), 11u);
    for (const std::string &name : availableScenes())
        expectNoChange(shippedScene(name, 48, 32, 2), name);
}

// Light so faint that the squares of radiance, or radiance itself, are subnormal.
TEST(Subnormals, ChangeNoBitOfFaintLight) {
    for (const double factor : {1e-19, 1e-38}) {
        TestScene scene = shippedScene("spheres", 48, 32, 2);
        scene.background *= static_cast<float>(factor);
        for (Light &light : scene.lights)
            light.power *= factor;
        expectNoChange(scene, "spheres");
    }
}

} // namespace
} // namespace hyalite::core::testing
