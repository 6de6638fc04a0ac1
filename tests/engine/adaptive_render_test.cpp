// Renders until a noise is reached: any renderers, parts, pauses and orders of wishes make the same film.
#include "host/engine/open_backends.h"
#include "host/engine/render_stages.h"
#include "host/engine/shared_backend.h"
#include "host/film/first_samples.h"
#include "host/film/noise.h"
#include "host/film/partition.h"
#include "host/report/render_report.h"
#include "tests/fixtures/film_copies.h"
#include "tests/fixtures/test_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

constexpr int width = 56; // two blocks, of which one is cut
constexpr int height = 40;

PreparedScene prepareNoisy(double noise, int maxSamples, const std::string &name = "cornell") {
    SceneOptions options;
    options.scene = name;
    options.width = width;
    options.height = height;
    options.settings.push_back({[=](RenderSettings &settings) {
        settings.noise = noise;
        settings.samplesPerPixel = maxSamples;
    }});
    return prepareScene(options, Source::Dropped, nobody());
}

Film renderedBy(Backend &backend, const PreparedScene &scene, Film begun) {
    return render(backend, scene.packed, scene.loaded.settings, std::move(begun), nobody(), {.name = "test"})
        .film;
}

Film renderedBy(Backend &backend, const PreparedScene &scene) {
    return renderedBy(backend, scene, Film(scene.crop));
}

FinishedWork workIn(const Film &film, const PreparedScene &scene) {
    return finishedWork(film, std::span(&film.crop, 1), scene.loaded.settings);
}

TEST(AdaptiveRender, ReachesItsNoiseWithFewSamplesWhereFewAreNeeded) {
    const PreparedScene scene = prepareNoisy(0.06, 1024);
    const Film film = renderedBy(*openBackend("cpu", nobody()), scene);
    const FinishedWork work = workIn(film, scene);
    ASSERT_TRUE(work.noise);
    EXPECT_TRUE(work.isComplete);
    EXPECT_EQ(work.noise->atTarget, work.noise->blockCount);
    EXPECT_LE(work.noise->highest, 0.06);
    EXPECT_GE(work.mostSamples, 2 * work.fewestSamples);
    EXPECT_TRUE(hasFirst(film));
}

// The counts of the film say which samples each pixel has.
TEST(AdaptiveRender, HasThePixelsOfARenderOfAsManySamples) {
    const PreparedScene scene = prepareNoisy(0.08, 1024);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const Film film = renderedBy(*cpu, scene);
    for (const std::uint32_t count : {16u, 24u, 48u, 64u}) {
        const Film whole = renderedBy(*cpu, prepareNoisy(0.0, static_cast<int>(count)));
        for (std::size_t i = 0; i < film.pixels.size(); ++i)
            if (film.pixels[i].sampleCount == count) {
                ASSERT_EQ(film.pixels[i].sum, whole.pixels[i].sum) << i;
                ASSERT_EQ(film.pixels[i].sumOfSquares, whole.pixels[i].sumOfSquares) << i;
            }
    }
}

TEST(AdaptiveRender, IsTheSameByAnyRenderers) {
    const PreparedScene scene = prepareNoisy(0.08, 64, "caustics");
    const auto device = [] { return openBackend(std::to_string(testDevice().index), nobody()); };
    const Film film = renderedBy(*openBackend("cpu", nobody()), scene);
    EXPECT_EQ(differingPixelCount(renderedBy(*device(), scene), film), 0u);
    std::vector<std::unique_ptr<Backend>> members;
    members.push_back(openBackend("cpu", nobody()));
    members.push_back(device());
    EXPECT_EQ(differingPixelCount(renderedBy(*shareBackends(std::move(members)), scene), film), 0u);
}

TEST(AdaptiveRender, GoesOnFromAnyCopyToTheSameBits) {
    const PreparedScene scene = prepareNoisy(0.08, 96);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    FilmCopies copies(2003);
    const BackendResult whole =
        renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop), {.snapshots = &copies});
    EXPECT_GT(copies.films.size(), 10u);
    for (std::size_t i = 0; i < copies.films.size(); i += 3) {
        const BackendResult rest =
            renderInStages(*cpu, scene.packed, scene.loaded.settings, copies.films[i], {});
        EXPECT_EQ(differingPixelCount(rest.film, whole.film), 0u) << i;
        EXPECT_EQ(copies.counts[i] + rest.rays, whole.rays) << i;
    }
}

