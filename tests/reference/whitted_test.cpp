#include "host/reference/whitted.h"

#include "host/reference/renderer.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::addQuad;
using hyalite::core::testing::packed;

constexpr double pi = std::numbers::pi;

/// One pixel that looks from the eye along -z, through its centre.
TestScene onePixel(const glm::dvec3 &eye) {
    TestScene scene;
    scene.camera.position = eye;
    scene.camera.width = 1;
    scene.camera.height = 1;
    scene.camera.horizontalFovDegrees = 1.0;
    scene.settings.samplesPerPixel = 1;
    scene.settings.sampler = SamplerKind::Centre;
    return scene;
}

std::uint32_t addMaterial(TestScene &scene, const Material &material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Material diffuse(const glm::vec3 &albedo, bool isTwoSided = false) {
    Material material;
    material.albedo = albedo;
    material.twoSided = isTwoSided;
    return material;
}
Material mirror() {
    Material material;
    material.kind = MaterialKind::Mirror;
    return material;
}
Material glass(float index, const glm::vec3 &tint = glm::vec3(1.0f)) {
    Material material;
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.segmentTint = tint;
    return material;
}

void addWall(TestScene &scene, std::uint32_t material, const glm::vec3 &corner, const glm::vec3 &a,
             const glm::vec3 &b) {
    scene.meshes.emplace_back();
    scene.meshes.back().materialIndex = material;
    addQuad(scene.meshes.back(), corner, a, b);
}

/// A square of side 20 at the given z that faces +z, its diagonal off the axis.
void addWallFacingUs(TestScene &scene, std::uint32_t material, float z) {
    addWall(scene, material, {-11, -9, z}, {20, 0, 0}, {0, 20, 0});
}

Result renderAll(const TestScene &scene, Precision precision = Precision::Float32, int threadCount = 1) {
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    return render(packed(scene), scene.settings, crop, {.precision = precision, .threadCount = threadCount});
}

/// The only pixel, in both precisions, against the closed form.
void expectPixel(const TestScene &scene, const glm::dvec3 &expected, const RayCounts &rays) {
    for (const Precision precision : {Precision::Float32, Precision::Float64}) {
        const Result result = renderAll(scene, precision);
        const glm::vec3 pixel = result.film.toImage().at(0, 0);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(static_cast<double>(pixel[channel]), expected[channel], 1e-6 * expected[channel])
                << "channel " << channel << (precision == Precision::Float32 ? " in float" : " in double");
        EXPECT_EQ(result.rays.primary, rays.primary);
        EXPECT_EQ(result.rays.shadow, rays.shadow);
        EXPECT_EQ(result.rays.reflection, rays.reflection);
        EXPECT_EQ(result.rays.refraction, rays.refraction);
    }
}

/// Lambert under a point light: albedo/pi * power/(4 pi) * cos / d^2.
glm::dvec3 lambert(const glm::dvec3 &albedo, const glm::dvec3 &power, double cosine, double distance) {
    return albedo / pi * power / (4.0 * pi) * cosine / (distance * distance);
}

TEST(Whitted, ALitSphereHeadOn) {
    TestScene scene = onePixel({0, 0, 5});
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, diffuse({0.8f, 0.4f, 0.2f})), false});
    scene.lights.push_back({{0, 0, 4}, {100, 200, 300}});
    expectPixel(scene, lambert({0.8f, 0.4f, 0.2f}, {100, 200, 300}, 1.0, 3.0), {1, 1, 0, 0});
    // From the side the cosine is that of the light's direction at (0, 0, 1).
    scene.lights[0].position = {2, 0, 3};
    expectPixel(scene, lambert({0.8f, 0.4f, 0.2f}, {100, 200, 300}, std::sqrt(0.5), std::sqrt(8.0)),
                {1, 1, 0, 0});
    // Below the horizon there is no shadow ray at all.
    scene.lights[0].position = {10, 0, 0.5};
    expectPixel(scene, glm::dvec3(0.0), {1, 0, 0, 0});
}

