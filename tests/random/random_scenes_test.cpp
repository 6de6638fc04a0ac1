// Random scenes are the same on the device and on the CPU. By default 24 of them; README.md says how to run more.
#include "tests/fixtures/temporary_folder.h"
#include "tests/fixtures/test_device.h"
#include "tests/random/random_scene.h"
#include "tests/random/scene_check.h"
#include "tests/random/scene_document.h"
#include "tests/random/shrink.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <sstream>

namespace hyalite::core::testing {
namespace {

std::string environment(const char *name, const char *fallback) {
    const char *value = std::getenv(name);
    return value != nullptr ? value : fallback;
}

/// HYALITE_RANDOM_SEEDS, HYALITE_RANDOM_MINUTES and HYALITE_RANDOM_KERNELS.
struct Wanted {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    double minutes = 1e9;
    std::vector<std::string> kernels{};

    Wanted() {
        const bool isLong = std::getenv("HYALITE_TEST_ALL") != nullptr;
        const std::string seeds = environment("HYALITE_RANDOM_SEEDS", isLong ? "8-1000000" : "8-31");
        std::size_t length = 0;
        first = last = std::stoull(seeds, &length);
        if (length < seeds.size())
            last = std::stoull(seeds.substr(length + 1));
        minutes = std::stod(environment("HYALITE_RANDOM_MINUTES", isLong ? "30" : "1e9"));
        std::istringstream names(environment("HYALITE_RANDOM_KERNELS", ""));
        for (std::string name; std::getline(names, name, ',');)
            kernels.push_back(name);
    }
};

/// Shrinks a faulty scene, keeps its files, and says how to see it.
void report(SceneCheck &check, std::uint64_t seed, const Way &way, RandomScene scene, const Fault &fault) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / fmt::format("hyalite-random-{}", seed);
    const double maxSeconds = std::stod(environment("HYALITE_RANDOM_SHRINK_SECONDS", "60"));
    RandomScene tried = scene;
    if (fault.kind != FaultKind::Refused) // whose text says what is wrong
        scene.document = shrunk(
            scene.document,
            [&](const nlohmann::json &document) {
                tried.document = document;
                const std::optional<Fault> other = check.faultOf(tried, way, folder / "tried");
                return other && other->kind == fault.kind;
            },
            maxSeconds);
    std::filesystem::remove_all(folder);
    const std::filesystem::path file = writeDocument(scene.document, folder);
    ADD_FAILURE() << "seed " << seed << ", kernel " << way.kernel << (way.isHurried ? ", hurried" : "")
                  << (way.isEncoded ? ", encoded" : "") << (way.isFlattened ? ", flattened" : "") << ": "
                  << fault.text << "\n"
                  << scene.document.dump() << "\nHYALITE_RANDOM_SEEDS=" << seed
                  << " random_tests\nhyalite compare " << file.string() << " --device '" << testDevice().name
                  << "' --kernel " << way.kernel;
}

TEST(RandomScenes, AreTheSameOnDeviceAndCpuAndGainNoLight) {
    const Wanted wanted;
    const bool isByHand = std::getenv("HYALITE_RANDOM_SEEDS") != nullptr;
    SceneCheck check(wanted.kernels);
    const TemporaryFolder temporary;
    const std::filesystem::path &folder = temporary.path;
    const auto begin = std::chrono::steady_clock::now();
    std::uint64_t count = 0;
    for (std::uint64_t seed = wanted.first; seed <= wanted.last; ++seed) {
        if (std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(60.0 * wanted.minutes))
            break;
        const RandomScene scene = drawScene(seed);
        const Way way =
            check.wayOf(seed, scene.document["scene"]["settings"].value("integrator", std::string()));
        const std::clock_t processorBegin = std::clock();
        if (isByHand) { // so that a crash has a seed
            fmt::print("seed {}, {}{}{}{}: ", seed, way.kernel, way.isHurried ? ", hurried" : "",
                       way.isEncoded ? ", encoded" : "", way.isFlattened ? ", flattened" : "");
            std::fflush(stdout);
        }
        if (const std::optional<Fault> fault = check.faultOf(scene, way, folder))
            report(check, seed, way, scene, *fault);
        std::filesystem::remove_all(folder);
        if (isByHand)
            fmt::print("{:.2f} s of processor time\n",
                       static_cast<double>(std::clock() - processorBegin) / CLOCKS_PER_SEC);
        ++count;
    }
    fmt::print("{} scenes\n", count);
    EXPECT_GT(count, 0u);
}

// Eyes in glass so dark that paths came to carry subnormal numbers, and an eye that a lens takes through glass.
TEST(RandomScenes, WithFaultsOnceHaveNoneOnTheCpu) {
    SceneCheck check({std::string(noKernel)});
    const TemporaryFolder temporary;
    const std::filesystem::path &folder = temporary.path;
    for (const std::uint64_t seed : {50168u, 50172u, 78119u})
        if (const std::optional<Fault> fault = check.faultOf(drawScene(seed), {noKernel}, folder))
            ADD_FAILURE() << "seed " << seed << ": " << fault->text;
}

TEST(RandomScenes, AreThoseOfTheirSeeds) {
    EXPECT_EQ(drawScene(5).document, drawScene(5).document);
    EXPECT_NE(drawScene(5).document, drawScene(6).document);
    EXPECT_NE(drawScene(5).document, drawScene(5 + scenesOfKind).document);
}

} // namespace
} // namespace hyalite::core::testing
