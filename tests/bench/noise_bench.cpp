// How long paths take to show little noise. Two renders with different seeds differ by their noise alone: half of the
// mean square of their differences is the variance of a pixel. It falls by the time, so that one pair tells how long it
// takes until the noise is as small as is wanted.
#include "host/base/error.h"
#include "host/bvh/bvh.h"
#include "host/gpu/renderer.h"
#include "host/import/load.h"
#include "host/reference/renderer.h"
#include "tests/bench/embree_paths.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"
#include "tests/fixtures/test_scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>

namespace hyalite::core::bench {

namespace {

constexpr int imageSide = 256; // pixels
constexpr int samplesPerPixel = 64;
constexpr double noiseWanted = 0.05; // standard deviation of a pixel, of the mean of all
constexpr double meansAgree = 0.005; // relative: four standard deviations of the mean of an image, and more

struct Pair {
    double mean = 0.0;     ///< of all pixels and channels
    double variance = 0.0; ///< of a pixel's channel
};

Pair compare(const Image &a, const Image &b) {
    Pair pair;
    const double count = 3.0 * static_cast<double>(a.pixels().size());
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const glm::dvec3 x(a.pixels()[i]);
        const glm::dvec3 y(b.pixels()[i]);
        pair.mean += glm::dot(x + y, glm::dvec3(0.5)) / count;
        pair.variance += 0.5 * glm::dot(x - y, x - y) / count;
    }
    return pair;
}

/// Renders one image and takes the seconds that count.
struct Shot {
    Image image;
    double seconds;
};

class Contestant {
  public:
    explicit Contestant(std::function<Shot(std::uint32_t seed)> render) : render_(std::move(render)) {}

    /// The seconds until the noise is as wanted, by two renders with new seeds.
    double run() {
        const Shot first = render_(seed_++);
        const Shot second = render_(seed_++);
        last_ = compare(first.image, second.image);
        const double wanted = noiseWanted * last_.mean;
        return 0.5 * (first.seconds + second.seconds) * last_.variance / (wanted * wanted);
    }
    [[nodiscard]] double lastMean() const { return last_.mean; }

  private:
    std::function<Shot(std::uint32_t)> render_;
    std::uint32_t seed_ = 1;
    Pair last_;
};

struct CornellBox {
    TestScene scene;
    PackedScene packed;
    Crop crop{0, imageSide, 0, imageSide};

    CornellBox() : scene(loadTestScene("cornell")) {
        scene.camera.width = scene.camera.height = imageSide;
        scene.settings.samplesPerPixel = samplesPerPixel;
        packed = packScene(scene, buildBvh(scene.settings.tree, scene, scene.settings.leafSize));
    }
    const RenderSettings &withSeed(std::uint32_t seed) {
        scene.settings.seed = seed;
        return scene.settings;
    }
};

Contestant onEmbree(std::shared_ptr<CornellBox> box, PathSamples samples) {
    const auto paths = std::make_shared<EmbreePaths>(box->scene);
    return Contestant([box, paths, samples](std::uint32_t seed) {
        Shot shot{Image(0, 0), 0.0};
        shot.seconds = timed([&] { shot.image = paths->render(samplesPerPixel, seed, samples); })();
        return shot;
    });
}

Contestant onDevice(std::shared_ptr<CornellBox> box, const gpu::DeviceInfo &device) {
    const auto renderer = std::make_shared<gpu::Renderer>(device);
    return Contestant([box, renderer](std::uint32_t seed) {
        const RenderSettings &settings = box->withSeed(seed);
        std::optional<gpu::Result> result;
        const double seconds =
            timed([&] { result.emplace(renderer->render(box->packed, settings, box->crop)); })();
        if (result->failure)
            throw Error(*result->failure);
        // Of the processor's seconds those of the dispatches alone are not known.
        return Shot{result->film.toImage(),
                    areProcessorSecondsCounted() ? seconds : result->timing.renderSeconds};
    });
}

Contestant onCpu(std::shared_ptr<CornellBox> box) {
    return Contestant([box](std::uint32_t seed) {
        const RenderSettings &settings = box->withSeed(seed);
        Shot shot{Image(0, 0), 0.0};
        shot.seconds =
            timed([&] { shot.image = reference::render(box->packed, settings, box->crop).film.toImage(); })();
        return shot;
    });
}

void measure(benchmark::State &state, Contestant contestant, Contestant rival) {
    (void)contestant.run();
    (void)rival.run();
    if (std::abs(contestant.lastMean() / rival.lastMean() - 1.0) > meansAgree) {
        state.SkipWithError("the image is not as bright as that of the path tracer on Embree");
        return;
    }
    const Rival rivals[] = {{"of Embree", [&] { return rival.run(); }}};
    race(
        state, [&] { return contestant.run(); }, rivals);
}

} // namespace

void registerNoise(Context &context) {
    const std::string row = "noise/cornell/";
    const auto makeBox = [] { return std::make_shared<CornellBox>(); };
    const auto makeRival = [=] { return onEmbree(makeBox(), PathSamples::Independent); };
    addBenchmark(row + "path tracer on Embree", 3,
                 [=](benchmark::State &state) { measure(state, makeRival(), makeRival()); });
    addBenchmark(row + "the same with our samples", 3, [=](benchmark::State &state) {
        measure(state, onEmbree(makeBox(), PathSamples::Stratified), makeRival());
    });
    addBenchmark(row + "device", 3, [=, &context](benchmark::State &state) {
        measure(state, onDevice(makeBox(), context.device()), makeRival());
    });
    addBenchmark(row + "CPU reference", 2,
                 [=](benchmark::State &state) { measure(state, onCpu(makeBox()), makeRival()); });
}

} // namespace hyalite::core::bench
