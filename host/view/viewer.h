// The viewer: a scene and one or two renderers, which make its pictures better and better until something else is wished.
#pragma once

#include "host/engine/backend.h"
#include "host/engine/open_backends.h"
#include "host/film/view_film.h"
#include "host/image/image_file.h"
#include "host/view/view_frame.h"
#include "host/view/view_scene.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace hyalite::core {

/// Whether a page may show what the integrator makes: its samples are colours.
[[nodiscard]] bool isShowable(const IntegratorRow &row);

/// A view to be rendered to a file.
struct ViewToRender {
    const ViewChanges &changes;
    std::optional<Integrator> shown;  ///< instead of the scene's
    std::optional<bool> isDenoised{}; ///< other than the scene's file says
    std::size_t renderer = 0;
};

struct ViewRequest {
    SceneOptions scene;
    std::vector<RendererNames> renderers{{"auto"}}; ///< one, or two that are compared
    int threadCount = 0;                            ///< 0: all
    DeviceOptions deviceOptions;
    std::string commandLine;
    std::function<std::string(const ViewToRender &)> renderCommand; ///< the command line that does it
};

/// The point that a pixel shows.
struct Pick {
    glm::dvec3 position; ///< in the coordinates of the scene's file
    double distance;     ///< from the camera
    double depth;        ///< along the view direction
    std::string object;  ///< its name; empty without one
    std::string material;
};

/// A picture to be stored by somebody.
struct PictureWish {
    ImageFormat format; ///< PNG or EXR
    bool isClean;
    ToneCurve tone = ToneCurve::Gamma;
    double exposureStops = 0.0;
};

/// Threads render; everything else may be asked by any thread, and takes no longer than a copy.
class Viewer {
  public:
    /// Prepares the scene and opens the renderers. `observer` gets what these tell. Throws as prepareScene() and
    /// openRenderers() do, and Error{NoDevice} where two renderers are one.
    Viewer(ViewRequest request, Observer &observer);
    ~Viewer();
    Viewer(const Viewer &) = delete;
    Viewer &operator=(const Viewer &) = delete;

    /// Asks all threads to end, which renderers do between two dispatches. Returns whether they have within this time.
    [[nodiscard]] bool stop(std::chrono::milliseconds patience);

    /// Changes what is to be seen, by a JSON object: options and settings by their names, null for what the viewer was
    /// started with; "show", the name of an integrator or null; "clean", whether pictures are denoised, too. Throws
    /// OverrideError for what is not allowed, and then changes nothing. What does not fit together is told by state().
    void change(const nlohmann::json &wishes);

    /// All that a page shows beside the pictures.
    [[nodiscard]] nlohmann::ordered_json state() const;
    /// The number of the present state. Waits until it is another one than `seen`, this long at most.
    [[nodiscard]] std::uint64_t waitForNews(std::uint64_t seen, std::chrono::milliseconds patience) const;

    [[nodiscard]] std::size_t rendererCount() const { return slots_.size(); }
    /// The last frame of a renderer, or null. Clean: the last denoised one of the present view, if there is one.
    [[nodiscard]] std::shared_ptr<const ViewFrame> frame(std::size_t renderer, bool isClean) const;

    /// What the pixel at these shares of the picture's width and height, in [0, 1), shows; empty: nothing.
    [[nodiscard]] std::optional<Pick> pick(double x, double y) const;

    /// The picture of a renderer as a file, with its provenance. Waits for the next samples. Throws Error{BadInput} while
    /// there are none, and Error{LimitExceeded}.
    [[nodiscard]] std::vector<std::byte> pictureFile(std::size_t renderer, const PictureWish &wanted) const;
    /// A scene file with the present camera, to lie beside that of the scene.
    [[nodiscard]] std::string sceneText() const;

  private:
    using Clock = std::chrono::steady_clock;

