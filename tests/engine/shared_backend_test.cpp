// Several renderers that share a picture: its bits are those of one, whoever fails or stops.
#include "host/engine/shared_backend.h"

#include "host/engine/cpu_backend.h"
#include "host/import/assets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <latch>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

/// How a member fails.
enum class Failure {
    None,
    Throws,  ///< as a device does that a scene is too large for
    GivesUp, ///< as a device does that is lost for good: with a film that has some of the samples
    Differs, ///< one bit is wrong in the first pixel of each tile, and the mean is right
};

/// The CPU, as a member that fails at its `failingTile`-th tile; or that differs, in each.
class MemberOnCpu : public Backend {
  public:
    /// Begins with its first tile when all that are to come to `gate` have one.
    MemberOnCpu(std::string name, std::shared_ptr<std::latch> gate, Failure failure = Failure::None,
                int failingTile = 0)
        : name_(std::move(name)), gate_(std::move(gate)), failure_(failure), failingTile_(failingTile) {}

    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::string description() const override { return name_; }
    [[nodiscard]] RendererIdentity identity(const PackedScene &scene, Integrator integrator) const override {
        return cpu_->identity(scene, integrator);
    }
    [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                       const RenderHooks &hooks) override {
        const bool isSpot = !hooks.onProgress; // of the check that comes before the tiles
        if (spotCount_ + tileCount_ == 0 && gate_)
            gate_->arrive_and_wait();
        const bool isFailing = isFailingAt(isSpot ? -1 : tileCount_);
        ++(isSpot ? spotCount_ : tileCount_);
        if (isFailing && failure_ == Failure::Throws)
            throw Error(ErrorKind::LimitExceeded, "too little memory");
        std::atomic<int> left = 40; // samples
        const auto givesUp = [&] { return left-- <= 0; };
        const bool isGivingUp = isFailing && failure_ == Failure::GivesUp;
        RenderHooks ofCpu = hooks;
        if (isGivingUp)
            ofCpu.shouldStop = givesUp;
        BackendResult result = cpu_->render(scene, settings, std::move(begun), ofCpu);
        if (isGivingUp)
            result.failure.emplace(ErrorKind::DeviceLost, "lost");
        if (isFailing && failure_ == Failure::Differs)
            spoil(result.film.pixels.front());
        return result;
    }
    /// Changes the last bit of the least of all sums.
    static void spoil(layout::FilmPixel &pixel) {
        pixel.squaresRest.x = std::nextafter(pixel.squaresRest.x, 1.0f);
    }
    [[nodiscard]] int spotCount() const { return spotCount_; }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return cpu_->trace(scene, settings, pixel, sampleIndex);
    }

  private:
    [[nodiscard]] bool isFailingAt(int tile) const {
        return failure_ == Failure::Differs || (failure_ != Failure::None && tile == failingTile_);
    }

    std::unique_ptr<Backend> cpu_ = makeCpuBackend(reference::Precision::Float32, 1);
    std::string name_;
    std::shared_ptr<std::latch> gate_;
    Failure failure_;
    int failingTile_;
    int tileCount_ = 0;
    int spotCount_ = 0;
};

template <class... Members> std::unique_ptr<Backend> share(Members... members) {
    std::vector<std::unique_ptr<Backend>> all;
    (all.push_back(std::make_unique<MemberOnCpu>(std::move(members))), ...);
    return shareBackends(std::move(all));
}

struct SharedBackends : ::testing::Test {
    PreparedScene scene = [] {
        SceneOptions options;
        options.scene = "cornell";
        options.width = 120;
        options.height = 100;
        options.settings.push_back({[](RenderSettings &settings) { settings.samplesPerPixel = 6; }});
        return prepareScene(options, Source::Dropped, nobody());
    }();
    BackendResult alone = render(*makeCpuBackend(reference::Precision::Float32, 2), scene.crop);

