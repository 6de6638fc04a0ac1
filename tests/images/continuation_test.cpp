// A film that is not finished goes on anywhere, to the same bits and the same counts.
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <vector>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::pack;
using testing::shippedScene;

struct Part {
    Film film;
    RayCounts rays;
};

/// Keeps every `stride`-th copy that there could be.
class Collector : public SnapshotTaker {
  public:
    explicit Collector(int stride = 1) : stride_(stride) {}
    [[nodiscard]] bool isWanted() const noexcept override { return parts.size() < maxParts; }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) override {
        if (count_++ % stride_ != 0)
            return;
        parts.push_back({Film(Crop{}), rays});
        copyTo(parts.back().film);
    }

    std::vector<Part> parts;

  private:
    static constexpr std::size_t maxParts = 12;
    int stride_;
    int count_ = 0;
};

struct Continuations : ::testing::Test {
    TestScene scene = shippedScene("spheres", 40, 24, 20);
    PackedScene packed = pack(scene);
    Crop crop{0, 40, 0, 24};

    [[nodiscard]] reference::Result onCpu(Film begun, int threadCount = 2,
                                          SnapshotTaker *snapshots = nullptr) const {
        return reference::render(packed, scene.settings, std::move(begun), {.threadCount = threadCount},
                                 {.snapshots = snapshots});
    }
    [[nodiscard]] gpu::Result onDevice(Film begun, const gpu::RenderConfig &config = {},
                                       SnapshotTaker *snapshots = nullptr) const {
        return testing::rendererBy(config).render(packed, scene.settings, std::move(begun),
                                                  {.snapshots = snapshots});
    }
    template <class Result>
    static void expectWhole(const Part &part, const Result &rest, const reference::Result &whole) {
        EXPECT_EQ(differingPixels(rest.film, whole.film), 0u);
        EXPECT_EQ(part.rays + rest.rays, whole.rays);
    }
};

std::uint64_t sampleCount(const Film &film) {
    std::uint64_t count = 0;
    for (const layout::FilmPixel &pixel : film.pixels)
        count += pixel.sampleCount;
    return count;
}

TEST_F(Continuations, OfTheReferenceGoOnAnywhere) {
    const reference::Result whole = onCpu(crop);
    Collector collector;
    EXPECT_EQ(differingPixels(onCpu(crop, 2, &collector).film, whole.film), 0u) << "a copy changes nothing";
    ASSERT_EQ(collector.parts.size(), 12u);
    EXPECT_LT(sampleCount(collector.parts[0].film), 40u * 24u) << "it is asked for early";
    for (std::size_t i = 0; i < collector.parts.size(); i += 5) {
        const Part &part = collector.parts[i];
        expectWhole(part, onCpu(part.film, 1), whole);
        expectWhole(part, onDevice(part.film), whole);
        expectWhole(part, onDevice(part.film, {.tileWidth = 16, .tileHeight = 8, .samplesInFlight = 4}),
                    whole);
    }
}

// With a budget of a few steps nearly all copies are taken in the middle of samples.
TEST_F(Continuations, OfADeviceGoOnAnywhere) {
    const reference::Result whole = onCpu(crop);
    for (const char *kernel : {"skip-list", "stack"})
        for (const std::uint32_t steps : {0u, 9u}) {
            Collector collector(steps == 0 ? 1 : 5);
            const gpu::RenderConfig config{
                .tileWidth = 16, .tileHeight = 16, .steps = steps, .kernel = gpu::findKernel(kernel)};
            EXPECT_EQ(differingPixels(onDevice(crop, config, &collector).film, whole.film), 0u);
            ASSERT_GE(collector.parts.size(), 5u);
            for (std::size_t i = 0; i < collector.parts.size(); i += 4) {
                const Part &part = collector.parts[i];
                EXPECT_LT(sampleCount(part.film), 40u * 24u * 20u) << i;
                expectWhole(part, onCpu(part.film), whole);
                expectWhole(part, onDevice(part.film, {.tileWidth = 32, .tileHeight = 8}), whole);
            }
        }
}

TEST_F(Continuations, OfABandedFilmHaveAllBands) {
    const reference::Result whole = onCpu(crop);
    gpu::DeviceInfo device = testing::testDevice();
    device.maxStorageBufferBytes = 32 * 1024;
    gpu::Renderer renderer(device, {.tileWidth = 8, .tileHeight = 8, .samplesInFlight = 1});
    Collector collector(3);
    const auto render = [&](Film begun, SnapshotTaker *snapshots = nullptr) {
        return renderer.render(packed, scene.settings, std::move(begun), {.snapshots = snapshots});
    };
    EXPECT_EQ(differingPixels(render(crop, &collector).film, whole.film), 0u);
    ASSERT_GE(collector.parts.size(), 4u);
    for (std::size_t i = 0; i < collector.parts.size(); i += 3)
        expectWhole(collector.parts[i], render(collector.parts[i].film), whole);
}

TEST_F(Continuations, MayAddSamplesToWhatWasFinished) {
    const reference::Result whole = onCpu(crop);
    scene.settings.samplesPerPixel = 7;
    const reference::Result seven = onCpu(crop);
    scene.settings.samplesPerPixel = 20;
    expectWhole({seven.film, seven.rays}, onCpu(seven.film), whole);
    expectWhole({seven.film, seven.rays}, onDevice(seven.film), whole);
    EXPECT_EQ(onDevice(whole.film).rays.total(), 0u) << "nothing is left to do";
    EXPECT_EQ(onCpu(whole.film).rays.total(), 0u);
}

TEST_F(Continuations, OfTheOracleAreTakenBetweenPixels) {
    reference::Options options;
    options.precision = reference::Precision::Float64;
    const reference::Result whole = reference::render(packed, scene.settings, crop, options);
    Collector collector;
    EXPECT_EQ(differingPixels(
                  reference::render(packed, scene.settings, crop, options, {.snapshots = &collector}).film,
                  whole.film),
              0u);
    ASSERT_FALSE(collector.parts.empty());
    for (const Part &part : collector.parts)
        for (const layout::FilmPixel &pixel : part.film.pixels)
            EXPECT_TRUE(pixel.sampleCount == 0 || pixel.sampleCount == 20) << pixel.sampleCount;
}

} // namespace
} // namespace hyalite::core