TEST(Whitted, ALitWall) {
    TestScene scene = onePixel({0, 0, 5});
    addWallFacingUs(scene, addMaterial(scene, diffuse(glm::vec3(0.5f))), -2.0f);
    scene.lights.push_back({{3, 0, 2}, glm::dvec3(1000.0)});
    expectPixel(scene, lambert(glm::dvec3(0.5), glm::dvec3(1000.0), 0.8, 5.0), {1, 1, 0, 0});
}

TEST(Whitted, TheBackgroundIsSeenWhereThereIsNothing) {
    TestScene scene = onePixel({0, 0, 5});
    scene.background = {0.25f, 0.5f, 4.0f};
    expectPixel(scene, {0.25, 0.5, 4.0}, {1, 0, 0, 0});
}

TEST(Whitted, SeveralLightsAddUp) {
    TestScene scene = onePixel({0, 0, 5});
    addWallFacingUs(scene, addMaterial(scene, diffuse({0.5f, 0.25f, 1.0f})), 0.0f);
    glm::dvec3 expected(0.0);
    for (int i = 0; i < 16; ++i) {
        const glm::dvec3 position(0.3 * i, 1.0, 2.0 + i);
        const glm::dvec3 power(10.0 * i, 5.0, 100.0 - i);
        scene.lights.push_back({position, power});
        const double distance = glm::length(position);
        expected += lambert({0.5, 0.25, 1.0}, power, position.z / distance, distance);
    }
    expectPixel(scene, expected, {1, 16, 0, 0});
}

TEST(Whitted, AnOpaqueThingBetweenBlocksTheLight) {
    for (const bool isSphere : {true, false}) {
        for (const bool isMirror : {true, false}) {
            TestScene scene = onePixel({0, 0, 5});
            addWallFacingUs(scene, addMaterial(scene, diffuse(glm::vec3(0.5f))), 0.0f);
            scene.lights.push_back({{4, 0, 4}, glm::dvec3(1000.0)});
            const std::uint32_t blocker = addMaterial(scene, isMirror ? mirror() : diffuse(glm::vec3(0.5f)));
            if (isSphere)
                scene.spheres.push_back({{2, 0, 2}, 0.5, blocker, false});
            else
                addWall(scene, blocker, {1.5f, -0.4f, 2}, {1, 0, 0}, {0, 1, 0});
            expectPixel(scene, glm::dvec3(0.0), {1, 1, 0, 0});
            // Behind the light it blocks nothing.
            scene.lights[0].position = {1, 0, 1};
            expectPixel(scene, lambert(glm::dvec3(0.5), glm::dvec3(1000.0), std::sqrt(0.5), std::sqrt(2.0)),
                        {1, 1, 0, 0});
        }
    }
}

TEST(Whitted, GlassBetweenDimsTheLightOnce) {
    for (const int sphereCount : {1, 2, 5}) {
        TestScene scene = onePixel({0, 0, 5});
        scene.shadowThroughGlass = 0.25f;
        addWallFacingUs(scene, addMaterial(scene, diffuse(glm::vec3(0.5f))), 0.0f);
        scene.lights.push_back({{8, 0, 8}, glm::dvec3(1000.0)});
        const std::uint32_t clear = addMaterial(scene, glass(1.5f));
        for (int i = 0; i < sphereCount; ++i)
            scene.spheres.push_back({glm::dvec3(1.5 + i, 0, 1.5 + i), 0.4, clear, i % 2 == 1});
        addWall(scene, clear, {6.5f, -0.4f, 7}, {1, 0, 0}, {0, 1, 0}); // and a pane
        const glm::dvec3 unshadowed =
            lambert(glm::dvec3(0.5), glm::dvec3(1000.0), std::sqrt(0.5), std::sqrt(128.0));
        expectPixel(scene, 0.25 * unshadowed, {1, 1, 0, 0});
        // Glass and something opaque: nothing gets through.
        scene.spheres.push_back({{7.5, 0, 7.5}, 0.3, 0, false});
        expectPixel(scene, glm::dvec3(0.0), {1, 1, 0, 0});
    }
}

