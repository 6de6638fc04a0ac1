#include "host/image/clip.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/letter_case.h"
#include "host/base/standard_stream.h"
#include "host/image/apng.h"
#include "host/image/png.h"
#include "host/image/webp_clip.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite::core {

std::optional<ClipFormat> clipFormatOf(const std::filesystem::path &path) {
    const std::optional<std::string> streamFormat = standardStreamFormat(path);
    const std::string extension = lowerCase(streamFormat ? "." + *streamFormat : path.extension().string());
    if (extension == ".webp")
        return ClipFormat::Webp;
    if (extension == ".apng")
        return ClipFormat::Apng;
    return std::nullopt;
}

void requireClipSize(const std::filesystem::path &name, ClipFormat format, int width, int height) {
    if (format == ClipFormat::Apng)
        requirePngSize(name, width, height);
    else if (std::max(width, height) > webpSideMax)
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("'{}': a side of {} x {} pixels is longer than {}; write an .apng, or smaller frames",
                        name.string(), width, height, webpSideMax));
}

void ClipWriter::add(int width, int height, std::span<const std::uint8_t> levels) {
    const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (frameCount_ == 0)
        begin(width, height, levels.size() == 4 * pixelCount);
    append(width, height, levels);
    ++frameCount_;
    hash_ = hashBytes(std::as_bytes(levels), hash_);
}

std::string ClipWriter::pixelHash() const { return hashText(hash_); }

std::unique_ptr<ClipWriter> makeClipWriter(AtomicFile &file, ClipFormat format, double framesPerSecond) {
    if (format == ClipFormat::Apng)
        return makeApngWriter(file, framesPerSecond);
    return makeWebpWriter(file, framesPerSecond);
}

} // namespace hyalite::core
