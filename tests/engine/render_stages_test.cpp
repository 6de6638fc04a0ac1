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
#include <array>
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

TEST(FirstSamples, HaveTheirHalfWhereItIsNearerToTheHalfOfAll) {
    EXPECT_EQ(halfOfFirstCount(1), 0u);
    EXPECT_EQ(halfOfFirstCount(3), 0u);
    EXPECT_EQ(halfOfFirstCount(5), 2u);
    EXPECT_EQ(halfOfFirstCount(6), 0u);
    EXPECT_EQ(halfOfFirstCount(16), 0u);
    EXPECT_EQ(halfOfFirstCount(17), 8u);
    EXPECT_EQ(halfOfFirstCount(23), 8u);
    EXPECT_EQ(halfOfFirstCount(24), 0u);
    for (std::uint32_t all = 2; all < 5000; ++all) {
        const std::uint32_t half = halfOfFirstCount(all) > 0 ? halfOfFirstCount(all) : firstSampleCount(all);
        EXPECT_GE(3 * half, all) << all;
        EXPECT_LE(3 * half, 2 * all) << all;
    }
}

TEST(RenderStages, HaveThePixelsOfOneStageAndTheMeansOfTheFirst) {
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    const Image first = renderedIn(*cpu, prepareDenoised(4), false).toImage();
    const Image half = renderedIn(*cpu, prepareDenoised(2), false).toImage();
    for (const int samples : {5, 6}) {
        const PreparedScene scene = prepareDenoised(samples);
        const Film whole = renderedIn(*cpu, scene, false);
        EXPECT_TRUE(whole.first.empty());
        for (const std::unique_ptr<Backend> &backend : backendsOfAllKinds()) {
            const Film film = renderedIn(*backend, scene, true);
            EXPECT_EQ(differingSums(film, whole), 0u) << backend->name();
            ASSERT_TRUE(hasFirst(film)) << backend->name();
            for (std::size_t i = 0; i < film.first.size(); ++i) {
                ASSERT_TRUE(isComplete(film.first[i], static_cast<std::uint32_t>(samples))) << i;
                ASSERT_EQ(film.first[i].mean, first.pixels()[i]) << backend->name() << ", pixel " << i;
                const bool hasHalf = samples == 5; // 2 are a better half of 5 than 4
                ASSERT_EQ(film.first[i].half.sampleCount, hasHalf ? 2u : 0u);
                ASSERT_EQ(film.first[i].ofDenoiser().mean, (hasHalf ? half : first).pixels()[i]) << i;
            }
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

// Wherever a checkpoint was taken: in a stage or between two of them.
TEST(RenderStages, GoOnFromAnyCopyToTheSameBits) {
    const PreparedScene scene = prepareDenoised(5);
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    FilmCopies copies(151);
    const BackendResult whole =
        renderInStages(*cpu, scene.packed, scene.loaded.settings, Film(scene.crop), {.snapshots = &copies});
    std::array<std::size_t, 3> inStages{};
    for (std::size_t i = 0; i < copies.films.size(); ++i) {
        const std::uint32_t most =
            std::ranges::max(copies.films[i].pixels, {}, &layout::FilmPixel::sampleCount).sampleCount;
        inStages[most > 4 ? 2 : most > 2 ? 1 : 0] += 1;
        const BackendResult rest =
            renderInStages(*cpu, scene.packed, scene.loaded.settings, copies.films[i], {});
        EXPECT_EQ(differingPixelCount(rest.film, whole.film), 0u) << i;
        EXPECT_EQ(copies.counts[i] + rest.rays, whole.rays) << i;
    }
    for (const std::size_t count : inStages)
        EXPECT_GT(count, 0u);
}

TEST(RenderStages, GoOnWithMoreSamples) {
    const std::unique_ptr<Backend> cpu = openBackend("cpu", nobody());
    for (const int samples : {4, 5, 6}) {
        const Film few = renderedIn(*cpu, prepareDenoised(samples), true);
        for (const int more : {5, 7, 8, 9, 11, 12, 17}) {
            if (more < samples)
                continue;
            const PreparedScene scene = prepareDenoised(more);
            EXPECT_EQ(samplesBeyondFirst(few, {&few.crop, 1}, static_cast<std::uint32_t>(more)), 0u);
            EXPECT_EQ(differingPixelCount(renderedIn(*cpu, scene, true, few), renderedIn(*cpu, scene, true)),
                      0u)
                << samples << ", " << more;
        }
    }
}

TEST(RenderStages, WithFewerSamplesLackTheFirst) {
    Film film(Crop{0, 2, 0, 1});
    film.first.resize(2);
    film.pixels[0].sampleCount = 20; // of 64, whose first 32 are not there yet
    EXPECT_FALSE(hasFirst(film));
    const std::span<const Crop> all(&film.crop, 1);
    EXPECT_EQ(samplesBeyondFirst(film, all, 64), 0u);
    EXPECT_EQ(samplesBeyondFirst(film, all, 48), 0u);
    EXPECT_EQ(samplesBeyondFirst(film, all, 32), 20u);
    film.first[0].sampleCount = 16;
    EXPECT_EQ(samplesBeyondFirst(film, all, 32), 0u);
    EXPECT_EQ(samplesBeyondFirst(film, all, 33), 0u);
    film.first[0].sampleCount = 0; // of 33, the first 16 and 32
    EXPECT_EQ(samplesBeyondFirst(film, all, 33), 20u);
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