TEST(Whitted, AMirrorShowsTheWallBehindUs) {
    for (const bool isSphere : {true, false}) {
        TestScene scene = onePixel({0, 0, 0});
        const std::uint32_t silver = addMaterial(scene, mirror());
        const std::uint32_t wall = addMaterial(scene, diffuse({0.5f, 0.25f, 0.125f}));
        if (isSphere)
            scene.spheres.push_back({{0, 0, -4}, 2.0, silver, false});
        else
            addWallFacingUs(scene, silver, -2.0f);
        addWall(scene, wall, {-9, -11, 3}, {0, 20, 0}, {20, 0, 0}); // faces -z
        scene.lights.push_back({{0, 3, -1}, glm::dvec3(1000.0)});
        expectPixel(scene, lambert({0.5, 0.25, 0.125}, glm::dvec3(1000.0), 0.8, 5.0), {1, 1, 1, 0});
        // The wall is lit from its front only.
        scene.lights[0].position = {0, 3, 7};
        expectPixel(scene, glm::dvec3(0.0), {1, 0, 1, 0});
        // With a single segment there is no reflection.
        scene.settings.maxDepth = 1;
        expectPixel(scene, glm::dvec3(0.0), {1, 0, 0, 0});
    }
}

TEST(Whitted, DepthCountsSegmentsBetweenTwoMirrors) {
    TestScene scene = onePixel({0, 0, 0});
    scene.background = glm::vec3(1.0f);
    const std::uint32_t silver = addMaterial(scene, mirror());
    addWallFacingUs(scene, silver, -2.0f);
    addWall(scene, silver, {-9, -11, 3}, {0, 20, 0}, {20, 0, 0});
    for (const int depth : {1, 2, 3, 7, 32}) {
        scene.settings.maxDepth = depth;
        expectPixel(scene, glm::dvec3(0.0), {1, 0, static_cast<std::uint64_t>(depth - 1), 0});
    }
}

/// A glass ball head-on in a white surrounding: at each surface the share R is reflected, and a segment inside keeps
/// the share T. With D segments: R + (1-R)^2 T (1 + RT + (RT)^2 + ...) with D - 2 terms.
double headOnBall(double index, double tint, int depth) {
    const double r = std::pow((index - 1.0) / (index + 1.0), 2.0);
    double sum = depth >= 2 ? r : 0.0;
    double term = (1.0 - r) * (1.0 - r) * tint;
    for (int i = 0; i < depth - 2; ++i) {
        sum += term;
        term *= r * tint;
    }
    return sum;
}

TEST(Whitted, AGlassBallHeadOnAtEveryDepth) {
    for (const float index : {1.0f, 1.5f, 2.4f}) {
        for (int depth = 1; depth <= 12; ++depth) {
            SCOPED_TRACE(fmt::format("index {}, depth {}", index, depth));
            TestScene scene = onePixel({0, 0, 5});
            scene.background = glm::vec3(1.0f);
            scene.settings.maxDepth = depth;
            scene.spheres.push_back(
                {{0, 0, 0}, 1.0, addMaterial(scene, glass(index, {1.0f, 0.5f, 0.25f})), false});
            const double n = static_cast<double>(index);
            // Two segments leave each surface as long as the depth allows.
            const auto splits = static_cast<std::uint64_t>(std::max(depth - 1, 0));
            expectPixel(scene,
                        {headOnBall(n, 1.0, depth), headOnBall(n, 0.5, depth), headOnBall(n, 0.25, depth)},
                        {1, 0, splits, splits});
        }
    }
}

