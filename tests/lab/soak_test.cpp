// A soak of backends that compute wrongly, in ways that are known.
#include "host/lab/soak.h"

#include "host/lab/soak_report.h"
#include "tests/fixtures/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

namespace hyalite::core {
namespace {

/// The CPU twin, whose films are changed by the number of their pass: 0 is the first render.
class ChangedBackend : public Backend {
  public:
    using Change = std::function<void(Film &, std::uint64_t pass)>;
    explicit ChangedBackend(Change change)
        : twin_(openBackend("cpu", nobody())), change_(std::move(change)) {}

    [[nodiscard]] std::string name() const override { return "changed"; }
    [[nodiscard]] std::string description() const override { return "changed, for tests"; }
    [[nodiscard]] RendererIdentity identity(const PackedScene &scene, Integrator integrator) const override {
        return twin_->identity(scene, integrator);
    }
    [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                       const RenderHooks &hooks) override {
        BackendResult result = twin_->render(scene, settings, std::move(begun), hooks);
        change_(result.film, pass_++);
        return result;
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel,
                                                        std::uint32_t sample) override {
        std::vector<layout::TraceEvent> events = twin_->trace(scene, settings, pixel, sample);
        if (sample == 3 && !events.empty())
            events.back().value.x += 1.0f;
        return events;
    }

  private:
    std::unique_ptr<Backend> twin_;
    Change change_;
    std::uint64_t pass_ = 0;
};

void flip(float &value, int bit) {
    value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1u << bit);
}

class SoakTest : public ::testing::Test {
  protected:
    void SetUp() override {
        setenv("HYALITE_ASSETS", HYALITE_ASSET_DIR, 1);
        loads_ = readLoads();
        loads_.loads.resize(1);
        LoadSize &size = loads_.loads.front().small; // smaller, with a hash of its own
        size.width = 24;
        size.height = 16;
        size.samplesPerPixel = 4;
        const PreparedScene scene = prepareLoad(loads_, loads_.loads.front(), size);
        const Film film =
            openBackend("cpu", nobody())->render(scene.packed, scene.loaded.settings, scene.crop).film;
        size.hash = filmHash(film);
    }

    [[nodiscard]] SoakVerdict run(const ChangedBackend::Change &change, std::uint64_t passes) const {
        ChangedBackend backend(change);
        SoakRequest request;
        request.passes = passes;
        return soak(backend, std::nullopt, loads_, request, nobody(), {});
    }

