// OpenEXR pictures as `hyalite diff` and `hyalite tonemap` read them, and their layers as `hyalite diff --statistical`
// does. The library behind it is not instrumented: what it does to the heap is seen, and how much of that it takes.
#include "host/image/exr.h"
#include "host/image/exr_picture.h"
#include "host/image/image_file.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cstdint>
#include <string>

namespace hyalite::core::fuzz {
namespace {

void readOne(const std::filesystem::path &path, const std::string &layer, std::size_t sizeBytes) {
    const HeapPeak peak;
    const std::optional<std::string> refusal = refusalOf([&] {
        const InputFile file(path);
        const Image image = readExr(file, layer);
        require(image.width() > 0 && image.height() > 0 && hasExrLayer(file, layer),
                "an image without pixels");
    });
    require(peak.bytes() <= readingBytesMax(sizeBytes), "more memory than may be taken for such a file");
}

void readOthers(const std::filesystem::path &path, std::size_t sizeBytes) {
    const HeapPeak peak;
    static_cast<void>(refusalOf([&] {
        const AlphaImage read = readExrWithAlpha(InputFile(path));
        require(read.alpha.empty() || read.alpha.size() == read.image.pixels().size(),
                "alpha of some pixels");
    }));
    static_cast<void>(refusalOf([&] { (void)readExrWhole(InputFile(path), "samples"); }));
    static_cast<void>(refusalOf([&] { (void)readExrAttributes(InputFile(path)); }));
    static_cast<void>(refusalOf([&] {
        const ExrPicture read = readExrPicture(InputFile(path));
        require(!read.channels.empty() && read.crop.width() <= read.wholeWidth, "a picture without channels");
    }));
    require(peak.bytes() <= readingBytesMax(sizeBytes), "more memory than may be taken for such a file");
}

void run(std::string_view content) {
    static const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("input.exr", content);
    for (const char *layer : {"", "variance", "samples"})
        readOne(path, layer, content.size());
    readOthers(path, content.size());
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
