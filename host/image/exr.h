// OpenEXR files, read and written with the OpenEXR library (https://openexr.com).
#pragma once

#include "host/base/atomic_file.h"
#include "host/base/input_file.h"
#include "host/image/picture.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core {

/// Writes scan lines of float32 with lossless compression: R, G and B, linear, with the primaries of Rec. 709; each
/// layer as NAME.CHANNEL, or as NAME if it has one value per pixel; and the attributes as strings. The display window
/// is the whole image, the data window the crop. The same picture makes the same bytes. Throws Error{OutputNotWritten}.
void writeExr(AtomicFile &file, const Picture &picture);

/// Whether the first bytes of a file are those of an OpenEXR file.
[[nodiscard]] bool isExr(std::span<const std::byte> head);

/// The window of an OpenEXR file that is its picture.
enum class ExrWindow {
    Data,   ///< those that are stored: of a crop, the crop
    Display ///< the picture that was meant; black where nothing is stored
};

/// Reads R, G and B, or Y as three equal channels, of a window: from the named layer, or from the channels
/// without a layer. A layer with a single value is read as grey; "depth" and "Z" are the same layer. Half floats and
/// integers become float32; all compressions are supported. Throws Error{BadInput}, also for tiles, deep pixels,
/// several parts, and a missing layer. Throws Error{LimitExceeded} for files that would take more memory than
/// readingBytesMax.
[[nodiscard]] Image readExr(const InputFile &file, const std::string &layer = "",
                            ExrWindow window = ExrWindow::Data);

/// Whether the file has that layer. Throws as readExr() does if the header cannot be read.
[[nodiscard]] bool hasExrLayer(const InputFile &file, const std::string &layer);

} // namespace hyalite::core
