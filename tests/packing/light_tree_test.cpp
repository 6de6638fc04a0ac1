// The light tree, and the choice of emitters by it.
#include "host/packing/light_tree.h"
#include "host/reference/scene_view.h"
#include "tests/fixtures/geometry_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;

/// Lights of every kind around the origin, and a sky.
Scene manyLights(std::uint64_t seed, int count) {
    Random random(seed);
    Scene scene;
    scene.materials.resize(4);
    scene.materials[1].emission = glm::vec3(2.0f, 3.0f, 1.0f);
    scene.materials[2].emission = glm::vec3(20.0f, 5.0f, 9.0f);
    scene.materials[2].twoSided = true;
    const auto lamp = [&] { return static_cast<std::uint32_t>(random.below(3)); };
    for (int i = 0; i < count; ++i) {
        scene.spheres.push_back({random.inCube(8.0), random.logUniform(1e-3, 0.5), lamp(), random.coin()});
        Light light;
        light.kind = static_cast<LightKind>(i % 2);
        light.position = random.inCube(8.0);
        light.direction = random.direction();
        light.angleDegrees = random.uniform(1.0, 180.0);
        light.fade = random.coin() ? SpotFade::Square : SpotFade::Smooth;
        light.power = glm::dvec3(random.logUniform(1e-2, 1e3));
        scene.lights.push_back(light);
    }
    scene.lights.push_back({{}, glm::dvec3(1.0), LightKind::Directional});
    TriangleMesh soup =
        hyalite::core::testing::triangleSoup(random, static_cast<std::size_t>(count), 8.0, 0.5);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        soup.triangleMaterials.push_back(lamp());
    scene.meshes.push_back(soup);
    return scene;
}

PackedScene packed(const Scene &scene) {
    return packScene(scene, buildBvh(TreeKind::Sah, scene, 4), {.lightChoice = LightChoice::Tree});
}

LitPoint<float> randomPoint(Random &random) {
    return {glm::vec3(random.inCube(random.logUniform(1.0, 100.0))), glm::vec3(random.direction()),
            random.below(4) == 0};
}

double chanceOf(const SceneView<float> &view, std::uint32_t emitter, const LitPoint<float> &point) {
    return double{chanceOfTree<float>(view)} *
           double{chanceInTree(view, point, view.packed.emitters[emitter].cumulative)};
}

TEST(LightTree, HoldsEveryEmitterOnce) {
    for (const int count : {1, 2, 3, 50, 4000}) {
        const PackedScene scene = packed(manyLights(901, count));
        ASSERT_EQ(scene.infiniteEmitterCount, 1u);
        const std::size_t finite = scene.emitters.size() - 1;
        ASSERT_EQ(scene.lightNodes.size(), 2 * (finite - 1));
        std::vector<int> timesSeen(scene.emitters.size());
        for (std::uint32_t i = 1; i < scene.emitters.size(); ++i) {
            std::uint32_t turns = scene.emitters[i].cumulative;
            std::uint32_t reference = 0;
            while ((reference & layout::leafFlag) == 0) {
                reference = scene.lightNodes[lightNodeIndex(reference) + (turns & 1u)].reference;
                turns >>= 1;
            }
            ++timesSeen[lightNodeIndex(reference)];
        }
        timesSeen[0] = 1;
        EXPECT_EQ(std::ranges::count(timesSeen, 1), std::ssize(timesSeen));
        for (std::uint32_t i = 0; i < scene.spheres.size(); ++i)
            if (scene.spheres[i].emitter != layout::noEmitter) {
                EXPECT_EQ(scene.emitters[scene.spheres[i].emitter].record, i);
            }
    }
}

