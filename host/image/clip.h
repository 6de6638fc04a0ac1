// Clips: animations in one file, written frame by frame.
#pragma once

#include "host/base/atomic_file.h"
#include "host/image/attribute.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace hyalite::core {

enum class ClipFormat { Webp, Apng };

/// By the name's extension, .webp or .apng in upper or lower case; of "apng:-" for standard output. Nothing for others.
[[nodiscard]] std::optional<ClipFormat> clipFormatOf(const std::filesystem::path &path);

/// Throws Error{LimitExceeded} where frames of that size are too large for the format. `name` is for the message.
void requireClipSize(const std::filesystem::path &name, ClipFormat format, int width, int height);

/// A clip of whole frames, without loss, that plays again and again. One frame at a time is in memory.
class ClipWriter {
  public:
    virtual ~ClipWriter() = default;
    ClipWriter(const ClipWriter &) = delete;
    ClipWriter &operator=(const ClipWriter &) = delete;

    /// Frames are as writePng() takes pictures: 8-bit RGB or RGBA, of straight colours. All have the size and the
    /// channels of the first one. Throws Error{LimitExceeded} where the file would be larger than its format allows or
    /// memory is short, and Error{OutputNotWritten}.
    void add(int width, int height, std::span<const std::uint8_t> levels);

    /// Ends the file, which has a frame at least, with `attributes` as text; the caller commits it. Throws likewise.
    virtual void finish(std::span<const Attribute> attributes) = 0;

    [[nodiscard]] std::size_t frameCount() const { return frameCount_; }
    /// The hash of all levels so far; of one frame it is that of its PNG.
    [[nodiscard]] std::string pixelHash() const;

  protected:
    /// `file` must outlive the writer.
    ClipWriter(AtomicFile &file, double framesPerSecond) : file_(file), framesPerSecond_(framesPerSecond) {}

    virtual void begin(int width, int height, bool hasAlpha) = 0;
    virtual void append(int width, int height, std::span<const std::uint8_t> levels) = 0;

    AtomicFile &file_;
    const double framesPerSecond_;

  private:
    std::size_t frameCount_ = 0;
    std::uint64_t hash_ = 0;
};

/// `file` must outlive the writer. `framesPerSecond` is in limits::framesPerSecond.
[[nodiscard]] std::unique_ptr<ClipWriter> makeClipWriter(AtomicFile &file, ClipFormat format,
                                                         double framesPerSecond);

} // namespace hyalite::core
