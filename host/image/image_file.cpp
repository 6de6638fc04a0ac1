#include "host/image/image_file.h"

#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/input_file.h"
#include "host/base/letter_case.h"
#include "host/base/standard_stream.h"
#include "host/image/clip.h"
#include "host/image/exr.h"
#include "host/image/hdr.h"
#include "host/image/pfm.h"
#include "host/image/png.h"
#include "host/image/png_text.h"
#include "host/image/tone_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {

ImageFormat imageFormatOf(const std::filesystem::path &path) {
    const std::optional<std::string> streamFormat = standardStreamFormat(path);
    const std::string extension = lowerCase(!streamFormat           ? path.extension().string()
                                            : streamFormat->empty() ? ".png"
                                                                    : "." + *streamFormat);
    if (extension == ".png")
        return ImageFormat::Png;
    if (extension == ".pfm")
        return ImageFormat::Pfm;
    if (extension == ".exr")
        return ImageFormat::Exr;
    if (extension == ".hdr")
        return ImageFormat::Hdr;
    if (clipFormatOf(path))
        throw Error(
            ErrorKind::Usage,
            fmt::format("'{}': .webp and .apng hold a sequence of frames in one file, whose name has no #; "
                        "a picture by itself is written as .png, .exr, .hdr or .pfm",
                        path.string()));
    throw Error(
        ErrorKind::Usage,
        fmt::format(
            "'{}': an image is written as .png (8-bit, tone-mapped), .exr (linear float, with "
            "layers), .hdr (linear, 8 bits and an exponent) or .pfm (linear float); name a file "
            "with one of these extensions, or - for standard output (exr:- for another format than PNG)",
            path.string()));
}

std::vector<std::uint8_t> pngLevels(const Picture &picture, double exposureStops, ToneCurve curve) {
    if (picture.alpha.empty())
        return toneMap(picture.colour, exposureStops, curve);
    return withAlphaLevels(toneMap(straightened(picture.colour, picture.alpha), exposureStops, curve),
                           picture.alpha);
}

std::vector<std::uint8_t> pngLevels(const Image &display, std::span<const float> alpha) {
    std::vector<std::uint8_t> levels;
    levels.reserve(display.pixels().size() * 3);
    for (const glm::vec3 &pixel : display.pixels())
        for (int channel = 0; channel < 3; ++channel)
            levels.push_back(static_cast<std::uint8_t>(std::lround(pixel[channel] * 255.0f)));
    return alpha.empty() ? levels : withAlphaLevels(levels, alpha);
}

LoadedImage asDisplayed(const LoadedImage &linear) {
    LoadedImage display;
    display.encoding = Encoding::Display;
    display.image = displayed(linear.alpha.empty() ? linear.image : straightened(linear.image, linear.alpha));
    for (const float alpha : linear.alpha)
        display.alpha.push_back(static_cast<float>(alphaLevel(alpha)) / 255.0f);
    return display;
}

std::vector<std::string> writeImage(AtomicFile &file, ImageFormat format, const Picture &picture,
                                    double exposureStops, const FileOptions &options) {
    const Image &image = picture.colour;
    const auto withoutAlpha = [&](std::string_view name) {
        return picture.alpha.empty()
                   ? std::vector<std::string>()
                   : std::vector{fmt::format("{} has no alpha: its colours are over black", name)};
    };
    switch (format) {
    case ImageFormat::Png:
        writePng(file, image.width(), image.height(), pngLevels(picture, exposureStops, options.tone),
                 picture.attributes);
        break;
    case ImageFormat::Pfm:
        writePfm(file, image);
        return withoutAlpha("PFM");
    case ImageFormat::Exr:
        return writeExr(file, picture, options.exr);
    case ImageFormat::Hdr:
        writeHdr(file, image);
        return withoutAlpha("HDR");
    }
    return {};
}

LoadedImage readImage(const std::filesystem::path &path) {
    const InputFile file(path);
    const std::vector<std::byte> head = file.head(8);
    const auto loaded = [](AlphaImage &&read, Encoding encoding) {
        return LoadedImage{std::move(read.image), encoding, std::move(read.alpha)};
    };
    if (isPng(head))
        return loaded(readPng(file), Encoding::Display);
    if (isPfm(head))
        return {readPfm(file), Encoding::Linear};
    if (isExr(head))
        return loaded(readExrWithAlpha(file), Encoding::Linear);
    if (isHdr(head))
        return {readHdr(file), Encoding::Linear};
    throw file.bad(foreignContent(file, "it is no PNG, OpenEXR, Radiance (HDR) or PFM file"));
}

std::vector<Attribute> readAttributes(const std::filesystem::path &path) {
    const InputFile file(path);
    const std::vector<std::byte> head = file.head(8);
    return isPng(head)   ? readPngTexts(file)
           : isExr(head) ? readExrAttributes(file)
                         : std::vector<Attribute>();
}

std::string pixelHash(std::span<const std::uint8_t> levels) {
    return hashText(hashBytes(std::as_bytes(levels)));
}

std::string pixelHash(const Image &linear, std::span<const float> alpha) {
    const std::uint64_t ofColours = hashBytes(std::as_bytes(std::span(linear.pixels())));
    return hashText(alpha.empty() ? ofColours : hashBytes(std::as_bytes(alpha), ofColours));
}

bool isImageWith(const std::filesystem::path &path, const std::string &text, int width, int height) {
    constexpr std::size_t maxBytes = std::size_t{1} << 20;
    try {
        const std::vector<std::byte> head = InputFile(path).head(maxBytes);
        const auto hasText = [&](const std::string &wanted) {
            const std::span<const std::byte> bytes = std::as_bytes(std::span(wanted));
            return std::search(head.begin(), head.end(), bytes.begin(), bytes.end()) != head.end();
        };
        if (!hasText(text))
            return false;
        const auto [image, encoding, alpha] = readImage(path);
        return image.width() == width && image.height() == height &&
               hasText(encoding == Encoding::Display ? pixelHash(pngLevels(image, alpha))
                                                     : pixelHash(image, alpha));
    } catch (const Error &) {
        return false;
    }
}

} // namespace hyalite::core
