// Renders in two stages: the pixels are those of one stage, and each has the mean of its first samples.
#include "host/engine/open_backends.h"
#include "host/engine/render_stages.h"
#include "host/engine/shared_backend.h"
#include "host/film/first_samples.h"
#include "host/film/partition.h"
#include "tests/fixtures/film_copies.h"
#include "tests/fixtures/test_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

constexpr int side = 24;

PreparedScene prepareDenoised(int samplesPerPixel) {
    SceneOptions options;
    options.scene = "cornell";
    options.width = options.height = side;
    options.settings.push_back({[=](RenderSettings &settings) {
        settings.samplesPerPixel = samplesPerPixel;
        settings.hasDenoisingData = true;
    }});
    return prepareScene(options, Source::Dropped, nobody());
}

std::vector<std::unique_ptr<Backend>> backendsOfAllKinds() {
    const auto device = [] { return openBackend(std::to_string(testDevice().index), nobody()); };
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(openBackend("cpu", nobody()));
    backends.push_back(device());
    std::vector<std::unique_ptr<Backend>> members;
    members.push_back(openBackend("cpu", nobody()));
    members.push_back(device());
    backends.push_back(shareBackends(std::move(members)));
    return backends;
}

Film renderedIn(Backend &backend, const PreparedScene &scene, bool keepsFirst, Film begun) {
    return render(backend, scene.packed, scene.loaded.settings, std::move(begun), nobody(),
                  {.name = "test", .keepsFirst = keepsFirst})
        .film;
}

Film renderedIn(Backend &backend, const PreparedScene &scene, bool keepsFirst) {
    return renderedIn(backend, scene, keepsFirst, Film(scene.crop));
}

/// Pixels that differ, apart from first samples.
std::size_t differingSums(Film a, Film b) {
    a.first.clear();
    b.first.clear();
    return differingPixelCount(a, b);
}

TEST(FirstSamples, AreTheLargestPowerOfTwoBelowAll) {
    EXPECT_EQ(firstSampleCount(1), 0u);
    EXPECT_EQ(firstSampleCount(2), 1u);
    EXPECT_EQ(firstSampleCount(3), 2u);
    EXPECT_EQ(firstSampleCount(16), 8u);
    EXPECT_EQ(firstSampleCount(24), 16u);
    EXPECT_EQ(firstSampleCount(65536), 32768u);
}

TEST(RenderStages, HaveThePixelsOfOneStageAndTheMeansOfTheFirst) {
    const PreparedScene scene = prepareDenoised(6);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const Film whole = renderedIn(*cpu, scene, false);
    const Image first = renderedIn(*cpu, prepareDenoised(4), false).toImage();
    EXPECT_TRUE(whole.first.empty());
    for (const std::unique_ptr<Backend> &backend : backendsOfAllKinds()) {
        const Film film = renderedIn(*backend, scene, true);
        EXPECT_EQ(differingSums(film, whole), 0u) << backend->name();
        ASSERT_TRUE(hasFirst(film)) << backend->name();
        for (std::size_t i = 0; i < film.first.size(); ++i) {
            ASSERT_EQ(film.first[i].sampleCount, 4u);
            ASSERT_EQ(film.first[i].mean, first.pixels()[i]) << backend->name() << ", pixel " << i;
        }
    }
}

TEST(RenderStages, SumWhatTheyTrace) {
    const PreparedScene scene = prepareDenoised(6);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const BackendResult once = cpu->render(scene.packed, scene.loaded.settings, Film(scene.crop));
    const BackendResult twice =
        renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop), {});
    EXPECT_EQ(once.rays, twice.rays);
    EXPECT_GT(twice.timing.renderSeconds, 0.0);
}

TEST(RenderStages, TellProgressOnce) {
    struct Progress : Observer {
        void progress(double share) override {
            EXPECT_LE(share, 1.0);
            EXPECT_GE(share, last - 1e-9);
            last = share;
        }
        double last = 0.0;
    } observer;
    const PreparedScene scene = prepareDenoised(8);
    const Partition partition(scene.crop, 3); // what others render counts for nothing
    const std::span<const Crop> squares = partition.squaresOf(2);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    static_cast<void>(
        render(*cpu, scene.packed, scene.loaded.settings, filmOfSquares(scene.crop, squares, 8), observer,
               {.name = "part", .shareOfOthers = shareOutside(scene.crop, squares), .keepsFirst = true}));
    EXPECT_NEAR(observer.last, 1.0, 1e-9);
}

// Wherever a checkpoint was taken: in the first stage, between the two, or in the second one.
TEST(RenderStages, GoOnFromAnyCopyToTheSameBits) {
    const PreparedScene scene = prepareDenoised(6);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    FilmCopies copies(151);
    const BackendResult whole =
        renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop), {.snapshots = &copies});
    std::size_t inFirst = 0;
    std::size_t inSecond = 0;
    for (std::size_t i = 0; i < copies.films.size(); ++i) {
        const bool isSecond = std::ranges::any_of(copies.films[i].pixels,
                                                  [](const auto &pixel) { return pixel.sampleCount > 4; });
        (isSecond ? inSecond : inFirst) += 1;
        const BackendResult rest =
            renderInStages(*cpu, scene.packed, scene.loaded.settings, copies.films[i], {});
        EXPECT_EQ(differingPixelCount(rest.film, whole.film), 0u) << i;
        EXPECT_EQ(copies.counts[i] + rest.rays, whole.rays) << i;
    }
    EXPECT_GT(inFirst, 0u);
    EXPECT_GT(inSecond, 0u);
}

TEST(RenderStages, GoOnWithMoreSamples) {
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const Film few = renderedIn(*cpu, prepareDenoised(4), true);
    for (const int more : {5, 8, 11}) {
        const PreparedScene scene = prepareDenoised(more);
        EXPECT_EQ(samplesBeyondFirst(few, {&few.crop, 1}, static_cast<std::uint32_t>(more)), 0u);
        EXPECT_EQ(differingPixelCount(renderedIn(*cpu, scene, true, few), renderedIn(*cpu, scene, true)), 0u)
            << more;
    }
}

TEST(RenderStages, WithFewerSamplesLackTheFirst) {
    Film film(Crop{0, 2, 0, 1});
    film.first.resize(2);
    film.pixels[0].sampleCount = 20; // of 64, whose first 32 are not there yet
    EXPECT_FALSE(hasFirst(film));
    const std::span<const Crop> all(&film.crop, 1);
    EXPECT_EQ(samplesBeyondFirst(film, all, 64), 0u);
    EXPECT_EQ(samplesBeyondFirst(film, all, 33), 0u);
    EXPECT_EQ(samplesBeyondFirst(film, all, 32), 20u);
    film.first[0].sampleCount = 16;
    EXPECT_EQ(samplesBeyondFirst(film, all, 32), 0u);
}

TEST(RenderStages, ThatAreStoppedLeavePixelsWithoutFirstSamples) {
    const PreparedScene scene = prepareDenoised(64);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const BackendResult stopped = renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop),
                                                 {.shouldStop = [] { return true; }});
    EXPECT_FALSE(hasFirst(stopped.film));
    ASSERT_EQ(stopped.film.first.size(), stopped.film.pixels.size());
    EXPECT_TRUE(
        std::ranges::none_of(stopped.film.pixels, [](const auto &pixel) { return pixel.sampleCount > 32; }));
}

} // namespace
} // namespace hyalite::core::testing
