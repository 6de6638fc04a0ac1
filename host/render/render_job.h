// A render job: a render from request to files, in stages. The caller reports progress between them.
#pragma once

#include "host/base/atomic_file.h"
#include "host/film/checkpoint.h"
#include "host/film/checkpoint_lock.h"
#include "host/film/partition.h"
#include "host/image/image_file.h"
#include "host/image/tone_map.h"
#include "host/render/backend.h"
#include "host/render/layers.h"
#include "host/render/part_origin.h"
#include "host/render/periodic_files.h"
#include "host/render/prepare.h"
#include "host/render/stop.h"
#include "host/report/render_report.h"

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// A request: what to render, on which device, into which files. The path of a file that is not wanted is empty.
struct RenderRequest {
    SceneOptions scene;
    std::string output;
    std::optional<ToneCurve> tone; ///< of a PNG; default: gamma
    std::vector<Integrator> layers;
    std::string device = "auto";
    int threadCount = 0; ///< 0: all
    DeviceOptions deviceOptions;
    std::string report;
    std::optional<double> timeLimitSeconds;
    std::string checkpoint;
    std::optional<double> checkpointSeconds; ///< interval; default: 10
    bool isResuming = false;
    /// Only this part of the picture, into the checkpoint `output` in place of a picture; it goes on from what is there.
    std::optional<Part> part;
    std::vector<std::string> words;       ///< of the command line, for who has to make a part again
    std::optional<double> partialSeconds; ///< interval of partial pictures; default: none
    bool isQuiet = false;                 ///< no progress
};

/// Call the stages once each, in the order of their declarations.
class RenderJob {
  public:
    /// Opens the outputs, so that one that cannot be written fails before the work begins.
    RenderJob(const RenderRequest &request, const std::string &commandLine);

    /// Loads and builds the scene, and opens the device at the same time, as soon as the outline is known.
    void prepare();
    /// Waits for the device, and checks memory for the films.
    void openDevice();
    /// Opens the checkpoint and, to resume, reads it.
    void resume();
    /// Renders the layers.
    void renderLayers();
    /// Renders the missing samples, until it is stopped. Once some work is finished, signals stop it gracefully;
    /// before, while the driver compiles, they end the program. Throws if not even one sample is finished.
    void render();
    /// Stores the checkpoint, then the image.
    void writeImage();
    void writeReport();
    /// Why the whole picture is black or not a number, or empty.
    [[nodiscard]] std::optional<std::string> diagnosis() const;
    /// Throws the failure of the render or of the checkpoint, if there was one.
    void throwFailure() const;

    [[nodiscard]] const PreparedScene &scene() const { return *scene_; }
    [[nodiscard]] const Backend &device() const { return *backend_; }
    [[nodiscard]] const RenderReport &report() const { return report_; }
    /// Pixels to be rendered: those of the part.
    [[nodiscard]] std::uint64_t pixelCount() const;
    /// Whether the part was finished before.
    [[nodiscard]] bool isFinishedBefore() const;
    /// Why the newest checkpoint was not used, or empty.
    [[nodiscard]] const std::string &checkpointDamage() const { return checkpointDamage_; }
    /// Whether it ended early, only because of the time limit.
    [[nodiscard]] bool isCutByTime() const;
    /// The signal that came first so far, or 0.
    [[nodiscard]] int stoppingSignal() const { return signals_->first(); }

  private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] bool shouldStop() const;
    [[nodiscard]] std::vector<PeriodicFile> periodicFiles();
    [[nodiscard]] std::span<const Crop> squares() const;
    [[nodiscard]] PartOrigin partOrigin() const;
    void writeCheckpoint(const Film &film, const RayCounts &rays);
    void requireRoom() const;
    void takeResult(BackendResult result);
    void writePicture(AtomicFile &file, const Film &film) const;

    const RenderRequest request_;
    const Clock::time_point start_ = Clock::now();
    const ImageFormat format_;
    std::optional<AtomicFile> image_; ///< unless the output is a part
    std::optional<AtomicFile> reportFile_;
    std::optional<PreparedScene> scene_;
    std::future<std::unique_ptr<Backend>> opening_;
    std::unique_ptr<Backend> backend_;
    std::optional<CaughtSignals> signals_; ///< until everything is written, when the most could be lost
    std::optional<Partition> partition_;
    std::optional<CheckpointLock> checkpointLock_;
    std::optional<CheckpointWriter> checkpoint_;
    std::string checkpointDamage_;
    RayCounts raysBefore_;
    std::optional<Film> filmBefore_;
    std::vector<Film> layersBefore_;
    std::vector<ViewFilm> layers_;
    Clock::time_point renderStart_;
    std::optional<PeriodicFiles> snapshots_; ///< writes with the members above
    std::optional<Film> film_;
    int signalWhileRendering_ = 0;
    std::optional<Error> renderFailure_;
    std::optional<Error> checkpointFailure_;
    RenderReport report_;
};

} // namespace hyalite