TEST(Whitted, AWhiteFurnaceOfGlassIsWhite) {
    // All that is reflected and refracted adds up to what came in: 1, less what is still inside at the last segment.
    for (const bool isMesh : {false, true}) {
        TestScene scene;
        scene.camera.position = {0, 0, 5};
        scene.camera.width = 33;
        scene.camera.height = 33;
        scene.camera.horizontalFovDegrees = 22.0; // all of the ball, which is seen under 23
        scene.background = glm::vec3(1.0f);
        scene.settings.samplesPerPixel = 1;
        const std::uint32_t clear = addMaterial(scene, glass(1.5f));
        if (isMesh) {
            scene.meshes.push_back(hyalite::core::testing::icosphere(2));
            scene.meshes[0].materialIndex = clear;
        } else {
            scene.spheres.push_back({{0, 0, 0}, 1.0, clear, false});
        }
        double last = 0.0;
        double smallest = 0.0;
        for (const int depth : {2, 3, 4, 6, 9, 14, 32}) {
            scene.settings.maxDepth = depth;
            for (const Precision precision : {Precision::Float32, Precision::Float64}) {
                const Image image = renderAll(scene, precision).film.toImage();
                double sum = 0.0;
                double least = 1.0;
                for (const glm::vec3 &pixel : image.pixels()) {
                    EXPECT_LE(pixel.x, 1.0f + 2e-6f);
                    EXPECT_EQ(pixel.x, pixel.y);
                    EXPECT_EQ(pixel.x, pixel.z);
                    sum += static_cast<double>(pixel.x);
                    least = std::min(least, static_cast<double>(pixel.x));
                }
                smallest = least;
                const double mean = sum / static_cast<double>(image.pixels().size());
                EXPECT_GE(mean, last - 1e-6) << "more segments, more light: depth " << depth;
                last = mean;
                if (depth == 32 && !isMesh) {
                    EXPECT_GT(least, 0.99);
                    EXPECT_GT(mean, 0.9999);
                }
                if (depth == 32 && isMesh) {
                    EXPECT_GT(mean, 0.98) << "total reflection keeps some light inside of a polyhedron";
                }
            }
        }
        fmt::print("    mean of the furnace with a {} at depth 32: {:.7f}, least {:.7f}\n",
                   isMesh ? "mesh" : "sphere", last, smallest);
    }
}

TEST(Whitted, TheBackgroundThroughAPaneAndAWallBehindGlass) {
    // A ball of glass between the eye and a lit wall, tinted by half for each segment inside. The light is in front
    // of the ball and off the axis, so that nothing casts a shadow on what is seen.
    TestScene scene = onePixel({0, 0, 5});
    scene.settings.maxDepth = 3; // straight through, and nothing else that could see anything
    const double r = 0.04;
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f, glm::vec3(0.5f))), false});
    addWallFacingUs(scene, addMaterial(scene, diffuse(glm::vec3(0.75f))), -4.0f);
    scene.lights.push_back({{4, 0, -1}, glm::dvec3(1000.0)});
    const glm::dvec3 wall = lambert(glm::dvec3(0.75), glm::dvec3(1000.0), 0.6, 5.0);
    // Primary ray, a split at each of the two surfaces; the wall at the third segment is lit.
    expectPixel(scene, wall * ((1.0 - r) * (1.0 - r) * 0.5), {1, 1, 2, 2});
}

TEST(Whitted, TintCountsForEachSegmentInside) {
    // Along the axis of a ball: segment inside, total tint T once, T^3 for the light that was reflected twice inside.
    TestScene scene = onePixel({0, 0, 5});
    scene.background = glm::vec3(1.0f);
    scene.settings.maxDepth = 12;
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f, {0.95f, 0.9f, 0.0f})), false});
    const glm::vec3 pixel = renderAll(scene).film.toImage().at(0, 0);
    EXPECT_NEAR(pixel.x, headOnBall(1.5, 0.95, 12), 1e-6);
    EXPECT_NEAR(pixel.y, headOnBall(1.5, 0.9, 12), 1e-6);
    EXPECT_NEAR(pixel.z, 0.04, 1e-6) << "opaque glass leaves the first reflection";
}

TEST(Whitted, ARayThatEndsInGlassIsTinted) {
    // A pane with nothing behind it: the segment beyond it never leaves the glass and carries the tint.
    TestScene scene = onePixel({0, 0, 5});
    scene.background = glm::vec3(1.0f);
    addWallFacingUs(scene, addMaterial(scene, glass(1.5f, glm::vec3(0.5f))), 0.0f);
    expectPixel(scene, glm::dvec3(0.04 + 0.96 * 0.5), {1, 0, 1, 1});
}

TEST(Whitted, TheEyeMayBeInsideOfGlass) {
    // Outside of the glass is where the camera is thought to be until a surface says otherwise.
    TestScene scene = onePixel({0, 0, 0});
    scene.background = glm::vec3(1.0f);
    scene.settings.maxDepth = 2;
    scene.spheres.push_back({{0, 0, 0}, 1.0, addMaterial(scene, glass(1.5f, glm::vec3(0.5f))), false});
    // The first segment ends at the inner side of the surface: tinted, 0.96 of it leaves, the rest is cut off.
    expectPixel(scene, glm::dvec3(0.5 * 0.96), {1, 0, 1, 1});
}

