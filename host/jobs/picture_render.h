// One picture from request to files: openFiles, beginPicture, finishPicture. Each takes what the one before it gave,
// and the caller may tell of it in between.
#pragma once

#include "host/base/atomic_file.h"
#include "host/film/checkpoint.h"
#include "host/film/checkpoint_lock.h"
#include "host/film/partition.h"
#include "host/jobs/display.h"
#include "host/jobs/render_session.h"
#include "host/jobs/sequence_clip.h"
#include "host/report/render_report.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The outputs of a picture, opened before the work begins, so that one that cannot be written is known at once.
struct PictureFiles {
    RenderRequest request; ///< a part has its output as the checkpoint from which it resumes
    std::optional<AtomicFile>
        image;                    ///< none for a part, nor in a clip, nor for what may be the finished frame
    SequenceClip *clip = nullptr; ///< of a frame that goes into one: it gets the picture
    std::optional<AtomicFile> report;
    std::unique_ptr<CheckpointLock> lock; ///< of the checkpoint, if there is one
    std::unique_ptr<Display> display;     ///< shows the picture, if a viewer is to
    std::chrono::steady_clock::time_point openedAt = std::chrono::steady_clock::now();
};

/// Throws Error{OutputNotWritten}, also without the viewer, and Error{Usage} for a picture of no format.
[[nodiscard]] PictureFiles openFiles(RenderRequest request);

/// Throws Error{LimitExceeded} if the films of a picture of the scene do not fit into memory, or not into its format.
void requireRoom(const PictureFiles &files, const PreparedScene &scene);

/// The beginning of a picture: the content of its checkpoint, or nothing.
struct PictureBeginning {
    RenderReport report{};
    std::vector<Crop> squares{};    ///< to be rendered: those of the part
    std::uint64_t pixelCount = 0;   ///< of the squares
    std::string frameIdentity{};    ///< what decides the bytes of a frame's picture
    std::string checkpointDamage{}; ///< why the newest checkpoint was not used, or empty
    bool isFinished = false;        ///< the part or the frame was finished before: there is nothing to do
    std::optional<CheckpointWriter> checkpoint{};
    std::optional<Film> film{};
    std::vector<Film> layers{};
    RayCounts rays{};
};

/// Reads the checkpoint that is to be resumed, or looks for the frame that was rendered before. The session is open.
/// Throws Error{BadInput} for a checkpoint of another picture.
[[nodiscard]] PictureBeginning beginPicture(PictureFiles &files, const std::string &commandLine,
                                            RenderSession &session);

struct FinishedPicture {
    RenderReport report;
    std::optional<std::string> diagnosis; ///< why the whole picture is black or not a number
    std::optional<Error> failure; ///< of the checkpoint, or of the render: the files have what was finished
    bool isCutByTime = false;     ///< it ended early, only because of the time limit
};

/// Renders the layers and the missing samples, until the session's observer wants it to stop, and writes checkpoint,
/// image and report. Throws if not even one sample is finished.
[[nodiscard]] FinishedPicture finishPicture(PictureFiles &files, PictureBeginning &&begun,
                                            RenderSession &session);

} // namespace hyalite::core
