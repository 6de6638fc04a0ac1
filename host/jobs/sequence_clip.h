// The clip of a sequence: its frames in one file, as they are finished.
#pragma once

#include "host/base/atomic_file.h"
#include "host/image/bitmap_text.h"
#include "host/image/clip.h"
#include "host/jobs/render_session.h"

#include <memory>
#include <string>
#include <vector>

namespace hyalite::core {

class SequenceClip {
  public:
    /// Opens the file, whose name is that of a clip. Throws Error{OutputNotWritten}.
    SequenceClip(const std::filesystem::path &path, double framesPerSecond);

    /// Throws as ClipWriter::add() does; after that the clip can only be discarded.
    void add(int frame, const Drawing &picture);

    /// Its frames.
    [[nodiscard]] const std::vector<int> &frames() const { return frames_; }
    [[nodiscard]] double framesPerSecond() const { return framesPerSecond_; }
    /// Whether it can be written: it has a frame, and none failed.
    [[nodiscard]] bool isWhole() const { return isWhole_; }

    /// Writes it, with its origin; if frames of `wanted` are missing, that says so. Throws likewise.
    void write(const std::vector<int> &wanted, const RenderSession &session, const std::string &commandLine);

  private:
    AtomicFile file_;
    const double framesPerSecond_;
    std::unique_ptr<ClipWriter> writer_;
    std::vector<int> frames_;
    bool isWhole_ = false;
};

} // namespace hyalite::core