TEST(Whitted, TwoSidedSurfacesAreLitFromTheViewersSide) {
    for (const bool isTwoSided : {false, true}) {
        TestScene scene = onePixel({0, 0, 5});
        const std::uint32_t paper = addMaterial(scene, diffuse(glm::vec3(0.5f), isTwoSided));
        addWall(scene, paper, {-9, -11, 0}, {0, 20, 0}, {20, 0, 0}); // faces -z, away from us
        scene.lights.push_back({{3, 0, 4}, glm::dvec3(1000.0)});
        const glm::dvec3 lit = lambert(glm::dvec3(0.5), glm::dvec3(1000.0), 0.8, 5.0);
        expectPixel(scene, isTwoSided ? lit : glm::dvec3(0.0), {1, isTwoSided ? 1u : 0u, 0, 0});
        // A light on the far side shines on what the normal faces: seen from here only on one-sided surfaces.
        scene.lights[0].position.z = -4;
        expectPixel(scene, isTwoSided ? glm::dvec3(0.0) : lit, {1, isTwoSided ? 0u : 1u, 0, 0});
    }
}

/// A bit of everything, small enough to render often.
TestScene busyScene() {
    TestScene scene;
    scene.camera.position = {0, 0, 6};
    scene.camera.width = 37;
    scene.camera.height = 23;
    scene.background = {0.1f, 0.2f, 0.3f};
    scene.shadowThroughGlass = 0.5f;
    scene.settings.samplesPerPixel = 5;
    scene.settings.seed = 3;
    const std::uint32_t grey = addMaterial(scene, diffuse(glm::vec3(0.6f)));
    const std::uint32_t silver = addMaterial(scene, mirror());
    const std::uint32_t clear = addMaterial(scene, glass(1.5f, {0.95f, 0.95f, 0.98f}));
    scene.spheres.push_back({{-1, 0, 0}, 1.0, clear, false});
    scene.spheres.push_back({{1.2, 0, -1}, 1.0, silver, false});
    scene.meshes.push_back(
        hyalite::core::testing::placed(hyalite::core::testing::icosphere(2), 0.7, {0.3, -0.4, 1.5}));
    scene.meshes[0].materialIndex = clear;
    addWall(scene, grey, {-5, -1.5f, -5}, {0, 0, 10}, {10, 0, 0});
    scene.lights.push_back({{2, 5, 4}, glm::dvec3(300.0)});
    scene.lights.push_back({{-3, 2, 4}, {100.0, 20.0, 20.0}});
    return scene;
}

bool isSameFilm(const Film &a, const Film &b) {
    return std::ranges::equal(a.pixels, b.pixels, [](const layout::FilmPixel &p, const layout::FilmPixel &q) {
        return p.sum == q.sum && p.sumOfSquares == q.sumOfSquares && p.sampleCount == q.sampleCount;
    });
}

TEST(Whitted, ThreadsDoNotChangeABit) {
    const TestScene scene = busyScene();
    for (const Precision precision : {Precision::Float32, Precision::Float64}) {
        const Result alone = renderAll(scene, precision, 1);
        for (const int threadCount : {0, 2, 3, 8}) {
            const Result result = renderAll(scene, precision, threadCount);
            EXPECT_TRUE(isSameFilm(result.film, alone.film)) << threadCount << " threads";
            EXPECT_EQ(result.rays, alone.rays) << threadCount << " threads";
        }
    }
}

TEST(Whitted, TreesDoNotChangeABit) {
    const TestScene scene = busyScene();
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    const Result flat = render(packed(scene, TreeKind::None), scene.settings, crop);
    for (const TreeKind kind : {TreeKind::Midpoint, TreeKind::Sah}) {
        for (const int leafSize : {1, 8, 64}) {
            const Result result = render(packed(scene, kind, leafSize), scene.settings, crop);
            EXPECT_TRUE(isSameFilm(result.film, flat.film));
            EXPECT_EQ(result.rays, flat.rays);
        }
    }
}

