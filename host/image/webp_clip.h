// Animated WebP files (RFC 9649, 2.7): frames that libwebp packs without loss, in a container of ours, which needs only
// one of them at a time.
#pragma once

#include "host/image/clip.h"

#include <memory>

namespace hyalite::core {

inline constexpr int webpSideMax = 16383;

/// Attributes are in the file as XMP.
[[nodiscard]] std::unique_ptr<ClipWriter> makeWebpWriter(AtomicFile &file, double framesPerSecond);

} // namespace hyalite::core