TEST(AdaptiveRender, GoesOnToLessNoiseOrMoreSamplesAsIfAskedAtOnce) {
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const PreparedScene scene = prepareNoisy(0.05, 200);
    const Film whole = renderedBy(*cpu, scene);
    Film film = renderedBy(*cpu, prepareNoisy(0.4, 30)); // the limit is between two counts
    film = renderedBy(*cpu, prepareNoisy(0.1, 30), std::move(film));
    film = renderedBy(*cpu, prepareNoisy(0.1, 64), std::move(film));
    EXPECT_GT(differingPixelCount(film, whole), 0u);
    EXPECT_EQ(differingPixelCount(renderedBy(*cpu, scene, std::move(film)), whole), 0u);
}

TEST(AdaptiveRender, StopsAtTheLimit) {
    const PreparedScene scene = prepareNoisy(0.001, 40);
    const Film film = renderedBy(*openBackend("cpu", nobody()), scene);
    const FinishedWork work = workIn(film, scene);
    EXPECT_TRUE(work.isComplete);
    EXPECT_EQ(work.noise->atLimit, work.noise->blockCount);
    EXPECT_EQ(work.mostSamples, 40u);
}

TEST(AdaptiveRender, OfPartsIsThatOfTheWhole) {
    const PreparedScene scene = prepareNoisy(0.08, 64);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const Film whole = renderedBy(*cpu, scene);
    const Partition partition(scene.crop, 3, smallestSquare(0.08));
    Film merged(scene.crop);
    for (std::uint32_t part = 1; part <= 3; ++part) {
        const std::span<const Crop> squares = partition.squaresOf(part);
        const Film film = renderedBy(*cpu, scene, filmOfSquares(scene.crop, squares, 64));
        EXPECT_TRUE(finishedWork(film, squares, scene.loaded.settings).isComplete);
        setRecordsIn(merged, squares, recordsIn(film, squares));
    }
    EXPECT_EQ(differingPixelCount(merged, whole), 0u);
}

TEST(AdaptiveRender, TellsProgressAndNoise) {
    struct Watch : Observer {
        void progress(double share) override {
            EXPECT_LE(share, 1.0);
            EXPECT_GE(share, last);
            last = share;
        }
        void noise(double reached, double wanted) override {
            EXPECT_EQ(wanted, 0.08);
            noises.push_back(reached);
        }
        double last = 0.0;
        std::vector<double> noises;
    } watch;
    const PreparedScene scene = prepareNoisy(0.08, 256);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    static_cast<void>(
        render(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop), watch, {.name = "test"}));
    EXPECT_EQ(watch.last, 1.0);
    ASSERT_GE(watch.noises.size(), 2u);
    EXPECT_GT(watch.noises.front(), 0.08);
    EXPECT_LE(watch.noises.back(), 0.08);
}

TEST(AdaptiveRender, ThatIsStoppedKeepsWhatIsThere) {
    const PreparedScene scene = prepareNoisy(0.03, 256);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    std::atomic<int> asked = 0;
    const BackendResult stopped = renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop),
                                                 {.shouldStop = [&] { return ++asked > 60000; }});
    const FinishedWork work = workIn(stopped.film, scene);
    EXPECT_FALSE(work.isComplete);
    EXPECT_GT(work.sampleCount, 0u);
    const Film whole = renderedBy(*cpu, scene);
    EXPECT_EQ(differingPixelCount(renderedBy(*cpu, scene, stopped.film), whole), 0u);
}

TEST(AdaptiveRender, OfASceneWithoutLightHasTheFirstRoundOnly) {
    const PreparedScene scene = [] {
        SceneOptions options;
        options.scene = "cornell";
        options.width = width;
        options.height = height;
        options.cameraPosition = {278, 273, -5000}; // looks away
        options.lookAt = {278, 273, -6000};
        options.settings.push_back({[](RenderSettings &settings) {
            settings.noise = 0.01;
            settings.samplesPerPixel = 256;
        }});
        return prepareScene(options, Source::Dropped, nobody());
    }();
    const FinishedWork work = workIn(renderedBy(*openBackend("cpu", nobody()), scene), scene);
    EXPECT_TRUE(work.isComplete);
    EXPECT_EQ(work.mostSamples, 16u);
}

} // namespace
} // namespace hyalite::core::testing