    Loads loads_;
};

TEST_F(SoakTest, FindsNothingWhereNothingIsWrong) {
    const SoakVerdict verdict = run([](Film &, std::uint64_t) {}, 20);
    EXPECT_TRUE(verdict.isSound()) << summaryOf(verdict);
    EXPECT_EQ(verdict.passes(), 20u);
    EXPECT_GT(verdict.loads.front().medianSpeed(), 0.0);
    EXPECT_GE(verdict.loads.front().readBacks, 1u);
}

TEST_F(SoakTest, TellsWhereAndWhatAndThatItDoesNotComeAgain) {
    const auto change = [](Film &film, std::uint64_t pass) {
        if (pass == 3)
            flip(film.pixels[24 * 5 + 7].sum.y, 20);
    };
    const SoakVerdict verdict = run(change, 20);
    EXPECT_FALSE(verdict.isSound());
    EXPECT_EQ(verdict.wrongPasses(), 1u);
    ASSERT_EQ(verdict.faults.size(), 1u);
    const SoakFault &fault = verdict.faults.front();
    EXPECT_EQ(fault.kind, SoakFault::Kind::Film);
    EXPECT_EQ(fault.pass, 3u);
    EXPECT_EQ(fault.wrongCount, 1u);
    EXPECT_EQ(fault.pixel, glm::uvec2(7, 5));
    ASSERT_EQ(fault.words.size(), 1u);
    EXPECT_EQ(fault.words.front().name, "sum.green");
    EXPECT_EQ(fault.words.front().found ^ fault.words.front().expected, 1u << 20);
    EXPECT_TRUE(fault.samples.empty()) << "the sum is wrong, not a sample";
    EXPECT_EQ(fault.recurrence, Recurrence::Transient);
    EXPECT_EQ(fault.replays, 10);
    EXPECT_EQ(verdict.patterns.bits[20], 1u);
    EXPECT_TRUE(describe(fault).find("(bit 20); transient: it came again in 0 of 10 passes") !=
                std::string::npos)
        << describe(fault);
}

TEST_F(SoakTest, KnowsIntermittentFromPermanentFaults) {
    const auto every = [](std::uint64_t period) {
        return [period](Film &film, std::uint64_t pass) {
            if (pass % period == 0)
                flip(film.pixels[9].sumRest.x, 3);
        };
    };
    const SoakVerdict intermittent = run(every(2), 20);
    ASSERT_FALSE(intermittent.faults.empty());
    bool isFound = false;
    for (const SoakFault &fault : intermittent.faults)
        if (fault.recurrence == Recurrence::Intermittent) {
            isFound = true;
            EXPECT_EQ(fault.repeats, 5);
        }
    EXPECT_TRUE(isFound);
    EXPECT_EQ(intermittent.wrongPasses(), intermittent.passes() / 2);

    const SoakVerdict permanent = run(every(1), 12);
    ASSERT_FALSE(permanent.faults.empty());
    const SoakFault &fault = permanent.faults.back();
    EXPECT_EQ(fault.recurrence, Recurrence::Permanent);
    ASSERT_TRUE(fault.divergence) << "the trace of sample 3 differs, too";
    EXPECT_EQ(fault.divergence->sampleIndex, 3u);
    EXPECT_EQ(permanent.wrongPasses(), permanent.passes());
}

// What is read back has another colour of one sample, which can be told from the sums.
TEST_F(SoakTest, NamesTheSampleThatIsWrong) {
    const PreparedScene scene = prepareLoad(loads_, loads_.loads.front(), loads_.loads.front().small);
    constexpr std::size_t index = 24 * 10 + 12; // whose samples have several colours
    const auto sumOfFirst = [&](std::uint32_t samples) {
        RenderSettings settings = scene.loaded.settings;
        settings.samplesPerPixel = samples;
        return openBackend("cpu", nobody())
            ->render(scene.packed, settings, Film(scene.crop))
            .film.pixels[index]
            .sum.x;
    };
    constexpr std::uint32_t wrongSample = 2;
    const float before = sumOfFirst(wrongSample + 1) - sumOfFirst(wrongSample);
    const auto change = [&](Film &film, std::uint64_t pass) {
        if (pass != 2)
            return;
        const float added = 0.25f;
        film.pixels[index].sum.x += added;
        film.pixels[index].sumOfSquares.x += added * (2.0f * before + added);
    };
    const SoakVerdict verdict = run(change, 14);
    ASSERT_EQ(verdict.faults.size(), 1u);
    EXPECT_EQ(verdict.faults.front().samples, std::vector<std::uint32_t>{wrongSample});
}

// The time is over before a load has a film to compare others with.
TEST_F(SoakTest, EndsInTimeAndTellsWhatItHasNotBegun) {
    class Endless : public ChangedBackend {
      public:
        Endless() : ChangedBackend([](Film &, std::uint64_t) {}) {}
        [[nodiscard]] BackendResult render(const PackedScene &, const RenderSettings &, Film begun,
                                           const RenderHooks &hooks) override {
            while (!hooks.shouldStop())
                std::this_thread::yield();
            return {std::move(begun), {}, {}, {}};
        }
    } backend;
    SoakRequest request;
    request.limit = TimeLimit(0.05);
    const SoakVerdict verdict = soak(backend, std::nullopt, loads_, request, nobody(), {});
    EXPECT_TRUE(verdict.faults.empty());
    EXPECT_FALSE(verdict.isSound());
    EXPECT_EQ(verdict.loads.front().lack, "no time was left for it");
    EXPECT_TRUE(summaryOf(verdict).starts_with("nothing compared")) << summaryOf(verdict);
}

TEST_F(SoakTest, FindsRaysThatWereCountedOtherwise) {
    // A film that is right by chance, of other paths.
    class MoreRays : public ChangedBackend {
      public:
        MoreRays() : ChangedBackend([](Film &, std::uint64_t) {}) {}
        [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings,
                                           Film begun, const RenderHooks &hooks) override {
            BackendResult result = ChangedBackend::render(scene, settings, std::move(begun), hooks);
            result.rays.shadow += renders_++ == 4 ? 1 : 0;
            return result;
        }
        int renders_ = 0;
    } backend;
    SoakRequest request;
    request.passes = 6;
    const SoakVerdict verdict = soak(backend, std::nullopt, loads_, request, nobody(), {});
    ASSERT_EQ(verdict.faults.size(), 1u);
    EXPECT_EQ(verdict.faults.front().kind, SoakFault::Kind::Rays);
    EXPECT_EQ(verdict.faults.front().pass, 4u);
}

TEST_F(SoakTest, GoesOnAfterADeviceFails) {
    class Failing : public ChangedBackend {
      public:
        Failing() : ChangedBackend([](Film &, std::uint64_t) {}) {}
        [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings,
                                           Film begun, const RenderHooks &hooks) override {
            if (renders_++ == 2)
                throw Error(ErrorKind::DeviceLost, "vkQueueSubmit: VK_ERROR_DEVICE_LOST");
            return ChangedBackend::render(scene, settings, std::move(begun), hooks);
        }
        int renders_ = 0;
    } backend;
    SoakRequest request;
    request.passes = 6;
    const SoakVerdict verdict = soak(backend, std::nullopt, loads_, request, nobody(), {});
    EXPECT_FALSE(verdict.isSound());
    EXPECT_EQ(verdict.passes(), 6u);
    ASSERT_EQ(verdict.faults.size(), 1u);
    EXPECT_EQ(verdict.faults.front().text, "vkQueueSubmit: VK_ERROR_DEVICE_LOST");
}

TEST_F(SoakTest, SaysThatTheProcessorsComputeOtherwise) {
    loads_.loads.front().small.hash ^= 1;
    const SoakVerdict verdict = run([](Film &, std::uint64_t) {}, 3);
    EXPECT_FALSE(verdict.isSound());
    ASSERT_EQ(verdict.faults.size(), 1u);
    EXPECT_TRUE(verdict.faults.front().text.find("compute otherwise") != std::string::npos);
}

TEST_F(SoakTest, ComparesSpeedsWithThoseOfAnEarlierReport) {
    SoakVerdict verdict = run([](Film &, std::uint64_t) {}, 5);
    const double speed = verdict.loads.front().medianSpeed();
    judgeSpeeds(verdict, std::vector<ExpectedSpeed>{{"changed", "materials", speed * 1.2},
                                                    {"other", "materials", speed * 9}});
    EXPECT_TRUE(verdict.isSound());
    judgeSpeeds(verdict, std::vector<ExpectedSpeed>{{"changed", "materials", speed * 1.3}});
    ASSERT_EQ(verdict.faults.size(), 1u);
    EXPECT_TRUE(describe(verdict.faults.front()).find("which is 0.77 of the expected") != std::string::npos)
        << describe(verdict.faults.front());
    EXPECT_THROW(judgeSpeeds(verdict, std::vector<ExpectedSpeed>{{"another", "materials", 1.0}}), Error);
}

TEST_F(SoakTest, ReadsTheSpeedsThatItWrites) {
    const std::vector<SoakVerdict> verdicts{run([](Film &, std::uint64_t) {}, 5)};
    const testing::TemporaryFolder folder;
    const std::string file = (folder.path / "r.json").string();
    std::ofstream(file) << soakToJson(loads_, verdicts, "hyalite");
    const std::vector<ExpectedSpeed> speeds = readExpectedSpeeds(file);
    ASSERT_EQ(speeds.size(), 1u);
    EXPECT_EQ(speeds.front().load, "materials");
    EXPECT_DOUBLE_EQ(speeds.front().speed, verdicts.front().loads.front().medianSpeed());
    for (
        const char *hostile :
        {"[]", "{}", R"({"soakVersion": 2, "devices": []})", R"({"soakVersion": 1, "devices": [1]})",
         R"({"soakVersion": 1, "devices": [{"name": 1, "loads": [{"name": "a", "speed": {"median": 1}}]}]})",
         R"({"soakVersion": 1, "devices": [{"name": "a", "loads": [{"name": "a", "speed": {"median": "x"}}]}]})"}) {
        std::ofstream(file) << hostile;
        EXPECT_THROW((void)readExpectedSpeeds(file), Error) << hostile;
    }
}

} // namespace
} // namespace hyalite::core
