// A render job: a render from request to files, in stages. The caller reports progress between them.
#pragma once

#include "host/base/atomic_file.h"
#include "host/engine/time_limit.h"
#include "host/farm/part_origin.h"
#include "host/film/checkpoint.h"
#include "host/film/checkpoint_lock.h"
#include "host/film/partition.h"
#include "host/image/image_file.h"
#include "host/jobs/layers.h"
#include "host/jobs/periodic_files.h"
#include "host/jobs/render_session.h"
#include "host/report/render_report.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// Call the stages once each, in the order of their declarations.
class RenderJob {
  public:
    /// Opens the outputs, so that one that cannot be written fails before the work begins. The session's observer watches.
    /// `session` must outlive it.
    RenderJob(const RenderRequest &request, const std::string &commandLine, RenderSession &session);

    /// Prepares the session, unless it is prepared.
    void prepare();
    /// Waits for the device, and checks memory for the films.
    void openDevice();
    /// Opens the checkpoint and, to resume, reads it; looks for the frame that was rendered before.
    void resume();
    /// Renders the layers.
    void renderLayers();
    /// Renders the missing samples, until the observer wants it to stop. Throws if not even one sample is finished.
    void render();
    /// Stores the checkpoint, then the image.
    void writeImage();
    void writeReport();
    /// Why the whole picture is black or not a number, or empty.
    [[nodiscard]] std::optional<std::string> diagnosis() const;
    /// Throws the failure of the render or of the checkpoint, if there was one.
    void throwFailure() const;

    [[nodiscard]] const RenderReport &report() const { return report_; }
    /// Pixels to be rendered: those of the part.
    [[nodiscard]] std::uint64_t pixelCount() const;
    /// Whether the part or the frame was finished before.
    [[nodiscard]] bool isFinishedBefore() const;
    /// Why the newest checkpoint was not used, or empty.
    [[nodiscard]] const std::string &checkpointDamage() const { return checkpointDamage_; }
    /// Whether it ended early, only because of the time limit.
    [[nodiscard]] bool isCutByTime() const;

  private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] std::vector<PeriodicFile> periodicFiles();
    [[nodiscard]] std::span<const Crop> squares() const;
    [[nodiscard]] PartOrigin partOrigin() const;
    void lookForFrame();
    void writeCheckpoint(const Film &film, const RayCounts &rays);
    void requireRoom() const;
    void takeResult(BackendResult result);
    void writePicture(AtomicFile &file, const Film &film) const;

    const RenderRequest request_;
    const Clock::time_point start_ = Clock::now();
    const ImageFormat format_;
    std::optional<AtomicFile> image_; ///< unless the output is a part, or a frame that is there
    std::optional<AtomicFile> reportFile_;
    RenderSession &session_;
    std::optional<Partition> partition_;
    std::optional<CheckpointLock> checkpointLock_;
    std::optional<CheckpointWriter> checkpoint_;
    std::string checkpointDamage_;
    std::string frameIdentity_; ///< what decides the bytes of a frame's picture
    bool isFrameThere_ = false;
    RayCounts raysBefore_;
    std::optional<Film> filmBefore_;
    std::vector<Film> layersBefore_;
    std::vector<ViewFilm> layers_;
    TimeLimit timeLimit_;
    std::optional<PeriodicFiles> snapshots_; ///< writes with the members above
    std::optional<Film> film_;
    std::optional<Stop> stop_; ///< that the observer wanted while it rendered
    std::optional<Error> renderFailure_;
    std::optional<Error> checkpointFailure_;
    RenderReport report_;
};

} // namespace hyalite
