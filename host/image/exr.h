// OpenEXR files, read and written with the OpenEXR library (https://openexr.com).
#pragma once

#include "host/base/atomic_file.h"
#include "host/base/input_file.h"
#include "host/image/alpha.h"
#include "host/image/exr_options.h"
#include "host/image/picture.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// Writes one part of scan lines: R, G, B and, if the picture has alpha, A, linear, with the primaries of Rec. 709; each
/// layer as NAME.CHANNEL, or as NAME if it has one value per pixel; the attributes as strings, and the projection as
/// worldToCamera, worldToNDC and screenWindowWidth. Numbers are float32, of light float16 on request, and UINT where
/// they are whole. The display window is the whole image, the data window the crop. The same picture makes the same
/// bytes.
///
/// Several parts would let readers skip layers, but not all programs look beyond the first one (ImageMagick, xStudio).
///
/// Returns what the file has lost, a sentence each: values above the range of float16, which become 65504, its largest;
/// and layers of data that a compression changes. Throws Error{OutputNotWritten}.
std::vector<std::string> writeExr(AtomicFile &file, const Picture &picture, const ExrOptions &options = {});

/// pixelHash() of the colours that such a file holds: what readExrWithAlpha() finds there.
[[nodiscard]] std::string exrPixelHash(const Picture &picture, const ExrOptions &options);

/// Whether the compression changes some values: of 16-bit channels, of 32-bit ones, or of colours.
[[nodiscard]] bool isLossy(ExrCompression compression);

/// Whether the first bytes of a file are those of an OpenEXR file.
[[nodiscard]] bool isExr(std::span<const std::byte> head);

/// The window of an OpenEXR file that is its picture.
enum class ExrWindow {
    Data,   ///< those that are stored: of a crop, the crop
    Display ///< the picture that was meant; black where nothing is stored
};

/// The attributes that are texts. Throws as readExr() does if the header cannot be read.
[[nodiscard]] std::vector<Attribute> readExrAttributes(const InputFile &file);

/// Reads R, G and B, or Y as three equal channels, of a window: from the named layer, or from the channels
/// without a layer. A layer of X, Y and Z is read as these, one with a single value as grey; "depth" and "Z" are the same
/// layer. Half floats and integers become float32; all compressions are supported. Throws Error{BadInput}, also for tiles,
/// deep pixels, several parts, and a missing layer. Throws Error{LimitExceeded} for files that would take more memory than
/// readingBytesMax.
[[nodiscard]] Image readExr(const InputFile &file, const std::string &layer = "",
                            ExrWindow window = ExrWindow::Data);

/// The same of the channels without a layer, with alpha, if there is a channel A. Colours are premultiplied.
[[nodiscard]] AlphaImage readExrWithAlpha(const InputFile &file);

/// The values of a layer of one whole number a pixel (UINT), exactly, row by row. Throws as readExr() does, and
/// Error{BadInput} for other types.
[[nodiscard]] std::vector<std::uint32_t> readExrWhole(const InputFile &file, const std::string &layer);

/// Whether the layer has a single value. Throws as readExr() does.
[[nodiscard]] bool isGreyExrLayer(const InputFile &file, const std::string &layer);

/// Whether the file has that layer. Throws as readExr() does if the header cannot be read.
[[nodiscard]] bool hasExrLayer(const InputFile &file, const std::string &layer);

} // namespace hyalite::core
