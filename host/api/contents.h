// Contents of the public types, and the way from the house's errors and observers to theirs. Not installed.
#pragma once

#include "host/base/clean_text.h"
#include "host/engine/open_backends.h"
#include "host/engine/prepare.h"
#include "host/engine/scene_options.h"
#include "host/film/view_film.h"
#include "host/image/image_file.h"
#include "host/import/scene_document.h"
#include "host/report/provenance.h"
#include "hyalite/error.h"
#include "hyalite/image.h"
#include "hyalite/renderer.h"
#include "hyalite/scene.h"
#include "hyalite/settings.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// Throws the exception that is being handled as an Error of the library.
[[noreturn]] void throwAsError();

/// Throws Error{Usage} in a process that was forked after the library had begun to work: neither drivers nor OpenMP
/// have their threads there.
void requireOwnProcess();
/// Whether it would.
[[nodiscard]] bool isForked() noexcept;

/// The result of `work`, whose exceptions become Errors.
template <class Work> auto guarded(const Work &work) {
    try {
        return work();
    } catch (...) {
        throwAsError();
    }
}

/// The same for what starts threads, or needs those of a driver.
template <class Work> auto withThreads(const Work &work) {
    requireOwnProcess();
    return guarded(work);
}

/// Throws Error{Usage} for a limit that no render could keep.
void requireTimeLimit(const std::optional<double> &seconds);

/// The program's side of a Watch. It keeps what a callback throws, and lets the work end.
class WatchObserver : public core::Observer {
  public:
    /// `owner` is what its callbacks must not use, as it waits for them.
    explicit WatchObserver(const Watch &watch, const void *owner = nullptr) : watch_(watch), owner_(owner) {}

    void begin(const std::string &task, bool mayCompile) override;
    void progress(double share) override;
    void warning(const std::string &text) override { tell(MessageKind::Warning, text); }
    void note(const std::string &text) override { tell(MessageKind::Note, text); }
    void advice(const std::string &text) override { tell(MessageKind::Advice, text); }
    [[nodiscard]] std::optional<core::Stop> wantsStop() override;
    void beforeDriver(const core::gpu::ProcessorUse &use) override;

    /// Whether this thread runs a callback of an observer of that owner.
    [[nodiscard]] static bool isCalledBy(const void *owner);
    /// Throws what a callback has thrown.
    void rethrow() const;
    [[nodiscard]] bool isStopped() const { return isStopped_; }

  private:
    using Clock = std::chrono::steady_clock;

    void tell(MessageKind kind, const std::string &text);
    template <class Call> void call(const Call &callback);

    const Watch &watch_;
    const void *owner_;
    std::string task_;
    std::atomic<bool> isStopped_ = false;
    std::atomic<Clock::rep> nextAsked_ = 0;
    mutable std::mutex mutex_;
    std::exception_ptr failure_; ///< the first one
};

/// The result of `work`, which the observer watches; but what a callback has thrown goes first.
template <class Work> auto watched(WatchObserver &observer, const Work &work) {
    try {
        auto result = withThreads(work);
        observer.rethrow();
        return result;
    } catch (const Error &) {
        observer.rethrow();
        throw;
    }
}

struct Image::Content {
    core::Image image;
    core::Encoding encoding = core::Encoding::Linear;
    std::vector<float> alpha{}; ///< empty: opaque
    // Of a render; else without pixels.
    core::Film film{core::Crop{}};
    std::vector<core::ViewFilm> views{};
    core::Image noisy{}; ///< the film's colours, if `image` is denoised
    int wholeWidth = 0;
    int wholeHeight = 0;
    std::optional<core::Projection> projection{};
    core::RenderSettings settings{};
    core::RayCounts rays{};
    double seconds = 0.0;
    bool isFinished = true;
    nlohmann::ordered_json provenance = nlohmann::ordered_json::object();
    std::vector<Layer> layers{};
    std::vector<std::vector<float>> layerValues{};
    // Made when they are asked for.
    mutable std::once_flag areFiguresMade{};
    mutable std::vector<float> variance{};
    mutable std::vector<std::uint32_t> samples{};
};

/// The image of a render. `views` are the films of its layers; `clean` are its colours if they were denoised.
[[nodiscard]] Image imageOf(const core::PreparedScene &scene, const core::RendererIdentity &renderer,
                            core::BackendResult &&result, std::vector<core::ViewFilm> &&views,
                            std::optional<core::Image> &&clean = std::nullopt);

struct Scene::Content {
    std::string source; ///< a file or a shipped scene; empty: the document
    std::shared_ptr<core::SceneDocument> document;
};

/// What is rendered, of the scene, the settings and the layers by their names.
[[nodiscard]] core::SceneOptions sceneOptionsOf(const Scene &scene, const Settings &settings,
                                                const std::vector<std::string> &layers = {});

} // namespace hyalite
