// Picture files: formats, reading and writing.
#pragma once

#include "host/base/atomic_file.h"
#include "host/image/alpha.h"
#include "host/image/file_options.h"
#include "host/image/image_limits.h"
#include "host/image/picture.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

enum class ImageFormat {
    Png, ///< 8-bit RGB or RGBA, tone-mapped, for viewing
    Pfm, ///< float32 RGB, linear, as rendered, for programs
    Exr, ///< the same, with alpha, layers and attributes
    Hdr, ///< RGB of 8 bits with a common exponent, linear
};

/// Encoding of the numbers of an image. It also says what its colours are if it has alpha.
enum class Encoding {
    Display, ///< display-encoded, in [0, 1]; straight
    Linear,  ///< proportional to light, any float; premultiplied
};

struct LoadedImage {
    Image image; ///< the numbers of the file; display-encoded ones are not linearised
    Encoding encoding = Encoding::Linear;
    std::vector<float> alpha{}; ///< as stored; empty: opaque

    /// The colours over black: those that images are compared by.
    [[nodiscard]] Image composite() const {
        return alpha.empty() || encoding == Encoding::Linear ? image : overBlack(image, alpha);
    }
};

/// By the name's extension, .png, .exr, .hdr or .pfm in upper or lower case; of "exr:-" for standard output, where "-"
/// is a PNG. Throws Error{Usage} for any other.
[[nodiscard]] ImageFormat imageFormatOf(const std::filesystem::path &path);

/// The levels of the picture's PNG, three of each pixel or, with alpha, four: straight colours, multiplied by
/// 2^exposureStops and tone-mapped. Light beyond opacity, such as that of a reflection in clear glass, is lost: the curve
/// ends at white, and nothing is seen where alpha is 0.
[[nodiscard]] std::vector<std::uint8_t> pngLevels(const Picture &picture, double exposureStops,
                                                  ToneCurve curve);
/// The levels of a PNG that was read.
[[nodiscard]] std::vector<std::uint8_t> pngLevels(const Image &display, std::span<const float> alpha);
/// The picture as a PNG of it is read, with the default curve.
[[nodiscard]] LoadedImage asDisplayed(const LoadedImage &linear);

/// Writes the picture, which is not empty; the caller commits the file. A PNG has pngLevels(); the other formats hold
/// the linear values. Attributes go into a PNG or an EXR, layers into an EXR only, alpha into both.
///
/// Returns what the file has lost, a sentence each: alpha in other formats, whose colours are over black, and what
/// writeExr() says. Throws Error{OutputNotWritten}, or Error{LimitExceeded} if a PNG has more than imagePixelCountMax
/// pixels.
std::vector<std::string> writeImage(AtomicFile &file, ImageFormat format, const Picture &picture,
                                    double exposureStops, const FileOptions &options = {});

/// Reads a PNG, OpenEXR, Radiance or PFM file, told apart by its first bytes. Grey becomes three equal channels. Layers
/// are dropped; colours and alpha stay as stored.
///
/// Throws Error{BadInput}, naming the file and the fault, if it is not a regular file, is too large, truncated, damaged
/// or, except for OpenEXR, followed by other bytes. Throws Error{LimitExceeded} if it would take more than
/// readingBytesMax.
[[nodiscard]] LoadedImage readImage(const std::filesystem::path &path);

/// The texts of a PNG or an OpenEXR file, such as those that say where it comes from; of other files none. Throws
/// Error{BadInput} where the file cannot be read.
[[nodiscard]] std::vector<Attribute> readAttributes(const std::filesystem::path &path);

/// The hash of an image's numbers as its file has them, 8-bit levels or floats and then alpha: what its attribute
/// "pixels" says.
[[nodiscard]] std::string pixelHash(std::span<const std::uint8_t> levels);
[[nodiscard]] std::string pixelHash(const Image &linear, std::span<const float> alpha = {});

/// Whether this is a whole image of this size, with an attribute of this text, in printable ASCII, which is found in
/// the first MiB, as the hash of its pixels is. Reads all of the file: it may have been cut short on its way from
/// another machine, or painted over.
[[nodiscard]] bool isImageWith(const std::filesystem::path &path, const std::string &text, int width,
                               int height);

} // namespace hyalite::core
