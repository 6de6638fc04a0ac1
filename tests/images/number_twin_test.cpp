// Views of numbers, and the tallies of mattes: one film for every kernel, tile and number of samples in flight, on both
// renderers; and mattes that are the pictures of their objects alone.
#include "host/film/tally.h"
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/fixtures/texture_fixture.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::pack;
using testing::renderOnCpu;
using testing::renderOnDevice;
using testing::texturedQuad;

constexpr std::uint32_t grey = 0;
constexpr std::uint32_t veil = 1; // blended
constexpr std::uint32_t lace = 2; // cut out by the opacity of its corners
constexpr std::uint32_t glass = 3;

void addNamed(TestScene &scene, const std::string &name, TriangleMesh mesh) {
    mesh.node = static_cast<std::uint32_t>(scene.nodes.size());
    scene.nodes.push_back({.name = name});
    scene.meshes.push_back(std::move(mesh));
}

/// Things of all kinds, through a lens: some far out of focus, some smaller than a pixel.
TestScene things() {
    TestScene scene;
    scene.materials.resize(4);
    scene.materials[veil].alphaMode = AlphaMode::Blend;
    scene.materials[veil].opacity = 0.4f;
    scene.materials[lace].alphaMode = AlphaMode::CutOut;
    scene.materials[glass].kind = MaterialKind::Dielectric;
    scene.materials[grey].name = "grey";
    scene.spheres = {
        {{-0.6, 0.5, 0.5}, 0.4, glass}, {{0.7, -0.6, -1.0}, 0.5, grey}, {{0.1, 0.1, 2.0}, 0.01, grey}};
    addNamed(scene, "wall", texturedQuad({-1.5f, -0.6f, -2}, {2.5f, 0, 0}, {0, 1.5f, 0}, grey));
    addNamed(scene, "veil", texturedQuad({-0.9f, -0.8f, 1}, {1.2f, 0.2f, 0}, {0, 1, 0}, veil));
    TriangleMesh cloth = texturedQuad({0, -0.2f, 0}, {0.9f, 0, 0}, {0, 0.9f, 0}, lace);
    cloth.colours.values = {glm::vec4(1, 1, 1, 0), glm::vec4(1)};
    cloth.colours.corners = {{0, 1, 1}, {0, 1, 0}};
    addNamed(scene, "lace", cloth);
    testing::Random random(3);
    for (int i = 0; i < 24; ++i) { // many in each of a few pixels
        const glm::vec3 corner(-0.1f + 0.011f * static_cast<float>(i % 4),
                               -0.7f + 0.011f * static_cast<float>(i / 4), 1.0f);
        addNamed(scene, "crumb " + std::to_string(i),
                 texturedQuad(corner, {0.01f, 0, 0}, {0, 0.01f, 0}, grey));
    }
    std::vector<Placement> placements(30);
    std::vector<std::uint32_t> nodes(30, static_cast<std::uint32_t>(scene.nodes.size()));
    scene.nodes.push_back({.name = "bush"});
    scene.nodes.push_back({.name = "leaf", .parent = nodes[0]});
    for (std::size_t i = 0; i < placements.size(); ++i) {
        placements[i].offset = glm::vec3(random.inCube(0.4)) + glm::vec3(-0.6f, 0.3f, -1);
        nodes[i] += i % 2;
    }
    addInstances(scene, testing::placed(testing::icosphere(1), 0.08, {0, 0, 0}), placements, nodes);
    scene.camera.position = {0, 0, 6};
    scene.camera.direction = {0, 0, -1};
    scene.camera.horizontalFovDegrees = 24.0;
    scene.camera.aperture = 0.3;
    scene.camera.focusDistance = 5.0;
    scene.camera.width = 40;
    scene.camera.height = 32;
    scene.settings.samplesPerPixel = 21;
    return scene;
}

void expectTwins(TestScene scene, Integrator view, std::span<const gpu::RenderConfig> configs) {
    scene.settings.integrator = view;
    const PackedScene packed = pack(scene);
    const reference::Result wanted = renderOnCpu(scene, packed);
    for (const gpu::RenderConfig &config : configs) {
        const gpu::Result device = renderOnDevice(scene, packed, config);
        EXPECT_EQ(differingPixels(device.film, wanted.film), 0u)
            << rowOf(view).name << ", " << gpu::kernelName(config) << ", in flight "
            << config.samplesInFlight;
        EXPECT_EQ(device.rays, wanted.rays);
    }
}

TEST(NumberTwins, AgreeInEachView) {
    std::size_t turn = 0;
    for (const IntegratorRow &row : integratorTable)
        if (row.isOfNumbers())
            expectTwins(things(), row.integrator, testing::kernelsInTurn(turn++));
    EXPECT_EQ(turn, 6u);
}

// Samples go into a tally in their order, however they are spread over lanes, tiles and dispatches.
TEST(NumberTwins, AgreeHoweverTheWorkIsCut) {
    std::vector<gpu::RenderConfig> configs;
    for (const int inFlight : {1, 2, 4, 8})
        configs.push_back({.tileWidth = 16,
                           .tileHeight = 8,
                           .steps = inFlight == 4 ? 60u : 0u,
                           .samplesInFlight = inFlight,
                           .kernel = gpu::findKernel("skip-list-x2")});
    expectTwins(things(), Integrator::ObjectMatte, configs);
}