TEST(LightTree, HasChancesThatAddUpToOne) {
    Random random(902);
    const PackedScene scene = packed(manyLights(902, 60));
    const SceneView<float> view(scene);
    Tally wrong("points whose chances do not add up", random.seed());
    for (int i = 0; i < 2000; ++i) {
        const LitPoint<float> point = randomPoint(random);
        double sum = 0.0;
        for (std::uint32_t emitter = 1; emitter < scene.emitters.size(); ++emitter)
            sum += chanceOf(view, emitter, point);
        const double wanted = double{chanceOfTree<float>(view)};
        // Where all of a cluster's lights turn out to face away, its chance is lost.
        wrong.check(sum <= wanted * (1.0 + 1e-5), [&] { return fmt::format("{} of {}", sum, wanted); });
    }
    wrong.expectNone();
}

// Chi-square over the emitters, of the choices of all random numbers in turn.
TEST(LightTree, ChoosesEmittersWithTheirChances) {
    Random random(903);
    const PackedScene scene = packed(manyLights(903, 20));
    const SceneView<float> view(scene);
    for (int trial = 0; trial < 20; ++trial) {
        const LitPoint<float> point = randomPoint(random);
        constexpr std::uint32_t draws = 1u << 18;
        std::vector<double> counts(scene.emitters.size());
        double lost = 0.0;
        for (std::uint32_t i = 0; i < draws; ++i) {
            const auto bits = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32));
            const EmitterChoice<float> choice = chooseEmitter(view, point, bits);
            if (!(choice.chance > 0.0f)) {
                lost += 1.0;
                continue;
            }
            counts[choice.index] += 1.0;
            if (choice.index > 0 && i < 1000) {
                EXPECT_NEAR(choice.chance, chanceOf(view, choice.index, point), 1e-5 * choice.chance);
            }
        }
        double chiSquare = 0.0;
        double rare = 0.0;
        double rareWanted = 0.0;
        int cells = 0;
        double sum = 0.0;
        for (std::uint32_t i = 0; i < counts.size(); ++i) {
            const double chance =
                i == 0 ? double{chanceOfInfiniteEmitter<float>(view)} : chanceOf(view, i, point);
            sum += chance;
            if (chance * draws < 10.0) {
                rare += counts[i];
                rareWanted += chance * draws;
                continue;
            }
            chiSquare += std::pow(counts[i] - chance * draws, 2.0) / (chance * draws);
            ++cells;
        }
        rare += lost;
        rareWanted += (1.0 - sum) * draws;
        if (rareWanted > 5.0) {
            chiSquare += std::pow(rare - rareWanted, 2.0) / rareWanted;
            ++cells;
        }
        const double freedom = cells - 1;
        EXPECT_LT(chiSquare, freedom + 5.0 * std::sqrt(2.0 * freedom) + 10.0) << cells << " cells";
    }
}

// What can light a point has a chance there, or paths would miss it.
TEST(LightTree, PassesOverNothingThatLights) {
    Random random(904);
    const Scene input = manyLights(904, 200);
    const PackedScene scene = packed(input);
    const SceneView<float> view(scene);
    Tally missed("lights that are never chosen", random.seed());
    for (int i = 0; i < 20'000; ++i) {
        const LitPoint<float> point = randomPoint(random);
        const auto emitter = static_cast<std::uint32_t>(1 + random.below(scene.emitters.size() - 1));
        const uvec2 bits(static_cast<uint>(random.below(std::uint64_t{1} << 32)),
                         static_cast<uint>(random.below(std::uint64_t{1} << 32)));
        const LightSample<float> sample =
            sampleEmitter<float>(view, EmitterChoice<float>{emitter, 1.0f}, point.position, bits);
        const float cosine = dotProduct(sample.direction, point.normal);
        const bool lights = largestComponent(sample.radiance) > 0.0f &&
                            (point.isTransmitting ? cosine != 0.0f : cosine > 0.0f);
        missed.check(!lights || chanceOf(view, emitter, point) > 0.0, [&] {
            return fmt::format("emitter {} of kind {}", emitter, scene.emitters[emitter].kind);
        });
    }
    missed.expectNone();
}

} // namespace
} // namespace hyalite::core::reference
