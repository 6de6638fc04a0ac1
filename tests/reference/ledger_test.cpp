// Work ledgers: every ray is charged once, to what it should be.
#include "host/film/work_ledger.h"

#include "host/reference/renderer.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::addQuad;
using hyalite::core::testing::packed;

Result charged(const TestScene &scene, const Options &options) {
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    return render(packed(scene), scene.settings, Film(crop), options);
}

TEST(WorkLedger, HasAllRaysAndTests) {
    for (const char *name : {"cat", "cornell", "spheres", "still-life"})
        for (const Integrator integrator : {Integrator::Whitted, Integrator::Path}) {
            TestScene scene = loadTestScene(name);
            scene.camera.width = 40;
            scene.camera.height = 30;
            scene.settings.integrator = integrator;
            scene.settings.samplesPerPixel = 2;
            const Result counted = charged(scene, {.isCounting = true});
            const Result result = charged(scene, {.threadCount = 3, .isCharging = true});
            EXPECT_EQ(result.rays, counted.rays) << name;
            EXPECT_EQ(result.ledger, charged(scene, {.threadCount = 1, .isCharging = true}).ledger) << name;
            const WorkByStage totals = result.ledger.totals();
            EXPECT_EQ(sumOf(totals).boxes, counted.work.boxesTested) << name;
            EXPECT_EQ(sumOf(totals).triangles, counted.work.trianglesTested) << name;
            EXPECT_EQ(totals[0].rays, counted.rays.primary) << name;
            EXPECT_EQ(totals[1].rays, counted.rays.reflection + counted.rays.refraction + counted.rays.bounce)
                << name;
            EXPECT_EQ(totals[2].rays, counted.rays.shadow) << name;
            EXPECT_EQ((WorkLedger{result.ledger.materials, {}}.totals()), totals) << name;
            glm::dvec3 tests(0.0);
            for (const layout::FilmPixel &pixel : result.film.pixels)
                tests += glm::dvec3(pixel.sum);
            for (glm::length_t stage = 0; stage < 3; ++stage)
                EXPECT_EQ(tests[stage], static_cast<double>(totals[static_cast<std::size_t>(stage)].tests()))
                    << name;
        }
}

TEST(WorkLedger, ChargesWhatIsMetAndWhatSendsShadowRays) {
    TestScene scene; // one pixel sees a wall behind the eye, in a mirror
    scene.camera.position = {0, 0, 0};
    scene.camera.width = scene.camera.height = 1;
    scene.camera.horizontalFovDegrees = 1.0;
    scene.settings.samplesPerPixel = 3;
    scene.settings.integrator = Integrator::Whitted;
    Material mirror;
    mirror.kind = MaterialKind::Mirror;
    scene.materials = {mirror, Material()};
    const auto addWall = [&](std::uint32_t material, const glm::vec3 &corner, const glm::vec3 &a,
                             const glm::vec3 &b) {
        scene.meshes.emplace_back();
        scene.meshes.back().materialIndex = material;
        scene.meshes.back().name = fmt::format("wall {}", material);
        addQuad(scene.meshes.back(), corner, a, b);
    };
    addWall(0, {-9, -9, -2}, {20, 0, 0}, {0, 20, 0});
    addWall(1, {-9, -11, 3}, {0, 20, 0}, {20, 0, 0});
    scene.lights.push_back({{0, 3, -1}, glm::dvec3(1000.0)});
    const WorkLedger ledger = charged(scene, {.isCharging = true}).ledger;
    ASSERT_EQ(ledger.objects.size(), 3u);
    const auto raysOf = [](const WorkByStage &work) {
        return std::array<std::uint64_t, 3>{work[0].rays, work[1].rays, work[2].rays};
    };
    EXPECT_EQ(raysOf(ledger.objects[0]), (std::array<std::uint64_t, 3>{0, 0, 0}));
    EXPECT_EQ(raysOf(ledger.objects[1]), (std::array<std::uint64_t, 3>{3, 0, 0}));
    EXPECT_EQ(raysOf(ledger.objects[2]), (std::array<std::uint64_t, 3>{0, 3, 3}));
    EXPECT_EQ(ledger.materials, ledger.objects);
    EXPECT_GT(ledger.objects[2][2].triangles, 0u);

    scene.settings.maxDepth = 2;
    scene.meshes.pop_back(); // what the mirror shows is the background
    scene.background = glm::vec3(1.0f);
    const WorkLedger open = charged(scene, {.isCharging = true}).ledger;
    EXPECT_EQ(raysOf(open.objects[0]), (std::array<std::uint64_t, 3>{0, 3, 0}));
}

} // namespace
} // namespace hyalite::core::reference