TEST(NumberTwins, GoOnFromAFilmThatIsNotFinished) {
    TestScene scene = things();
    scene.settings.integrator = Integrator::ObjectMatte;
    const PackedScene packed = pack(scene);
    const Film whole = renderOnCpu(scene, packed).film;
    RenderSettings few = scene.settings;
    few.samplesPerPixel = 9;
    const Film begun = reference::render(packed, few, whole.crop).film;
    EXPECT_EQ(differingPixels(reference::render(packed, scene.settings, begun).film, whole), 0u);
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(1))
        EXPECT_EQ(
            differingPixels(testing::rendererBy(config).render(packed, scene.settings, begun).film, whole),
            0u);
}

TEST(Tallies, HaveMoreThingsThanPixelsKeepApart) {
    TestScene scene = things();
    scene.settings.integrator = Integrator::ObjectMatte;
    std::size_t fullPixels = 0;
    const Film film = renderOnCpu(scene).film;
    for (const layout::FilmPixel &pixel : film.pixels)
        fullPixels += tallyOf(pixel).othersCount > 0;
    EXPECT_GT(fullPixels, 0u) << "the scene of these tests has them";
}

/// The share of the samples that show any of these things, by the view of albedos.
Film aloneInWhite(TestScene scene, const std::function<bool(const std::string &)> &isWhite) {
    const std::size_t blackCount = scene.materials.size();
    for (Material &material : scene.materials) {
        material.kind = MaterialKind::Diffuse;
        material.albedo = glm::vec3(0.0f);
    }
    for (std::size_t i = 0; i < blackCount; ++i) {
        scene.materials.push_back(scene.materials[i]);
        scene.materials.back().albedo = glm::vec3(1.0f);
    }
    const auto paint = [&](std::uint32_t &material, const std::string &name) {
        material += isWhite(name) ? static_cast<std::uint32_t>(blackCount) : 0u;
    };
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        paint(scene.spheres[i].materialIndex, "sphere " + std::to_string(i));
    for (TriangleMesh &mesh : scene.meshes)
        paint(mesh.materialIndex, scene.nodes[mesh.node].name);
    scene.settings.integrator = Integrator::Albedo;
    return renderOnCpu(scene).film;
}

// What is white among black things has the mean that is the share of its matte.
TEST(Mattes, ArePicturesOfTheirObjectsAlone) {
    TestScene scene = things();
    arrangeInstances(scene, Flattening::All); // of one mesh, instances have one material
    scene.settings.integrator = Integrator::ObjectMatte;
    const PackedScene packed = pack(scene);
    const std::vector<std::string> names = packed.namesOf(Integrator::ObjectMatte);
    const Film film = renderOnCpu(scene, packed).film;
    for (std::uint32_t number = 1; number <= names.size(); ++number) {
        const std::string &name = names[number - 1];
        const Film alone = aloneInWhite(scene, [&](const std::string &other) { return other == name; });
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const Tally tally = tallyOf(film.pixels[i]);
            std::uint32_t count = 0;
            for (const NumberCount &entry : tally.numbers)
                count = entry.number == number ? entry.count : count;
            const auto wanted = static_cast<double>(alone.pixels[i].sum.x);
            if (count > 0 || tally.othersCount == 0) {
                ASSERT_NEAR(count, wanted, 1e-4) << name << ", pixel " << i; // interpolated colours round
            }
            seen += count;
        }
        if (!name.starts_with("crumb")) { // some of these find no sample, or no room
            EXPECT_GT(seen, 0u) << name << " is not in the picture";
        }
    }
    const Film all = aloneInWhite(scene, [](const std::string &) { return true; });
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const Tally tally = tallyOf(film.pixels[i]);
        std::uint32_t count = tally.othersCount;
        for (const NumberCount &entry : tally.numbers)
            count += entry.count;
        ASSERT_NEAR(count, static_cast<double>(all.pixels[i].sum.x), 1e-4) << i;
    }
}

// A flattened scene has the numbers of its instances.
TEST(Numbers, OfInstancesAreThoseOfTheirCopies) {
    TestScene scene = things();
    TestScene flattened = scene;
    arrangeInstances(flattened, Flattening::All);
    for (const Integrator view : {Integrator::PlaceNumber, Integrator::ObjectMatte}) {
        scene.settings.integrator = flattened.settings.integrator = view;
        EXPECT_EQ(differingPixels(renderOnCpu(scene).film, renderOnCpu(flattened).film), 0u);
    }
}

TEST(Numbers, AreWholeAndHaveNames) {
    TestScene scene = things();
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    for (const Integrator view :
         {Integrator::ObjectNumber, Integrator::MaterialNumber, Integrator::PlaceNumber}) {
        scene.settings.integrator = view;
        const PackedScene packed = pack(scene);
        const std::size_t count = packed.namesOf(view).size();
        std::map<float, std::size_t> numbers;
        for (const layout::FilmPixel &pixel : renderOnCpu(scene, packed).film.pixels)
            ++numbers[meanOf(pixel).x];
        EXPECT_GT(numbers[0.0f], 0u) << "where there is nothing";
        EXPECT_GT(numbers.size(), 4u);
        for (const auto &[number, pixels] : numbers) {
            EXPECT_EQ(number, std::floor(number));
            EXPECT_LE(number, static_cast<float>(count));
        }
    }
}

} // namespace
} // namespace hyalite::core
