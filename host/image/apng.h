// Animated PNG files (W3C, "Portable Network Graphics (PNG) Specification, Third Edition", 11.3.6): a PNG, whose picture
// is the first frame, with chunks for the others.
#pragma once

#include "host/image/clip.h"

#include <memory>

namespace hyalite::core {

[[nodiscard]] std::unique_ptr<ClipWriter> makeApngWriter(AtomicFile &file, double framesPerSecond);

} // namespace hyalite::core