    /// A view as renderers get it.
    struct Job {
        std::uint64_t number = 0; ///< 0: none
        std::uint64_t view = 0;
        double share = 1.0; ///< of its size
        Integrator integrator = Integrator::Whitted;
    };
    struct Slot {
        std::unique_ptr<Backend> backend;
        std::uint64_t finished = 0; ///< the job that it has nothing to do for any more
        std::shared_ptr<const ViewFrame> raw;
        std::shared_ptr<const ViewFrame> clean;
        std::map<int, std::shared_ptr<const ViewFrame>>
            compared;    ///< by samples: those that the other has not yet
        int samples = 0; ///< of each pixel, of the view in full size
        ViewFigures figures;
        RendererIdentity identity;
        std::string failure; ///< of the view
        double pixelsPerSecond = 0.0;
        // Of the last view in full size: the film when its samples are finished, or while somebody waits for it.
        std::uint64_t filmView = 0;
        std::shared_ptr<const Film> film;
        int filmWaiters = 0;
        std::shared_ptr<const std::vector<ViewFilm>> views; ///< of the denoiser; null: not rendered yet
        std::uint64_t viewsView = 0;
        bool isCleaned = false; ///< the finished film, or it cannot be
        std::thread thread;
    };
    struct Difference {
        int samples = 0; ///< 0: nothing was compared yet
        std::size_t pixels = 0;
    };
    class JobObserver;
    class FrameTaker;
    using Lock = std::unique_lock<std::mutex>;

    void direct();
    void applyWish(Lock &lock);
    void reload(Lock &lock);
    void beginView(Lock &lock);
    void beginJob(Lock &lock, double share);
    [[nodiscard]] bool isJobFinished() const;
    [[nodiscard]] double firstShare() const;
    [[nodiscard]] nlohmann::ordered_json describeScene() const;

    void work(Slot &slot);
    [[nodiscard]] bool hasWork(const Slot &slot) const;
    void preview(Slot &slot, const Job &job);
    void refine(Slot &slot, const Job &job);
    [[nodiscard]] Film addSamples(Slot &slot, const Job &job, const RenderSettings &settings, Film film,
                                  SnapshotTaker *snapshots = nullptr);
    void makeClean(Slot &slot, const Job &job, const Film &film, int samples);
    [[nodiscard]] bool isCancelled(const Job &job) const { return jobNumber_ != job.number || isStopping_; }
    [[nodiscard]] RenderSettings settingsOf(Integrator integrator) const;
    void publish(Slot &slot, const Job &job, ViewFrame &&frame, const Film *film = nullptr);
    void compareWithOther(Slot &slot, const std::shared_ptr<const ViewFrame> &frame);
    void tellNews();

    ViewRequest request_;
    Observer &observer_;
    mutable ViewScene scene_;
    std::vector<std::unique_ptr<Slot>> slots_;

    mutable std::mutex mutex_; ///< of what follows, and of slots
    mutable std::condition_variable changed_;
    std::atomic<bool> isStopping_ = false;
    std::atomic<std::uint64_t> jobNumber_ =
        0; ///< of the job that renderers are to work on, or that is being made
    Job job_;
    // What is wished, and what was.
    ViewChanges changes_;
    std::optional<Integrator> shown_;
    std::atomic<bool> isClean_ = false; ///< renderers look at it between two frames
    bool isDenoisedByFile_ = false;     ///< the scene's own setting
    std::uint64_t wished_ = 1;
    std::uint64_t applied_ = 0;
    Clock::time_point wishedAt_;
    ViewChanges shownChanges_; ///< the last ones that could be shown
    SceneOptions shownOptions_;
    std::uint64_t frameNumber_ = 0;
    std::uint64_t news_ = 1;
    Difference difference_;
    std::string fault_;             ///< why the last wish, or the last version of the files, cannot be shown
    std::vector<std::string> told_; ///< warnings and advice about the scene
    nlohmann::ordered_json sceneState_;
    int runningThreads_ = 0;
    std::thread director_;
};

} // namespace hyalite::core
