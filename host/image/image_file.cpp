#include "host/image/image_file.h"

#include "host/error.h"
#include "host/image/input_file.h"
#include "host/image/pfm.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace hyalite {

ImageFormat imageFormatOf(const std::filesystem::path &path) {
    std::string extension = path.extension().string();
    for (char &c : extension) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (extension == ".png") {
        return ImageFormat::Png;
    }
    if (extension == ".pfm") {
        return ImageFormat::Pfm;
    }
    throw Error(ExitCode::Usage,
                fmt::format("'{}': an image is written as .png (8-bit, tone-mapped) or .pfm (linear "
                            "float); name a file with one of these extensions",
                            path.string()));
}

void writeImage(AtomicFile &file, ImageFormat format, const Image &image, double exposureStops) {
    switch (format) {
    case ImageFormat::Png:
        writePng(file, image.width(), image.height(), toneMap(image, exposureStops));
        break;
    case ImageFormat::Pfm:
        writePfm(file, image);
        break;
    }
}

LoadedImage readImage(const std::filesystem::path &path) {
    const InputFile file(path);
    const std::vector<std::byte> head = file.head(8);
    if (isPng(head)) {
        return {readPng(file), Encoding::Display};
    }
    if (isPfm(head)) {
        return {readPfm(file), Encoding::Linear};
    }
    throw file.bad(file.sizeBytes() == 0 ? "it is empty" : "it is neither a PNG nor a PFM file");
}

} // namespace hyalite
