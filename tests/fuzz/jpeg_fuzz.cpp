// JPEGs as textures are read from them.
#include "host/image/image_file.h"
#include "host/image/jpeg.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view content) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.jpg", content);
    const HeapPeak peak;
    Texture texture;
    const bool isRefused = refusalOf([&] { texture = readJpeg(InputFile(file)); }).has_value();
    require(peak.bytes() <= readingBytesMax(content.size()), "more memory than may be taken for such a file");
    if (isRefused)
        return;
    require(texture.width >= 1 && texture.height >= 1 && texture.levels.size() == texture.pixelCount(),
            "an image of another size than it says");
    for (const std::uint32_t levels : texture.levels)
        require(levels >> 24u == 255u, "a level that was not decoded");
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
