// Renderers in other ranks, with messages in memory instead of MPI: their tiles make the picture of one renderer.
#include "host/farm/rank_backend.h"

#include "host/engine/cpu_backend.h"
#include "host/engine/shared_backend.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace hyalite::core {
namespace {

/// What all ranks of a test share.
struct Mail {
    std::mutex mutex;
    std::map<std::pair<int, int>, std::deque<std::vector<std::byte>>> waiting; ///< by sender and receiver
};

class MemoryRanks : public Ranks {
  public:
    MemoryRanks(Mail &mail, int rank, int count) : mail_(mail), rank_(rank), count_(count) {}
    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int count() const override { return count_; }
    void send(int to, std::span<const std::byte> message) override {
        const std::scoped_lock lock(mail_.mutex);
        mail_.waiting[{rank_, to}].emplace_back(message.begin(), message.end());
    }
    [[nodiscard]] std::optional<std::vector<std::byte>> poll(int from) override {
        const std::scoped_lock lock(mail_.mutex);
        std::deque<std::vector<std::byte>> &mail = mail_.waiting[{from, rank_}];
        if (mail.empty())
            return std::nullopt;
        std::vector<std::byte> message = std::move(mail.front());
        mail.pop_front();
        return message;
    }

  private:
    Mail &mail_;
    int rank_;
    int count_;
};

PreparedScene smallRoom(int samplesPerPixel = 6, std::uint32_t seed = 0) {
    SceneOptions options;
    options.scene = "cornell";
    options.width = 120;
    options.height = 100;
    options.settings.push_back({[=](RenderSettings &settings) {
        settings.samplesPerPixel = samplesPerPixel;
        settings.seed = seed;
    }});
    return prepareScene(options, Source::Dropped, nobody());
}

std::unique_ptr<Backend> oneThread() { return makeCpuBackend(reference::Precision::Float32, 1); }

struct RankBackends : ::testing::Test {
    Mail mail;
    PreparedScene scene = smallRoom();
    BackendResult alone = render(*oneThread(), scene.crop);

    [[nodiscard]] BackendResult render(Backend &backend, Film begun, const RenderHooks &hooks = {}) const {
        return backend.render(scene.packed, scene.loaded.settings, std::move(begun), hooks);
    }

    /// A rank that has loaded `room`.
    [[nodiscard]] std::jthread serving(int rank, int count, PreparedScene room = smallRoom()) {
        return std::jthread([this, rank, count, room = std::move(room)]() mutable {
            MemoryRanks ranks(mail, rank, count);
            const std::unique_ptr<Backend> backend = oneThread();
            serveTiles(ranks, room, *backend);
        });
    }
};

TEST_F(RankBackends, ShareAPictureAndItsLayers) {
    MemoryRanks ranks(mail, 0, 3);
    const std::jthread second = serving(1, 3);
    const std::jthread third = serving(2, 3);
    RankPool pool(ranks);
    std::vector<std::string> notes;
    const std::unique_ptr<Backend> here = oneThread();
    std::vector<std::unique_ptr<Backend>> members = pool.backends(scene, *here, notes);
    EXPECT_EQ(notes, std::vector<std::string>{});
    ASSERT_EQ(members.size(), 2u);
    EXPECT_EQ(members[1]->name(), "cpu of rank 2");
    const std::unique_ptr<Backend> shared = shareBackends(std::move(members));
    const BackendResult result = render(*shared, scene.crop);
    EXPECT_EQ(differingPixelCount(result.film, alone.film), 0u);
    EXPECT_EQ(result.rays, alone.rays);
    // Settings travel with tiles.
    RenderSettings &settings = scene.loaded.settings;
    settings.integrator = Integrator::AmbientOcclusion;
    settings.samplesPerPixel = 2;
    settings.sampler = SamplerKind::Centre;
    settings.occlusionDistance = 100.0;
    settings.seed = 9;
    const BackendResult occlusion = render(*shared, scene.crop);
    EXPECT_EQ(differingPixelCount(occlusion.film, render(*here, scene.crop).film), 0u);
}

TEST_F(RankBackends, StopAndGoOn) {
    MemoryRanks ranks(mail, 0, 2);
    const std::jthread second = serving(1, 2);
    RankPool pool(ranks);
    std::vector<std::string> notes;
    const std::unique_ptr<Backend> shared = shareBackends(pool.backends(scene, *oneThread(), notes));
    std::atomic<int> questions = 0;
    BackendResult result = render(*shared, scene.crop, {.shouldStop = [&] { return ++questions > 20; }});
    EXPECT_GT(differingPixelCount(result.film, alone.film), 0u);
    BackendResult rest = render(*shared, std::move(result.film));
    rest.rays += result.rays;
    EXPECT_EQ(differingPixelCount(rest.film, alone.film), 0u);
    EXPECT_EQ(rest.rays, alone.rays);
}

TEST_F(RankBackends, LeaveOutWhoHasNothingOrSomethingElse) {
    MemoryRanks ranks(mail, 0, 3);
    const std::jthread second([this] {
        MemoryRanks own(mail, 1, 3);
        reportFailure(own, "no driver");
    });
    const std::jthread third = serving(2, 3, smallRoom(6, 7)); // another seed
    RankPool pool(ranks);
    std::vector<std::string> notes;
    EXPECT_TRUE(pool.backends(scene, *oneThread(), notes).empty());
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], "left out rank 1: no driver");
    EXPECT_EQ(notes[1], "left out rank 2: seed: 7 there, 0 here");
}

TEST_F(RankBackends, AreLetGoBeforeAnythingIsRendered) {
    MemoryRanks ranks(mail, 0, 2);
    const std::jthread second = serving(1, 2);
    const RankPool pool(ranks);
}

} // namespace
} // namespace hyalite::core
