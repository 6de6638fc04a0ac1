// No picture depends on whether numbers below 2^-126 are flushed to zero, as some drivers do and Vulkan allows.
#include "host/import/assets.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <thread>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hyalite::testing {
namespace {

/// Operands and results of this thread's float operations that are subnormal become zero from now on.
void flushSubnormals() {
#if defined(__x86_64__)
    constexpr unsigned flushesResults = 0x8000;
    constexpr unsigned flushesOperands = 0x0040;
    _mm_setcsr(_mm_getcsr() | flushesResults | flushesOperands);
#elif defined(__aarch64__)
    constexpr std::uint64_t flushes = std::uint64_t{1} << 24;
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    asm volatile("msr fpcr, %0" : : "r"(control | flushes));
#else
#error "how does this processor flush subnormal numbers?"
#endif
}

Film filmOf(const Scene &scene) {
    const PackedScene packed = pack(scene);
    return reference::render(packed, scene.settings, {0, scene.camera.width, 0, scene.camera.height},
                             {.threadCount = 1})
        .film;
}

void expectNoChange(const Scene &scene, const std::string &name) {
    const Film kept = filmOf(scene);
    Film flushed = kept;
    volatile float smallest = 1e-38f;
    float half = 1.0f;
    std::thread([&] {
        flushSubnormals();
        half = smallest * 0.5f;
        flushed = filmOf(scene);
    }).join();
    EXPECT_EQ(half, 0.0f) << "subnormals were not flushed";
    EXPECT_EQ(differingPixels(kept, flushed), 0u) << name;
}

TEST(Subnormals, ChangeNoBitOfTheShippedScenes) {
    ASSERT_GE(availableScenes().size(), 11u);
    for (const std::string &name : availableScenes())
        expectNoChange(shippedScene(name, 48, 32, 2), name);
}

// Light so faint that the squares of radiance, or radiance itself, are subnormal.
TEST(Subnormals, ChangeNoBitOfFaintLight) {
    for (const double factor : {1e-19, 1e-38}) {
        Scene scene = shippedScene("spheres", 48, 32, 2);
        scene.background *= static_cast<float>(factor);
        for (Light &light : scene.lights)
            light.power *= factor;
        expectNoChange(scene, "spheres");
    }
}

} // namespace
} // namespace hyalite::testing
