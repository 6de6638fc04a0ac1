// Kernels are specialised by flags of the scene: each has a scene that needs it, in which device and CPU agree, and
// which, as HYALITE_TEST_ALL looks, a kernel without the flag would render otherwise.
#include "tests/fixtures/test_device.h"
#include "tests/random/flag_scenes.h"

#include "host/gpu/renderer.h"
#include "host/reference/renderer.h"
#include "host/scene/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace hyalite::core::testing {
namespace {

std::size_t differingPixels(const Film &a, const Film &b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(a.pixels[i])) != 0 ? 1u : 0u;
    return count;
}

/// A skip list; for the cost a stack.
gpu::Renderer &rendererOf(Integrator integrator) {
    static gpu::Renderer stack(testDevice(), {.kernel = gpu::findKernel("stack")});
    static gpu::Renderer skipList(testDevice(), {.kernel = gpu::findKernel("skip-list")});
    return integrator == Integrator::Cost ? stack : skipList;
}

class Flag : public ::testing::TestWithParam<FlagScene> {};

TEST_P(Flag, IsSetForTheSceneThatNeedsItAndMakesItsPicture) {
    const FlagScene &row = GetParam();
    const RenderSettings &settings = row.scene.settings;
    validateScene(row.scene, row.flag);
    validateSettings(settings, row.scene, row.flag);
    PackedScene packed = packScene(row.scene, buildBvh(settings.tree, row.scene, settings.leafSize),
                                   {settings.lightChoice, row.isEncoded ? 0 : maxDecodedBytes});
    EXPECT_EQ(row.word(packed), row.expected);
    const Crop crop{0, row.scene.camera.width, 0, row.scene.camera.height};
    const reference::Result cpu = reference::render(packed, settings, crop);
    gpu::Renderer &renderer = rendererOf(settings.integrator);
    const gpu::Result device = renderer.render(packed, settings, crop);
    EXPECT_EQ(differingPixels(device.film, cpu.film), 0u);
    EXPECT_EQ(device.rays, cpu.rays);
    if (!row.clear || std::getenv("HYALITE_TEST_ALL") == nullptr)
        return;
    row.clear(packed);
    EXPECT_GT(differingPixels(renderer.render(packed, settings, crop).film, cpu.film), 0u)
        << "a kernel without the flag renders the same";
}

INSTANTIATE_TEST_SUITE_P(Each, Flag, ::testing::ValuesIn(flagScenes()), [](const auto &row) {
    std::string name = fmt::format("{}_{}", row.index, row.param.flag);
    std::ranges::replace_if(
        name, [](char c) { return c == ' ' || c == '-'; }, '_');
    return name;
});

// ---- Whether each flag has a scene

/// What kernels are specialised by beside the scene.
const std::set<std::string> ofDispatches = {"constantWorkgroupSize",
                                            "constantStackSize",
                                            "constantIsTracing",
                                            "constantExactDivision",
                                            "constantSamplesInFlight",
                                            "constantIsResumable",
                                            "constantPendingInRegisters",
                                            "constantIsCounting",
                                            "constantPathRegeneration",
                                            "constantBroadcasts",
                                            "constantCount"};

/// Words whose values or bits have rows of their own.
const std::set<std::string> ofSeveralFlags = {
    "constantSampler",   "constantView",    "constantShowsCost", "constantScattering",
    "constantLighting",  "constantCamera",  "constantTexturing", "constantTreeSpheres",
    "constantAnyHit",    "constantAlpha",   "scattersAtRough",   "anyHitAlpha",
    "texturesMaterials", "texturesOfLobes", "texturesSrgb",      "constantTallies"};

TEST(Flags, HaveAScene) {
    std::set<std::string> tested;
    for (const FlagScene &row : flagScenes())
        tested.insert(row.flag);
    std::ifstream file(HYALITE_SOURCE_DIR "/shaders/layout/layout.h");
    const std::string layout(std::istreambuf_iterator<char>(file), {});
    const std::regex flag(
        "const "
        "uint\\s+((scattersAt|lightsBy|passes|textures|treeHas|camera|sampler|alpha|constant)[A-Z]\\w*)\\s");
    std::size_t count = 0;
    for (std::sregex_iterator found(layout.begin(), layout.end(), flag), end; found != end;
         ++found, ++count) {
        const std::string name = (*found)[1];
        // A texture slot has a row by the name of the slot, from the table of slots.
        const bool isSlot =
            layout.find("slot" + name.substr(std::strlen("textures")) + " =") != std::string::npos &&
            name.starts_with("textures");
        EXPECT_EQ(
            tested.contains(name) + ofDispatches.contains(name) + ofSeveralFlags.contains(name) + isSlot, 1)
            << name << " needs a row in flag_scenes.cpp";
    }
    EXPECT_GT(count, 50u);
    for (const FlagScene &row : flagScenes())
        EXPECT_TRUE(layout.find("const uint " + row.flag) != std::string::npos ||
                    row.flag.find(' ') != std::string::npos)
            << row.flag << " is no flag";
}

} // namespace
} // namespace hyalite::core::testing