    [[nodiscard]] BackendResult render(Backend &backend, Film begun, const RenderHooks &hooks = {}) const {
        return backend.render(scene.packed, scene.loaded.settings, std::move(begun), hooks);
    }
    void expectWhole(const BackendResult &result) const {
        EXPECT_EQ(differingPixelCount(result.film, alone.film), 0u);
        EXPECT_EQ(result.rays, alone.rays);
        EXPECT_FALSE(result.failure);
    }
};

TEST_F(SharedBackends, HaveTheBitsOfOne) {
    const auto gate = std::make_shared<std::latch>(3);
    const auto backend = share(MemberOnCpu("a", gate), MemberOnCpu("b", gate), MemberOnCpu("c", gate));
    const BackendResult result = render(*backend, scene.crop);
    expectWhole(result);
    ASSERT_EQ(result.shares.size(), 3u);
    std::uint64_t sampleCount = 0;
    for (const RendererShare &one : result.shares) {
        EXPECT_GT(one.tileCount, 0u) << one.name;
        sampleCount += one.sampleCount;
    }
    EXPECT_EQ(sampleCount, 120u * 100u * 6u);
}

TEST_F(SharedBackends, LeaveOutWhoThrows) {
    const auto gate = std::make_shared<std::latch>(2);
    const auto backend = share(MemberOnCpu("good", gate), MemberOnCpu("bad", gate, Failure::Throws));
    const BackendResult result = render(*backend, scene.crop);
    expectWhole(result);
    EXPECT_EQ(result.shares.at(0).failure, "");
    EXPECT_EQ(result.shares.at(1).failure, "too little memory");
    const BackendResult next = render(*backend, scene.crop); // it is left out of the next picture, too
    expectWhole(next);
    ASSERT_EQ(next.shares.size(), 2u);
    EXPECT_EQ(next.shares[0].name, "bad");
    EXPECT_EQ(next.shares[0].tileCount, 0u);
}

TEST_F(SharedBackends, LeaveOutWhoseBitsDiffer) {
    const auto gate = std::make_shared<std::latch>(3);
    const auto backend = share(MemberOnCpu("wrong", gate, Failure::Differs), MemberOnCpu("right", gate),
                               MemberOnCpu("right, too", gate));
    const BackendResult result = render(*backend, scene.crop);
    expectWhole(result);
    ASSERT_EQ(result.shares.size(), 3u);
    const RendererShare &wrong = result.shares[0];
    EXPECT_EQ(wrong.tileCount, 0u);
    EXPECT_GT(wrong.seconds, 0.0) << "only then it is told";
    EXPECT_EQ(result.shares[1].failure, "");
    EXPECT_EQ(result.shares[2].failure, "");
    // The middle of 120x100 pixels: the last two of six samples.
    Film spot(Crop{56, 57, 48, 49});
    spot.pixels[0].sampleCount = 4;
    layout::FilmPixel pixel =
        render(*makeCpuBackend(reference::Precision::Float32, 1), std::move(spot)).film.pixels[0];
    const auto text = [&] {
        const glm::vec3 &rest = pixel.squaresRest;
        return fmt::format("({:.9g} {:.9g} {:.9g})", rest.x, rest.y, rest.z);
    };
    const std::string right = text();
    MemberOnCpu::spoil(pixel);
    EXPECT_EQ(wrong.failure,
              fmt::format("wrong and cpu disagree: at pixel (56, 48) the rest of the sum of squares "
                          "of 2 samples is {} and {}",
                          text(), right));
    const BackendResult next = render(*backend, scene.crop);
    expectWhole(next);
    EXPECT_EQ(next.shares.at(0).name, "wrong");
    EXPECT_EQ(next.shares[0].tileCount, 0u);
}

TEST_F(SharedBackends, FailWhereAllDiffer) {
    const auto backend =
        share(MemberOnCpu("a", nullptr, Failure::Differs), MemberOnCpu("b", nullptr, Failure::Differs));
    const BackendResult result = render(*backend, scene.crop);
    ASSERT_TRUE(result.failure);
    EXPECT_EQ(result.failure->remedy, Remedy::OneDevice);
    EXPECT_EQ(differingPixelCount(result.film, Film(scene.crop)), 0u);
}

