// Picture files: formats, reading and writing.
#pragma once

#include "host/base/atomic_file.h"
#include "host/image/image.h"
#include "host/image/image_limits.h"
#include "host/image/picture.h"
#include "host/image/tone_map.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace hyalite::core {

enum class ImageFormat {
    Png, ///< 8-bit RGB, tone-mapped, for viewing
    Pfm, ///< float32 RGB, linear, as rendered, for programs
    Exr, ///< the same, with layers and attributes
    Hdr, ///< RGB of 8 bits with a common exponent, linear
};

/// Encoding of the numbers of an image.
enum class Encoding {
    Display, ///< display-encoded, in [0, 1]
    Linear,  ///< proportional to light, any float
};

struct LoadedImage {
    Image image; ///< the numbers of the file; display-encoded ones are not linearised
    Encoding encoding = Encoding::Linear;
};

/// By the name's extension, .png, .exr, .hdr or .pfm in upper or lower case; of "exr:-" for standard output, where "-"
/// is a PNG. Throws Error{Usage} for any other.
[[nodiscard]] ImageFormat imageFormatOf(const std::filesystem::path &path);

/// Writes the picture, which is not empty; the caller commits the file. A PNG is multiplied by 2^exposureStops and
/// tone-mapped; the other formats hold the linear values and ignore both. Attributes go into a PNG or an EXR, layers
/// into an EXR only. Throws Error{OutputNotWritten}, or Error{LimitExceeded} if a PNG has more than imagePixelCountMax
/// pixels.
void writeImage(AtomicFile &file, ImageFormat format, const Picture &picture, double exposureStops,
                ToneCurve curve = ToneCurve::Gamma);

/// Reads a PNG, OpenEXR, Radiance or PFM file, told apart by its first bytes. Grey becomes three equal channels. Alpha
/// and layers are dropped, and the colours stay as stored (PNG does not multiply them by alpha, OpenEXR does).
///
/// Throws Error{BadInput}, naming the file and the fault, if it is not a regular file, is too large, truncated, damaged
/// or, except for OpenEXR, followed by other bytes. Throws Error{LimitExceeded} if it would take more than
/// readingBytesMax.
[[nodiscard]] LoadedImage readImage(const std::filesystem::path &path);

/// The hash of an image's numbers as its file has them, 8-bit levels or floats: what its attribute "pixels" says.
[[nodiscard]] std::string pixelHash(std::span<const std::uint8_t> levels);
[[nodiscard]] std::string pixelHash(const Image &linear);

/// Whether this is a whole image of this size, with an attribute of this text, in printable ASCII, which is found in
/// the first MiB, as the hash of its pixels is. Reads all of the file: it may have been cut short on its way from
/// another machine, or painted over.
[[nodiscard]] bool isImageWith(const std::filesystem::path &path, const std::string &text, int width,
                               int height);

} // namespace hyalite::core
