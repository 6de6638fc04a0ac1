// The engine as another program calls it: quiet, several at once, and stopped from outside.
#include "host/engine/open_backends.h"
#include "host/report/render_report.h"
#include "tests/fixtures/test_device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

PreparedScene prepare(const std::string &name, int side, int samplesPerPixel, Observer &observer = nobody()) {
    SceneOptions options;
    options.scene = name;
    options.width = options.height = side;
    options.settings.push_back(
        {[=](RenderSettings &settings) { settings.samplesPerPixel = samplesPerPixel; }});
    return prepareScene(options, Source::Dropped, observer);
}

BackendResult renderAs(const std::string &task, Backend &backend, const PreparedScene &scene,
                       Observer &observer) {
    return render(backend, scene.packed, scene.loaded.settings, scene.crop, observer, {.name = task});
}

/// The device that tests run on, by its index.
std::unique_ptr<Backend> openTestDevice(Observer &observer = nobody()) {
    return openBackend(std::to_string(testDevice().index), observer);
}

/// Writes down what it is told, and stops when another thread says so.
class Diary : public Observer {
  public:
    void begin(const std::string &task, bool /*mayCompile*/) override { lines.push_back("begin " + task); }
    void progress(double share) override {
        EXPECT_GE(share, 0.0);
        EXPECT_LE(share, 1.0);
        ++progressCount;
    }
    void end() override { lines.push_back("end"); }
    void warning(const std::string &text) override { add("warning " + text); }
    void note(const std::string &text) override { add("note " + text); }
    void advice(const std::string &text) override { add("advice " + text); }
    [[nodiscard]] std::optional<Stop> wantsStop() override {
        isAsked = true;
        isAsked.notify_all();
        return isStopped ? std::optional(Stop{"the test", ErrorKind::Interrupted}) : std::nullopt;
    }
    void beforeDriver(const gpu::ProcessorUse & /*use*/) override { lines.push_back("driver"); }

    std::vector<std::string> lines;
    std::atomic<int> progressCount = 0;
    std::atomic<bool> isAsked = false;
    std::atomic<bool> isStopped = false;

  private:
    void add(const std::string &line) {
        const std::lock_guard lock(mutex_);
        lines.push_back(line);
    }

    std::mutex mutex_;
};

TEST(Engine, PrintsNothingAndTellsItsObserver) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    Diary diary;
    // Light that its integrator does not see is worth advice.
    const PreparedScene scene = prepare("cornell", 16, 1, diary);
    const std::unique_ptr<Backend> device = openTestDevice(diary);
    const BackendResult result = renderAs("a picture", *device, scene, diary);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_FALSE(result.failure);
    EXPECT_EQ(diary.lines,
              (std::vector<std::string>{"begin load", "end", "driver", "begin a picture", "end"}));
    EXPECT_GT(diary.progressCount, 0);
}

TEST(Engine, SeveralDoNotDisturbEachOther) {
    const PreparedScene spheres = prepare("spheres", 48, 4);
    const PreparedScene cornell = prepare("cornell", 32, 4);
    const auto renderOnCpu = [](const PreparedScene &scene) {
        return renderAs("cpu", *openBackend("cpu", nobody()), scene, nobody()).film;
    };
    const Film wanted[] = {renderOnCpu(spheres), renderOnCpu(cornell)};
    const std::unique_ptr<Backend> devices[] = {openTestDevice(), openTestDevice()};
    for (int turn = 0; turn < 2; ++turn) { // each has had the other's scene in the second one
        const auto renderIn = [&](int device, const PreparedScene &scene) {
            return std::async(std::launch::async, [&, device] {
                return renderAs("device", *devices[device], scene, nobody()).film;
            });
        };
        std::future<Film> first = renderIn(turn, spheres);
        std::future<Film> second = renderIn(1 - turn, cornell);
        EXPECT_EQ(differingPixelCount(first.get(), wanted[0]), 0u);
        EXPECT_EQ(differingPixelCount(second.get(), wanted[1]), 0u);
    }
}

TEST(Engine, StopsFromAnotherThreadWithWhatIsFinished) {
    const PreparedScene endless = prepare("spheres", 64, 65536);
    const std::string names[] = {"cpu", std::to_string(testDevice().index)};
    for (const std::string &name : names) {
        const std::unique_ptr<Backend> backend = openBackend(name, nobody());
        Diary diary;
        std::future<BackendResult> rendering =
            std::async(std::launch::async, [&] { return renderAs("endless", *backend, endless, diary); });
        diary.isAsked.wait(false); // it has begun
        diary.isStopped = true;
        const BackendResult result = rendering.get();
        EXPECT_FALSE(result.failure) << name;
        const FinishedWork finished = finishedWork(result.film, std::span(&result.film.crop, 1),
                                                   endless.loaded.settings.samplesPerPixel);
        EXPECT_FALSE(finished.isComplete) << name;
        // And a render after it goes on from there, or anew, as ever.
        EXPECT_EQ(
            differingPixelCount(
                renderAs("next", *backend, prepare("cornell", 16, 2), nobody()).film,
                renderAs("cpu", *openBackend("cpu", nobody()), prepare("cornell", 16, 2), nobody()).film),
            0u);
    }
}

} // namespace
} // namespace hyalite::core::testing