TEST_F(SharedBackends, AreComparedOnceForEachIntegrator) {
    const auto gate = std::make_shared<std::latch>(2);
    std::vector<std::unique_ptr<Backend>> members;
    members.push_back(std::make_unique<MemberOnCpu>("a", gate));
    members.push_back(std::make_unique<MemberOnCpu>("b", gate));
    const auto &a = static_cast<const MemberOnCpu &>(*members[0]);
    const auto &b = static_cast<const MemberOnCpu &>(*members[1]);
    const auto backend = shareBackends(std::move(members));
    for (int frame = 0; frame < 2; ++frame) {
        for (const RendererShare &share : render(*backend, scene.crop).shares)
            EXPECT_EQ(share.failure, "");
        EXPECT_EQ(a.spotCount(), 4);
        EXPECT_EQ(b.spotCount(), 4);
    }
    scene.loaded.settings.integrator = Integrator::Normal;
    static_cast<void>(render(*backend, scene.crop));
    EXPECT_GE(a.spotCount() + b.spotCount(), 12) << "one of them may have come too late for a tile";
}

TEST_F(SharedBackends, GoOnFromTheTileOfWhoGivesUp) {
    const auto gate = std::make_shared<std::latch>(2);
    const auto backend = share(MemberOnCpu("good", gate), MemberOnCpu("bad", gate, Failure::GivesUp));
    const BackendResult result = render(*backend, scene.crop);
    expectWhole(result);
    EXPECT_EQ(result.shares.at(1).failure, "lost");
}

TEST_F(SharedBackends, FailWhereAllFail) {
    const auto gate = std::make_shared<std::latch>(2);
    const auto backend =
        share(MemberOnCpu("a", gate, Failure::GivesUp), MemberOnCpu("b", gate, Failure::Throws, 1));
    BackendResult result = render(*backend, scene.crop);
    ASSERT_TRUE(result.failure);
    // What is there can be continued.
    BackendResult rest = render(*share(MemberOnCpu("c", nullptr)), std::move(result.film));
    rest.rays += result.rays;
    expectWhole(rest);
}

TEST_F(SharedBackends, StopAndGoOn) {
    const auto backend = share(MemberOnCpu("a", nullptr), MemberOnCpu("b", nullptr));
    std::atomic<int> left = 20'000;
    BackendResult result = render(*backend, scene.crop, {.shouldStop = [&] { return left-- <= 0; }});
    EXPECT_GT(differingPixelCount(result.film, alone.film), 0u);
    BackendResult rest = render(*backend, std::move(result.film));
    rest.rays += result.rays;
    expectWhole(rest);
}

TEST_F(SharedBackends, GiveSnapshotsThatGoOn) {
    class Keeper : public SnapshotTaker {
      public:
        [[nodiscard]] bool isWanted() const noexcept override { return true; }
        void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) override {
            if (++count != 4)
                return;
            copyTo(film.emplace(Crop{}));
            raysThen = rays;
        }
        int count = 0;
        std::optional<Film> film;
        RayCounts raysThen;
    };
    const auto backend = share(MemberOnCpu("a", nullptr), MemberOnCpu("b", nullptr));
    Keeper keeper;
    expectWhole(render(*backend, scene.crop, {.snapshots = &keeper}));
    ASSERT_TRUE(keeper.film);
    BackendResult rest = render(*backend, std::move(*keeper.film));
    rest.rays += keeper.raysThen;
    expectWhole(rest);
}

TEST_F(SharedBackends, TellProgressThatNeverFalls) {
    const auto backend = share(MemberOnCpu("a", nullptr), MemberOnCpu("b", nullptr));
    double last = 0.0;
    const auto onProgress = [&](double share) {
        EXPECT_GE(share, last - 1e-12);
        last = share;
    };
    static_cast<void>(render(*backend, scene.crop, {.onProgress = onProgress}));
    EXPECT_NEAR(last, 1.0, 1e-12);
}

} // namespace
} // namespace hyalite::core