TEST(Whitted, DoublePrecisionAgreesUpToRounding) {
    const TestScene scene = busyScene();
    const Image narrow = renderAll(scene, Precision::Float32).film.toImage();
    const Image wide = renderAll(scene, Precision::Float64).film.toImage();
    std::size_t differing = 0;
    for (std::size_t i = 0; i < narrow.pixels().size(); ++i)
        differing += glm::distance(narrow.pixels()[i], wide.pixels()[i]) > 1e-3f ? 1 : 0;
    // A sample on the other side of an edge may change a pixel, but not many.
    EXPECT_LE(differing, narrow.pixels().size() / 50) << "of " << narrow.pixels().size();
}

TEST(Whitted, ACropIsAPieceOfTheWholeImage) {
    const TestScene scene = busyScene();
    const Film whole = renderAll(scene).film;
    const Crop crop{5, 19, 7, 22};
    const Film piece = render(packed(scene), scene.settings, crop).film;
    ASSERT_EQ(piece.pixels.size(), 14u * 15u);
    for (int y = crop.y0; y < crop.y1; ++y) {
        for (int x = crop.x0; x < crop.x1; ++x) {
            const layout::FilmPixel &here =
                piece.pixels[static_cast<std::size_t>((y - crop.y0) * crop.width() + x - crop.x0)];
            const layout::FilmPixel &there =
                whole.pixels[static_cast<std::size_t>(y * scene.camera.width + x)];
            EXPECT_EQ(here.sum, there.sum);
            EXPECT_EQ(here.sumOfSquares, there.sumOfSquares);
        }
    }
}

TEST(Film, KeepsTheSumTheSumOfSquaresAndTheCountOfSamples) {
    TestScene scene = onePixel({0, 0, 5});
    scene.background = {0.25f, 0.5f, 2.0f};
    scene.settings.samplesPerPixel = 100;
    const Result result = renderAll(scene);
    ASSERT_EQ(result.film.pixels.size(), 1u);
    EXPECT_EQ(result.film.pixels[0].sampleCount, 100u);
    EXPECT_EQ(result.film.pixels[0].sum, glm::vec3(25.0f, 50.0f, 200.0f));
    EXPECT_EQ(result.film.pixels[0].sumOfSquares, glm::vec3(6.25f, 25.0f, 400.0f));
    EXPECT_EQ(result.film.toImage().at(0, 0), scene.background);
    EXPECT_EQ(result.rays.primary, 100u);
}

TEST(Film, SumsTheSamplesInTheirOrder) {
    TestScene scene = busyScene();
    const PackedScene data = packed(scene);
    const Film film = renderAll(scene).film;
    WhittedIntegrator<float> integrator(data, scene.settings);
    for (const glm::uvec2 pixel : {glm::uvec2(18, 11), {3, 4}, {36, 22}, {20, 15}}) {
        FilmPixel<float> sums(layout::FilmPixel{});
        for (std::uint32_t sample = 0; sample < 5; ++sample)
            sums = withSample<float>(sums, integrator.sampleRadiance(pixel, sample), 0.0f);
        const layout::FilmPixel &stored = film.pixels[pixel.y * 37u + pixel.x];
        EXPECT_EQ(stored.sum, sums.sum);
        EXPECT_EQ(stored.sumRest, sums.sumRest);
        EXPECT_EQ(stored.sumOfSquares, sums.sumOfSquares);
        EXPECT_EQ(stored.squaresRest, sums.squaresRest);
    }
}

TEST(Film, APixelWithoutSamplesIsBlack) {
    const Film film(Crop{0, 2, 0, 1});
    EXPECT_EQ(film.toImage().at(1, 0), glm::vec3(0.0f));
}

TEST(Whitted, ProgressEndsAtOne) {
    TestScene scene = busyScene();
    double last = 0.0;
    bool isRising = true;
    RenderHooks hooks;
    hooks.onProgress = [&](double share) {
        isRising = isRising && share > last;
        last = share;
    };
    static_cast<void>(render(packed(scene), scene.settings, Crop{0, 37, 0, 23}, {}, hooks));
    EXPECT_TRUE(isRising);
    EXPECT_EQ(last, 1.0);
}

} // namespace
} // namespace hyalite::core::reference
